#include <octetra/core/selection.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

namespace octetra {
namespace {

double mean_of_four(double a, double b, double c, double d) {
    std::array<double, 4> v{a, b, c, d};
    std::ranges::sort(v);
    return (((v[0] + v[1]) + v[2]) + v[3]) / 4;
}

bool contains(const Sphere& sphere, const Point& p) {
    const double dx = p.x - sphere.centre.x;
    const double dy = p.y - sphere.centre.y;
    const double dz = p.z - sphere.centre.z;
    return (dx * dx + dy * dy) + dz * dz < sphere.radius * sphere.radius;
}

bool contains(const Box& box, const Point& p) {
    return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y &&
           box.low.z <= p.z && p.z <= box.high.z;
}

/// Scrambles 64 bits so that each input bit moves about half of the output bits
/// (the finaliser of SplitMix64; Steele, Lea, Flood 2014).
std::uint64_t scramble(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

std::uint64_t hash(const Point& p) {
    std::uint64_t h = 0;
    // Adding +0.0 turns -0.0 into +0.0, which compares equal to it and so must hash alike.
    for (const double c : {p.x, p.y, p.z}) h = scramble(h ^ std::bit_cast<std::uint64_t>(c + 0.0));
    return h;
}

bool draws(const RandomShare& random, const Corners& corners) {
    std::uint64_t sum = 0;  // a sum, so that the order of the corners does not matter
    for (const Point& p : corners) sum += hash(p);
    const std::uint64_t lot = scramble(scramble(random.seed) ^ sum);
    constexpr double two_to_minus_53 = 0x1p-53;
    return static_cast<double>(lot >> 11U) * two_to_minus_53 < random.fraction;
}

}  // namespace

Point centroid(const Corners& corners) {
    const auto& [a, b, c, d] = corners;
    return {mean_of_four(a.x, b.x, c.x, d.x), mean_of_four(a.y, b.y, c.y, d.y),
            mean_of_four(a.z, b.z, c.z, d.z)};
}

double volume(const Corners& corners) {
    Corners sorted = corners;
    std::ranges::sort(sorted, std::less<>{});
    const auto& [a, b, c, d] = sorted;
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
    const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
    const Point w{d.x - a.x, d.y - a.y, d.z - a.z};
    const double determinant = u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
                               u.z * (v.x * w.y - v.y * w.x);
    return std::abs(determinant) / 6;
}

bool chooses(const Selection& selection, const Corners& corners, Marker region, GlobalCell root) {
    if (selection.all) return true;
    if (std::ranges::find(selection.regions, region) != selection.regions.end()) return true;
    if (std::ranges::binary_search(selection.cells, root)) return true;
    if (!selection.spheres.empty() || !selection.boxes.empty()) {
        const Point centre = centroid(corners);
        const auto holds_centre = [&](const auto& body) { return contains(body, centre); };
        if (std::ranges::any_of(selection.spheres, holds_centre)) return true;
        if (std::ranges::any_of(selection.boxes, holds_centre)) return true;
    }
    if (selection.random && draws(*selection.random, corners)) return true;
    return selection.max_volume && volume(corners) > *selection.max_volume;
}

}  // namespace octetra
