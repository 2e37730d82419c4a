#include <octetra/core/selection.hpp>

#include <octetra/core/mean_of_four.hpp>
#include <octetra/core/select_cells.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {
namespace {

/// The type for repeating a computation in which a double overflows or underflows.
using Wide = long double;
static_assert(std::numeric_limits<Wide>::max_exponent >
              4 * std::numeric_limits<double>::max_exponent);

/// Computes products in Float and records whether one was denormal or rounded to zero.
template <class Float>
struct Products {
    bool underflow = false;

    Float operator()(Float a, Float b) {
        const Float product = a * b;
        if (std::abs(product) < std::numeric_limits<Float>::min() && a != 0 && b != 0) {
            underflow = true;
        }
        return product;
    }
};

void put_in_order(double& a, double& b) {
    const double less = b < a ? b : a;
    b = b < a ? a : b;
    a = less;
}

/// Returns whether p is nearer to the centre than the radius, or nothing if Float cannot decide.
template <class Float>
std::optional<bool> is_nearer(const Sphere& sphere, const Point& p) {
    const Float dx = Float{p.x} - sphere.centre.x;
    const Float dy = Float{p.y} - sphere.centre.y;
    const Float dz = Float{p.z} - sphere.centre.z;
    Products<Float> product;
    const Float distance = (product(dx, dx) + product(dy, dy)) + product(dz, dz);
    const Float radius = product(sphere.radius, sphere.radius);
    if (product.underflow || !std::isfinite(distance) || !std::isfinite(radius)) return {};
    return distance < radius;
}

bool contains(const Sphere& sphere, const Point& p) {
    if (!std::isfinite(sphere.radius)) return sphere.radius > 0;
    const auto nearer = is_nearer<double>(sphere, p);
    return nearer ? *nearer : *is_nearer<Wide>(sphere, p);
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
    // Adding +0.0 turns -0.0 into +0.0, because equal numbers must have equal hashes.
    for (const double c : {p.x, p.y, p.z}) h = scramble(h ^ std::bit_cast<std::uint64_t>(c + 0.0));
    return h;
}

bool draws(const RandomShare& random, const Corners& corners) {
    std::uint64_t sum = 0;  // a sum does not depend on the order of the corners
    for (const Point& p : corners) sum += hash(p);
    const std::uint64_t bits = scramble(scramble(random.seed) ^ sum);
    constexpr double two_to_minus_53 = 0x1p-53;
    return static_cast<double>(bits >> 11U) * two_to_minus_53 < random.fraction;
}

/// Returns six times the volume of corners in a fixed order, or nothing if Float cannot represent
/// it.
template <class Float>
std::optional<Float> six_volumes(const Corners& sorted) {
    const auto& [a, b, c, d] = sorted;
    const std::array<Float, 3> u{Float{b.x} - a.x, Float{b.y} - a.y, Float{b.z} - a.z};
    const std::array<Float, 3> v{Float{c.x} - a.x, Float{c.y} - a.y, Float{c.z} - a.z};
    const std::array<Float, 3> w{Float{d.x} - a.x, Float{d.y} - a.y, Float{d.z} - a.z};
    Products<Float> product;
    const Float determinant = product(u[0], product(v[1], w[2]) - product(v[2], w[1])) -
                              product(u[1], product(v[0], w[2]) - product(v[2], w[0])) +
                              product(u[2], product(v[0], w[1]) - product(v[1], w[0]));
    if (product.underflow || !std::isfinite(determinant)) return {};
    return std::abs(determinant);
}

Corners in_order(Corners corners) {
    std::ranges::sort(corners, std::less<>{});
    return corners;
}

bool is_larger(const Corners& corners, double limit) {
    const Corners sorted = in_order(corners);
    const auto narrow = six_volumes<double>(sorted);
    return narrow ? *narrow / 6 > limit : *six_volumes<Wide>(sorted) / 6 > limit;
}

}  // namespace

double mean_of_four(double a, double b, double c, double d) {
    put_in_order(a, b);
    put_in_order(c, d);
    put_in_order(a, c);
    put_in_order(b, d);
    put_in_order(b, c);
    const double sum = ((a + b) + c) + d;
    if (std::isfinite(sum)) return sum / 4;
    return static_cast<double>(((Wide{a} + b) + c + d) / 4);
}

Point centroid(const Corners& corners) {
    const auto& [a, b, c, d] = corners;
    return {mean_of_four(a.x, b.x, c.x, d.x), mean_of_four(a.y, b.y, c.y, d.y),
            mean_of_four(a.z, b.z, c.z, d.z)};
}

double volume(const Corners& corners) {
    const Corners sorted = in_order(corners);
    const auto narrow = six_volumes<double>(sorted);
    return narrow ? *narrow / 6 : static_cast<double>(*six_volumes<Wide>(sorted) / 6);
}

bool marks_by_criteria(const Selection& selection, const Corners& corners, Marker region,
                       GlobalCell root) {
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
    return selection.max_volume && is_larger(corners, *selection.max_volume);
}

bool marks(const Selection& selection, const Corners& corners, Marker region, GlobalCell root) {
    if (!is_compound(selection)) return marks_by_criteria(selection, corners, region, root);
    const SelectedCells selected = select_cells(selection, 1,
                                                [&](std::size_t) {
                                                    return CellToTest{corners, region, root};
                                                },
                                                {});
    if (!selected.undefined.empty()) {
        throw InputError(
            fmt::format("{}: the expression has no value in a cell",
                        expressions_of(selection)[selected.undefined[0].expression]->text()));
    }
    return selected.marks[0] != 0;
}

}  // namespace octetra
