#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include <octetra/core/edge_order.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/compare.hpp>

#include "properties/draw.hpp"
#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/refinement.hpp"

namespace octetra::properties {
namespace {

using Map = std::function<Point(const Point&)>;

/// The selection as a list of the cells that it marks at the first level.
Selection by_number(const Case& c) {
    Selection selection;
    for (CellIndex i{0}; i < c.mesh.cells.end_index(); ++i) {
        const Marker region = c.mesh.regions.empty() ? 0 : c.mesh.regions[i];
        if (marks(c.selection, test::corners_of(c.mesh, i), region, GlobalCell{i.value()})) {
            selection.cells.push_back(GlobalCell{i.value()});
        }
    }
    return selection;
}

/// Applies `map`, a scaling by `factor` and a translation.
Case mapped(const Case& c, const Map& map, double factor) {
    Case r = c;
    for (Point& p : r.mesh.points) p = map(p);
    for (Sphere& s : r.selection.spheres) s = {map(s.centre), s.radius * factor};
    for (Box& b : r.selection.boxes) b = {map(b.low), map(b.high)};
    if (r.selection.max_volume) *r.selection.max_volume *= factor * factor * factor;
    return r;
}

std::string fault_of_map(const Case& c, const Map& map, double factor) {
    Case plain = c;
    const Selection& s = plain.selection;
    // Random criteria and expressions use coordinates.
    if (s.random || !s.where.empty() || !s.narrowed_by.empty()) plain.selection = by_number(plain);
    const Outcome one = refined_by_all(plain);
    const Outcome other = refined_by_all(mapped(plain, map, factor));
    if (!one.error.empty() || !other.error.empty()) return one.error + other.error;
    Mesh expected = one.mesh;
    for (Point& p : expected.points) p = map(p);
    if (!(other.mesh == expected)) return "not the same, scaled or moved";
    return {};
}

std::string fault_of_scaling(const Case& c, Draw& draw) {
    const double factor = std::ldexp(1.0, draw.between(-250, 250));
    return fault_of_map(
        c,
        [&](const Point& p) {
            return Point{p.x * factor, p.y * factor, p.z * factor};
        },
        factor);
}

/// The least and the greatest power of two by which all coordinates of a mesh can be multiplied
/// exactly.
std::pair<int, int> exact_scales(const Mesh& mesh) {
    constexpr int digits = std::numeric_limits<double>::digits;
    constexpr int lowest = std::numeric_limits<double>::min_exponent - digits;  // of a last bit
    constexpr int highest = std::numeric_limits<double>::max_exponent - 2;      // of a first bit
    std::pair<int, int> scales{-2000, 2000};
    for (const Point& p : mesh.points) {
        for (const double x : {p.x, p.y, p.z}) {
            if (x == 0) continue;
            const auto integer =
                static_cast<std::int64_t>(std::scalbn(x, digits - 1 - std::ilogb(x)));
            const int last = std::countr_zero(static_cast<std::uint64_t>(integer)) -
                             (digits - 1 - std::ilogb(x));
            scales.first = std::max(scales.first, lowest - last);
            scales.second = std::min(scales.second, highest - std::ilogb(x));
        }
    }
    return scales;
}

/// Scales until squared lengths overflow or lose digits. Cells are marked by number, because radii
/// and volumes may not be representable.
std::string fault_of_extreme_scaling(const Case& c, Draw& draw) {
    Case plain = c;
    plain.selection = by_number(c);
    const Outcome one = refined_by_all(plain);
    if (!one.error.empty()) return one.error;
    const auto [least, most] = exact_scales(one.mesh);
    if (least > most) return {};
    const int exponent = draw.below(2) == 0 ? least + static_cast<int>(draw.below(60))
                                            : most - static_cast<int>(draw.below(500));
    return fault_of_map(
        plain,
        [&](const Point& p) {
            return Point{std::scalbn(p.x, exponent), std::scalbn(p.y, exponent),
                         std::scalbn(p.z, exponent)};
        },
        1);
}

std::string fault_of_translation(const Case& c, Draw& draw) {
    constexpr int far = 1 << 20;
    const Point by{static_cast<double>(draw.between(-far, far)),
                   static_cast<double>(draw.between(-far, far)),
                   static_cast<double>(draw.between(-far, far))};
    return fault_of_map(
        c,
        [&](const Point& p) {
            return Point{p.x + by.x, p.y + by.y, p.z + by.z};
        },
        1);
}

/// Ties are broken by coordinates, which a mirror exchanges. The regular closure orders the edges
/// of cells that uniform refinement makes.
bool meets_ties(const Case& c) {
    const bool is_regular = c.closure == Closure::regular;
    const Selection selection = is_regular ? Selection{.all = true} : c.selection;
    for (int level = 0; level < c.levels; ++level) {
        if (test::has_ties(reference::refine(c.mesh, selection, c.scheme, level).mesh)) return true;
    }
    return false;
}

/// Mirrors, and exchanges corners so that cells stay positively oriented.
Mesh mirrored(Mesh mesh, std::size_t axis) {
    for (Point& p : mesh.points) {
        double& x = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
        x = -x;
    }
    for (CellVertices& cell : mesh.cells) std::swap(cell[2], cell[3]);
    return mesh;
}

std::string fault_of_mirror(const Case& c, Draw& draw) {
    Case plain = c;
    plain.selection = by_number(c);
    if (meets_ties(plain)) plain.levels = 1;
    if (meets_ties(plain)) return {};
    const std::size_t axis = draw.below(3);
    Case other_case = plain;
    other_case.mesh = mirrored(plain.mesh, axis);
    const Outcome one = refined_by_all(plain);
    const Outcome other = refined_by_all(other_case);
    if (!one.error.empty() || !other.error.empty()) return one.error + other.error;
    if (verify::compare(mirrored(one.mesh, axis), other.mesh).likeness ==
        verify::Likeness::different) {
        return "not the same, mirrored";
    }
    return {};
}

}  // namespace

std::string fault_of_geometry(const Case& c) {
    Draw draw(c.seed);
    switch (draw.below(4)) {
        case 0: return fault_of_scaling(c, draw);
        case 1: return fault_of_extreme_scaling(c, draw);
        case 2: return fault_of_translation(c, draw);
        default: return fault_of_mirror(c, draw);
    }
}

}  // namespace octetra::properties
