#include "hubs/axial_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

// Proof that no pair is missed. Call the distance of a unit vector from the axis its radius. An
// entity with a bounded interval only has directions of radius at least `entity_cap` / 2: its rays
// have at least `entity_cap`, and their angles differ by at most 2. Let d be a convex combination
// of the unit vectors of the wanted rays, in the direction of a point that the entity also
// contains; the length of d is at least `least_tightness`, so its distance from the axis is at
// least 2^-17. Rays with a radius below `touching` contribute less than 2^-31 to the components of
// d across the axis; the contribution of the other rays lies within the interval of their angles.
// Therefore the angle of d differs from that interval by less than `slack`.

namespace octetra::verify {
namespace {

constexpr double entity_cap = 0x1p-12;
constexpr double touching = 0x1p-32;
constexpr double slack = 0x1p-13;
constexpr double least_tightness = 0x1p-4;
constexpr double widest = 2;  // radians
constexpr double turn = 2 * std::numbers::pi;

/// Scales cosines down, because angles separate the entities around an axis better and should be
/// cut first.
constexpr double scale_of_cosines = 0x1p-6;

Vector unit_across(const Vector& u, const Vector& v) {
    const Vector across = cross(u, v);
    return times(across, 1 / std::sqrt(dot(across, across)));
}

/// Unit vector of the coordinate axis that differs most from u.
Vector least_aligned_with(const Vector& u) {
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k) least = std::abs(u[k]) < std::abs(u[least]) ? k : least;
    Vector unit{};
    unit[least] = 1;
    return unit;
}

Bounds unbounded() { return {{-std::numbers::pi, -1, 0}, {std::numbers::pi, 1, 0}}; }

/// Angles relative to that of the first ray, so that an interval of less than half a turn is found
/// for any position.
class AngleInterval {
public:
    void take(double angle) {
        if (is_empty_) first_ = angle;
        is_empty_ = false;
        const double difference = std::remainder(angle - first_, turn);
        low_ = std::min(low_, difference);
        high_ = std::max(high_, difference);
    }
    [[nodiscard]] bool is_bounded() const { return !is_empty_ && high_ - low_ <= widest; }
    /// In the range from -pi to pi.
    [[nodiscard]] double low(double error) const {
        return std::remainder(first_ + low_ - error, turn);
    }
    [[nodiscard]] double length(double error) const { return high_ - low_ + 2 * error; }

private:
    bool is_empty_ = true;
    double first_ = 0;
    double low_ = 0;
    double high_ = 0;
};

}  // namespace

AxialView::AxialView(const Vector& axis)
    : axis_(axis),
      first_(unit_across(axis, least_aligned_with(axis))),
      second_(unit_across(axis, first_)) {}

Bounds AxialView::bounds_of_entity(std::span<const Direction> rays) const {
    return bounds_of(rays, entity_cap, false);
}

AxialView::Wanted AxialView::wanted(std::span<const Direction> rays) const {
    return {bounds_of(rays, touching, true)};
}

Bounds AxialView::bounds_of(std::span<const Direction> rays, double least_radius,
                            bool may_touch_axis) const {
    const double tightness = least_cosine(rays);
    if (tightness < least_tightness) return unbounded();
    AngleInterval angles;
    double error = 0x1p-40;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Direction& ray : rays) {
        const double along = dot(ray.unit, axis_);
        low = std::min(low, along);
        high = std::max(high, along);
        const double x = dot(ray.unit, first_);
        const double y = dot(ray.unit, second_);
        const double radius = std::sqrt(x * x + y * y);
        if (radius >= least_radius) {
            angles.take(std::atan2(y, x));
            error = std::max(error, 4 * (ray.error + few_roundings) / radius);
        } else if (may_touch_axis) {
            error = std::max(error, slack);
        } else {
            return unbounded();
        }
    }
    if (!angles.is_bounded()) return unbounded();
    // Cosines of convex combinations, whose length may be less than 1.
    const double most = 8 * few_roundings + 2 * rays.front().error;
    low = std::max(-1.0, (low < 0 ? low / tightness : low) - most);
    high = std::min(1.0, (high > 0 ? high / tightness : high) + most);
    const double from = angles.low(error);
    return {{from, low * scale_of_cosines, 0},
            {from + angles.length(error), high * scale_of_cosines, 0}};
}

bool AxialView::Wanted::meets(const Bounds& entity) const {
    if (entity.low[1] > bounds.high[1] || bounds.low[1] > entity.high[1]) return false;
    for (const double shift : {-turn, 0.0, turn}) {
        if (entity.low[0] <= bounds.high[0] + shift && bounds.low[0] + shift <= entity.high[0]) {
            return true;
        }
    }
    return false;
}

}  // namespace octetra::verify
