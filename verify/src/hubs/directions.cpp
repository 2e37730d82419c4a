#include "hubs/directions.hpp"

#include <cmath>

namespace octetra::verify {
namespace {

Vector plus(const Vector& u, const Vector& v) { return {u[0] + v[0], u[1] + v[1], u[2] + v[2]}; }
/// Returns u without its component along v, which has length 1.
Vector part_across(const Vector& u, const Vector& v) {
    const double along = dot(u, v);
    return {u[0] - along * v[0], u[1] - along * v[1], u[2] - along * v[2]};
}

constexpr Direction unknown{{}, 1};

/// A difference has a relative error of one rounding, whatever its size, and so does the result.
/// The direction is unknown for a difference that is 0 or too large.
Direction direction_between(const Point& from, const Point& to) {
    Vector v{to.x - from.x, to.y - from.y, to.z - from.z};
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    if (largest == 0 || std::isinf(largest)) return unknown;
    for (double& x : v) x /= largest;
    return {times(v, 1 / std::sqrt(dot(v, v))), few_roundings};
}

}  // namespace

Viewpoint::Viewpoint(const Point& a, const Point& b) : origin_(a), axis_(direction_between(a, b)) {}

Direction Viewpoint::towards(const Point& p) const {
    const Direction direction = direction_between(origin_, p);
    if (!axis_ || !direction.is_known()) return direction;
    if (!axis_->is_known()) return unknown;
    const Vector across = part_across(direction.unit, axis_->unit);
    const double length = std::sqrt(dot(across, across));
    // Both unit vectors have this error, which is amplified by the normalisation of the remainder.
    const double error = 8 * few_roundings;
    if (length < 16 * error) return unknown;
    return {times(across, 1 / length), 2 * error / length};
}

Bounds bounds_of_directions(std::span<const Direction> directions) {
    Bounds bounds;
    for (const Direction& d : directions) {
        if (!d.is_known()) {
            bounds.take(Point{-1, -1, -1});
            bounds.take(Point{1, 1, 1});
            continue;
        }
        const auto& [x, y, z] = d.unit;
        bounds.take(Point{x - d.error, y - d.error, z - d.error});
        bounds.take(Point{x + d.error, y + d.error, z + d.error});
    }
    return bounds;
}

double least_cosine(std::span<const Direction> rays) {
    double error = 0;
    for (const Direction& ray : rays) {
        if (!ray.is_known()) return 0;
        error = std::max(error, ray.error);
    }
    double best = 0;
    const auto try_middle = [&](const Vector& sum) {
        const double length = std::sqrt(dot(sum, sum));
        if (length == 0) return;
        double least = 1;
        for (const Direction& ray : rays) least = std::min(least, dot(sum, ray.unit) / length);
        best = std::max(best, least - 2 * (error + few_roundings));
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) try_middle(plus(rays[i].unit, rays[k].unit));
    }
    if (rays.size() == 1) try_middle(rays[0].unit);
    if (rays.size() == 3) try_middle(plus(plus(rays[0].unit, rays[1].unit), rays[2].unit));
    return best;
}

Cone::Cone(std::span<const Direction> rays) : count_(rays.size()) {
    const double least = least_cosine(rays);
    if (least < 0x1p-10) return;
    tightness_ = least;
    for (std::size_t k = 0; k < count_; ++k) {
        rays_[k] = rays[k].unit;
        error_ = std::max(error_, rays[k].error);
    }
    add_planes();
}

void Cone::add_planes() {
    if (count_ == 2) {
        planes_[plane_count_++] = cross(rays_[0], rays_[1]);
    } else if (count_ == 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector normal = cross(rays_[(k + 1) % 3], rays_[(k + 2) % 3]);
            planes_[plane_count_++] = times(normal, dot(normal, rays_[k]) > 0 ? -1 : 1);
        }
    }
}

/// Returns whether a plane through 0 has the box on one side, and the cone on the other or within
/// it. The cone may exceed the plane by its error; the plane is then tilted about 0 until it does
/// not, which reduces the distance of a unit vector in the box by at most that excess divided by
/// the tightness.
bool Cone::is_cut_off_by(const Vector& normal, const Bounds& box) const {
    const double size = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
    double nearest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        nearest += normal[k] * (normal[k] > 0 ? box.low[k] : box.high[k]);
    }
    double over = 0;
    for (std::size_t k = 0; k < count_; ++k) over = std::max(over, dot(normal, rays_[k]));
    over += (error_ + few_roundings) * size;
    return nearest > 2 * over / tightness_;
}

/// Tests the planes of the cone's sides, and those through each ray along each side of the box: a
/// box that misses the line of a ray is separated by one of these.
bool Cone::misses(const Bounds& box) const {
    if (tightness_ == 0) return false;
    Vector centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = (box.low[k] + box.high[k]) / 2;
    const auto cuts_off = [&](const Vector& normal, bool may_turn) {
        const bool turned = may_turn && dot(normal, centre) < 0;
        return is_cut_off_by(turned ? times(normal, -1) : normal, box);
    };
    for (std::size_t k = 0; k < plane_count_; ++k) {
        if (cuts_off(planes_[k], count_ == 2)) return true;
    }
    for (std::size_t k = 0; k < count_; ++k) {
        const auto& [x, y, z] = rays_[k];
        if (cuts_off({0, -z, y}, true) || cuts_off({z, 0, -x}, true) || cuts_off({-y, x, 0}, true))
            return true;
    }
    return false;
}

}  // namespace octetra::verify
