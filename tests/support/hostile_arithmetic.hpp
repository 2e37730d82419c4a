#pragma once

#include <cfenv>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <gtest/gtest.h>

namespace octetra::test {

/// During the lifetime of an object the floating-point environment differs from the default one as
/// far as the system permits: results are rounded upwards, subnormal numbers are flushed to 0, as
/// in programs linked with -ffast-math, and all exceptions trap except that for inexact results,
/// which the containers of the C++ standard library raise.
class HostileArithmetic {
public:
    HostileArithmetic() {
        std::fegetenv(&before_);
        std::feclearexcept(FE_ALL_EXCEPT);
        std::fesetround(FE_UPWARD);
#ifdef __SSE2__
        _mm_setcsr(_mm_getcsr() | flush_to_zero);
#endif
#ifdef __GLIBC__
        ::feenableexcept(trapped);
#endif
    }
    ~HostileArithmetic() { std::fesetenv(&before_); }
    HostileArithmetic(const HostileArithmetic&) = delete;
    HostileArithmetic& operator=(const HostileArithmetic&) = delete;
    HostileArithmetic(HostileArithmetic&&) = delete;
    HostileArithmetic& operator=(HostileArithmetic&&) = delete;

    /// Returns whether the environment is unchanged.
    [[nodiscard]] static bool is_in_force() {
        bool is = std::fegetround() == FE_UPWARD;
#ifdef __SSE2__
        is = is && (_mm_getcsr() & flush_to_zero) == flush_to_zero;
#endif
#ifdef __GLIBC__
        const int untrapped = trapped & ~::fegetexcept();
        // Some processors cannot trap.
        is = is && (untrapped == 0 || ::feenableexcept(trapped) == -1);
#endif
        return is;
    }

private:
    static constexpr int trapped = FE_ALL_EXCEPT & ~FE_INEXACT;
    static constexpr unsigned flush_to_zero = 0x8040;  // for results and operands

    std::fenv_t before_{};
};

/// Returns the result of `work` in such an environment, which `work` must preserve.
auto in_hostile_arithmetic(auto&& work) {
    bool is_left = false;
    auto result = [&] {
        const HostileArithmetic hostile;
        auto of_work = work();
        is_left = HostileArithmetic::is_in_force();
        return of_work;
    }();
    EXPECT_TRUE(is_left);
    return result;
}

}  // namespace octetra::test
