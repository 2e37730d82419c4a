#pragma once

#include <cfenv>

namespace octetra {

/// During the lifetime of an object of this class, its thread computes in the default
/// floating-point environment: results are rounded to nearest, subnormal numbers are kept, and no
/// exception traps. The destructor restores the previous environment, including its exception
/// flags. The environment differs from the default after fesetround() or feenableexcept(), or if
/// the program or a library that it loads was linked with -ffast-math, which makes the processor
/// flush subnormal numbers to zero.
///
/// All functions of the libraries that read, create, modify, verify, measure or write meshes create
/// one. Functions of a single cell (orientation(), volume(), marks(), mean_ratio() ...) are called
/// too often for this and compute in the environment of the caller, as do value transfers.
class StandardArithmetic {
public:
    StandardArithmetic();
    ~StandardArithmetic();
    StandardArithmetic(const StandardArithmetic&) = delete;
    StandardArithmetic& operator=(const StandardArithmetic&) = delete;
    StandardArithmetic(StandardArithmetic&&) = delete;
    StandardArithmetic& operator=(StandardArithmetic&&) = delete;

private:
    std::fenv_t before_{};
};

}  // namespace octetra
