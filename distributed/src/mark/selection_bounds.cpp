#include "mark/selection_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace octetra::distributed {
namespace {

/// A lower bound on the result of centroid() for four coordinates that are at least `bound`: its
/// sums are rounded, but monotone, and on overflow it computes more exactly.
double least_mean(double bound) {
    const double mean = (((bound + bound) + bound) + bound) / 4;
    return std::isfinite(mean) ? std::min(mean, bound) : bound;
}
double greatest_mean(double bound) { return -least_mean(-bound); }

template <class Float>
Float squared_distance(const Point& a, const Point& b) {
    const Float dx = Float{a.x} - b.x;
    const Float dy = Float{a.y} - b.y;
    const Float dz = Float{a.z} - b.z;
    return (dx * dx + dy * dy) + dz * dz;
}

bool may_hold(const Sphere& sphere, const Box& centroids) {
    const Point& c = sphere.centre;
    const Point nearest{std::clamp(c.x, centroids.low.x, centroids.high.x),
                        std::clamp(c.y, centroids.low.y, centroids.high.y),
                        std::clamp(c.z, centroids.low.z, centroids.high.z)};
    const double distance = squared_distance<double>(nearest, c);
    const double radius = sphere.radius * sphere.radius;
    if (distance < radius) return true;
    // marks() uses long double if a result over- or underflows. That matters for points on the
    // surface of the sphere, and for very small or very large spheres.
    constexpr double a_little = 1 + 0x1p-40;
    constexpr double small = 0x1p-900;
    if (radius > small && distance > radius * a_little) return false;
    return squared_distance<long double>(nearest, c) <
           static_cast<long double>(sphere.radius) * sphere.radius;
}

bool may_hold(const Box& box, const Box& centroids) {
    const Point& low = centroids.low;
    const Point& high = centroids.high;
    return low.x <= box.high.x && box.low.x <= high.x && low.y <= box.high.y &&
           box.low.y <= high.y && low.z <= box.high.z && box.low.z <= high.z;
}

/// Returns a cube that contains every point which marks() considers inside the sphere: its computed
/// distance is too small by a few rounding errors at most.
Box box_round(const Sphere& sphere) {
    const double radius = std::abs(sphere.radius) * (1 + 0x1p-50);
    const auto below = [&](double c) { return std::nextafter(c - radius, -infinity); };
    const auto above = [&](double c) { return std::nextafter(c + radius, infinity); };
    const Point& c = sphere.centre;
    return {{below(c.x), below(c.y), below(c.z)}, {above(c.x), above(c.y), above(c.z)}};
}

}  // namespace

bool may_be_marked(const Selection& selection, const Box& corners) {
    // For a centroid that is farther away, marks() computes results that are no smaller, since
    // rounding is monotone.
    const auto& [low, high] = corners;
    const Box centroids{{least_mean(low.x), least_mean(low.y), least_mean(low.z)},
                        {greatest_mean(high.x), greatest_mean(high.y), greatest_mean(high.z)}};
    const auto may_hold_one = [&](const auto& body) { return may_hold(body, centroids); };
    return std::ranges::any_of(selection.spheres, may_hold_one) ||
           std::ranges::any_of(selection.boxes, may_hold_one);
}

// A centroid is not outside the bounding box of its corners: rounded sums are monotone, and exact
// for four equal numbers.
SelectionBounds::SelectionBounds(const Selection& selection) {
    const auto include = [this](const Box& box) {
        extend(reach_, box.low);
        extend(reach_, box.high);
    };
    for (const Sphere& sphere : selection.spheres) {
        include(box_round(sphere));
        // Centroids are in the bounding box of the corners, and the relative error of distances is
        // much smaller than this margin.
        constexpr double smaller = 1 - 0x1p-20;
        const double radius = sphere.radius * smaller;
        const bool is_ordinary = radius > 0x1p-400 && radius < 0x1p400;  // so its square is normal
        if (is_ordinary) balls_.push_back({sphere.centre, radius * radius});
    }
    for (const Box& box : selection.boxes) include(box);
    boxes_ = selection.boxes;
}

}  // namespace octetra::distributed
