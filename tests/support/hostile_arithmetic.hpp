#pragma once

#include <cfenv>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <gtest/gtest.h>

namespace octetra::test {

/// While an object of this class lives, the floating-point environment is as unlike the default one
/// as the system lets it be: results are rounded upwards, subnormal numbers are taken for 0, as in
/// programs that are linked with -ffast-math, and all exceptions trap but that of inexact results,
/// which the C++ standard library raises in its containers.
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

    /// Is the environment still the same?
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
    static constexpr unsigned flush_to_zero = 0x8040;  // of results and of operands

    std::fenv_t before_{};
};

/// Returns the result of `work` in such an environment, which `work` must not change.
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
