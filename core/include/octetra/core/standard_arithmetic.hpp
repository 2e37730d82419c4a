#pragma once

#include <cfenv>

namespace octetra {

/// While an object of this class lives, its thread computes in the default floating-point
/// environment: results are rounded to nearest, subnormal numbers are kept, and no exception traps.
/// Afterwards the environment is that of before, with its exception flags. A program has another
/// one after fesetround() or feenableexcept(), or where it, or a library that it loads, was linked
/// with -ffast-math, which has the processor take subnormal numbers for 0.
///
/// All functions of the libraries that read, make, change, judge, measure or write meshes have one.
/// Those that look at a single cell (orientation(), volume(), marks(), mean_ratio() ...) are called
/// too often for it, and compute in the environment of the caller, as do transfers of its values.
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
