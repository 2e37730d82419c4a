#include <octetra/core/standard_arithmetic.hpp>

namespace octetra {

StandardArithmetic::StandardArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
}

StandardArithmetic::~StandardArithmetic() { std::fesetenv(&before_); }

}  // namespace octetra
