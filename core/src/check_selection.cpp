#include <octetra/core/check_selection.hpp>

#include <limits>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {
namespace {

/// False for NaN.
bool is_between(double low, double x, double high) { return low <= x && x <= high; }

std::string numbers_of(const Point& p) { return fmt::format("{},{},{}", p.x, p.y, p.z); }

}  // namespace

void check(const Sphere& sphere, std::string_view name, std::string_view text) {
    constexpr double largest = std::numeric_limits<double>::max();
    if (!is_finite(sphere.centre) || !is_between(-largest, sphere.radius, largest)) {
        throw InputError(fmt::format("{} takes 4 finite numbers as X,Y,Z,R, not '{}'", name, text));
    }
    if (sphere.radius < 0) {
        throw InputError(fmt::format("{}: the radius is negative: {}", name, text));
    }
}

void check(const Box& box, std::string_view name, std::string_view text) {
    const auto& [low, high] = box;
    if (!is_finite(low) || !is_finite(high)) {
        throw InputError(
            fmt::format("{} takes 6 finite numbers as X0,Y0,Z0,X1,Y1,Z1, not '{}'", name, text));
    }
    if (low.x > high.x || low.y > high.y || low.z > high.z) {
        throw InputError(fmt::format(
            "{}: each coordinate of the first corner must be at most that of the second corner: "
            "{}",
            name, text));
    }
}

void check(const RandomShare& share, std::string_view name) {
    const double fraction = share.fraction;
    if (!is_between(0, fraction, 1)) {
        throw InputError(fmt::format("{} takes a number from 0 to 1, not '{}'", name, fraction));
    }
    // A denormal fraction is not useful, and has few significant digits.
    if (fraction > 0 && fraction < std::numeric_limits<double>::min()) {
        throw InputError(fmt::format("{} takes a number from 0 to 1, not '{}'; it is out of range",
                                     name, fraction));
    }
}

void check(const Selection& selection) {
    for (const Sphere& sphere : selection.spheres) {
        check(sphere, "sphere", fmt::format("{},{}", numbers_of(sphere.centre), sphere.radius));
    }
    for (const Box& box : selection.boxes) {
        check(box, "box", numbers_of(box.low) + "," + numbers_of(box.high));
    }
    if (selection.random) check(*selection.random, "random");
    for (const Selection& other : selection.narrowed_by) check(other);
    if (!selection.max_volume) return;
    using Limits = std::numeric_limits<double>;
    if (!is_between(Limits::denorm_min(), *selection.max_volume, Limits::max())) {
        throw InputError(
            fmt::format("max_volume takes a number above 0, not '{}'", *selection.max_volume));
    }
}

}  // namespace octetra
