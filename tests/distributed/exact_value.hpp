#pragma once

#include <cmath>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

namespace octetra::test {

using Whole = boost::multiprecision::cpp_int;

/// 2^-exact_unit is below the last bit of any double.
inline constexpr unsigned exact_unit = 1127;

/// A finite nonnegative double in units of 2^-exact_unit.
inline Whole exact_value(double number) {
    int exponent = 0;
    const double mantissa = std::frexp(number, &exponent);
    const Whole whole(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
    return whole << static_cast<unsigned>(exponent - 53 + static_cast<int>(exact_unit));
}

}  // namespace octetra::test
