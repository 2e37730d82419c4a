#include "measures/angles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "exact/angles.hpp"

namespace octetra::verify {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

Point difference(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Point& u, const Point& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
Point cross(const Point& u, const Point& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
double length(const Point& u) { return std::sqrt(dot(u, u)); }
double angle(const Point& u, const Point& v) { return std::atan2(length(cross(u, v)), dot(u, v)); }

/// The shape of a cell, in quantities that need no transcendental functions and increase or
/// decrease with the angles: of millions of cells, the extreme ones are converted.
struct CellShape {
    double most_cot = -infinity;   ///< cotangent of the smallest dihedral angle
    double least_cot = infinity;   ///< cotangent of the largest one
    double most_half = -infinity;  ///< cotangent of half the smallest solid angle
    double eta_cubed = infinity;

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Retains the smaller, and of dihedral angles also the larger, of two angles and eta.
    void take(const CellShape& other) {
        most_cot = std::max(most_cot, other.most_cot);
        least_cot = std::min(least_cot, other.least_cot);
        most_half = std::max(most_half, other.most_half);
        eta_cubed = std::min(eta_cubed, other.eta_cubed);
    }
};

/// Returns the angle, from 0 to pi, with this cotangent.
double angle_of_cot(double cot) { return std::atan2(1.0, cot); }

template <std::size_t N>
struct Normalised {
    std::array<Point, N> corners;
    double scale = 1;  ///< factor by which lengths were multiplied
};

/// Translates to the origin and, unless it is between 2^-30 and 2^30, scales the size to about 1,
/// so that no product over- or underflows.
template <std::size_t N>
Normalised<N> normalised(std::array<Point, N> p) {
    const auto multiply_by = [&p](double factor) {
        for (Point& q : p) q = {q.x * factor, q.y * factor, q.z * factor};
    };
    const auto largest = [&p] {
        double size = 0;
        for (const Point& q : p)
            size = std::max({size, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
        return size;
    };
    // Differences of the largest numbers would overflow.
    const double beforehand = largest() > 0x1p1000 ? 0x1p-4 : 1;
    if (beforehand != 1) multiply_by(beforehand);
    const Point origin = p[0];
    for (Point& q : p) q = difference(q, origin);
    if (const double size = largest(); size < 0x1p30 && size > 0x1p-30) return {p, beforehand};
    constexpr int least_exponent = -1000;
    const double factor = std::ldexp(1.0, -std::max(std::ilogb(largest()), least_exponent));
    multiply_by(factor);
    return {p, beforehand * factor};
}

CellShape shape_of(const std::array<Point, 4>& corners) {
    const std::array<Point, 4> p = normalised(corners).corners;
    std::array<Point, 4> normal;  // outward normal of the face opposite each corner
    for (std::size_t k = 0; k < 4; ++k) {
        constexpr std::array<std::array<std::size_t, 3>, 4> outward{
            {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
        const auto& [a, b, c] = outward[k];
        normal[k] = cross(difference(p[b], p[a]), difference(p[c], p[a]));
    }
    CellShape shape;
    double squares = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        const auto [c, d] = cell_edges[5 - k];  // edge ij lies in the faces opposite c and d
        const double sine = length(cross(normal[c], normal[d]));
        const double cosine = dot(normal[c], normal[d]);
        // The normals enclose pi less the angle; without a direction they count as parallel.
        const double cot = sine == 0 && cosine == 0 ? -CellShape::infinity : -cosine / sine;
        shape.most_cot = std::max(shape.most_cot, cot);
        shape.least_cot = std::min(shape.least_cot, cot);
        const Point edge = difference(p[i], p[j]);
        squares += dot(edge, edge);
    }
    const double volume6 = std::max(0.0, -dot(difference(p[3], p[0]), normal[3]));
    for (std::size_t k = 0; k < 4; ++k) {
        // The tangent of half the solid angle between vectors u, v, w is their determinant divided
        // by |u| |v| |w| + (u.v) |w| + (u.w) |v| + (v.w) |u|.
        const Point u = difference(p[(k + 1) % 4], p[k]);
        const Point v = difference(p[(k + 2) % 4], p[k]);
        const Point w = difference(p[(k + 3) % 4], p[k]);
        const std::array<double, 3> lengths{length(u), length(v), length(w)};
        const double cosine = lengths[0] * lengths[1] * lengths[2] + dot(u, v) * lengths[2] +
                              dot(u, w) * lengths[1] + dot(v, w) * lengths[0];
        shape.most_half = std::max(shape.most_half, cosine / volume6);
    }
    shape.eta_cubed = 432 * volume6 * volume6 / (squares * squares * squares);
    return shape;
}

void for_each_positive(const JudgedMesh& judged, auto&& visit) {
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        if (judged.sign[c.value()] <= 0 || !judged.owns(judged.mesh.cells[c])) continue;
        visit(c, shape_of(judged.corners(c)));
    }
}

/// The extremes of the cells of a process.
struct Extremes {
    CellShape shape{};
    CellIndex least_at = CellIndex::none();  ///< the first cell with the smallest dihedral angle

    void take(CellIndex c, const CellShape& other) {
        if (other.most_cot > shape.most_cot) least_at = c;
        shape.take(other);
    }
};

/// Collective. Quantities are reduced before they are converted, because the rounding of a
/// conversion may reverse the order of two numbers that are nearly equal.
AngleFigures figures_of(const Extremes& own, const ProcessGroup& group) {
    const CellShape shape = reduce(group, own.shape, [](CellShape a, const CellShape& b) {
        a.take(b);
        return a;
    });
    AngleFigures figures{
        .min_dihedral = 180, .max_dihedral = 0, .min_solid = 4 * std::numbers::pi, .min_eta = 1};
    if (shape.least_cot == CellShape::infinity) return figures;  // there are no cells
    figures.min_dihedral = angle_of_cot(shape.most_cot) * degrees_per_radian;
    figures.min_dihedral_at =
        own.shape.most_cot == shape.most_cot ? own.least_at : CellIndex::none();
    figures.max_dihedral = angle_of_cot(shape.least_cot) * degrees_per_radian;
    figures.min_solid = 2 * angle_of_cot(shape.most_half);
    figures.min_eta = std::min(1.0, std::cbrt(shape.eta_cubed));  // 1 for regular cells
    return figures;
}

std::array<Point, 3> triangle(const FacetVertices& v, const Mesh& mesh) {
    return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
}

/// Returns whether a face of the fine mesh has the vertices of a face of the coarse one.
bool is_undivided(const FacetVertices& fine, const FacetVertices& coarse, const Descent& descent) {
    return std::all_of(coarse.begin(), coarse.end(), [&](VertexIndex v) {
        return std::find(fine.begin(), fine.end(), descent.coarse_to_fine[v]) != fine.end();
    });
}

double smallest_angle(const std::array<Point, 3>& triangle) {
    const std::array<Point, 3> t = normalised(triangle).corners;
    double smallest = std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
        smallest = std::min(
            smallest, angle(difference(t[(k + 1) % 3], t[k]), difference(t[(k + 2) % 3], t[k])));
    }
    return smallest;
}

/// The amount by which rounding may reduce an angle of the piece: each of its edges turns by at
/// most asin(2 eta / its length) <= pi eta / its length. Rounded lengths, with a relative error of
/// some 2^-52, may also cause the second longest edge of a face to be bisected; a larger constant
/// covers this.
double angle_slack(const std::array<Point, 3>& piece, double rounding) {
    const auto [p, scale] = normalised(piece);
    const double eta = std::sqrt(3.0) * rounding * scale;
    double shortest = length(difference(p[0], p[1]));
    for (std::size_t k = 1; k < 3; ++k) {
        shortest = std::min(shortest, length(difference(p[k], p[(k + 1) % 3])));
    }
    constexpr double of_lengths = 1e-12;
    return of_lengths + 2 * std::numbers::pi * eta / shortest;
}

}  // namespace

AngleFigures measure_angles(const JudgedMesh& judged, const ProcessGroup& group) {
    Extremes own;
    for_each_positive(judged, [&](CellIndex c, const CellShape& shape) { own.take(c, shape); });
    return figures_of(own, group);
}

AnglesByDepth measure_by_depth(const JudgedMesh& fine, const Descent& descent,
                               const ProcessGroup& group) {
    constexpr std::size_t depths = 256;
    std::vector<std::uint64_t> cells(depths, 0);
    std::array<CellShape, depths> by_depth;
    Extremes own;
    for_each_positive(fine, [&](CellIndex c, const CellShape& shape) {
        ++cells[descent.depth[c]];
        by_depth[descent.depth[c]].take(shape);
        own.take(c, shape);
    });
    by_depth = reduce(group, by_depth, [](auto a, const auto& b) {
        for (std::size_t depth = 0; depth < depths; ++depth) a[depth].take(b[depth]);
        return a;
    });
    AnglesByDepth angles{figures_of(own, group), {}};
    for (std::size_t depth = 0; depth < depths; ++depth) {
        if (cells[depth] == 0) continue;
        angles.by_depth.push_back(
            {.depth = static_cast<int>(depth),
             .cells = cells[depth],
             .min_dihedral = angle_of_cot(by_depth[depth].most_cot) * degrees_per_radian,
             .min_eta = std::min(1.0, std::cbrt(by_depth[depth].eta_cubed))});
    }
    return angles;
}

std::string check_dihedral_angles(const JudgedMesh& judged, double degrees, Findings& findings) {
    const exact::AngleLimit limit(degrees);
    Steps step(findings, judged.mesh.cells.size());
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        step();
        if (judged.sign[c.value()] <= 0 || !judged.owns(judged.mesh.cells[c])) continue;
        const auto p = judged.corners(c);
        bool less = false;
        for (std::size_t k = 0; k < 6 && !less; ++k) {
            const auto [i, j] = cell_edges[k];
            const auto [m, n] = cell_edges[5 - k];
            less = limit.exceeds_dihedral(p[i], p[j], p[m], p[n], findings.arithmetic());
        }
        if (!less) continue;
        findings.add(Code::dihedral_too_small, [&]() -> Findings::Description {
            const double found = angle_of_cot(shape_of(p).most_cot) * degrees_per_radian;
            const bool shows = found <= degrees * (1 - 1e-5);
            return {{entity(c, judged.which)},
                    shows ? fmt::format("{:.6g} degrees", found)
                          : fmt::format("less, by under {:.1g} degrees", degrees * 1e-5),
                    fmt::format("at least {} degrees", degrees)};
        });
    }
    return fmt::format("none under {} degrees, exactly", degrees);
}

std::string check_face_angles(const JudgedMesh& coarse, const JudgedMesh& fine,
                              const Descent& descent, Findings& findings) {
    std::uint64_t by_slack = 0;
    Steps step(findings, 2 * fine.mesh.cells.size());  // most faces have two cells
    fine.faces.for_each_group([&](const FacetVertices& face, auto entries) {
        step();
        const CellFace f = cell_face(entries.front().tag);
        const auto on = descent.coarse_face(f);
        if (!on || !fine.owns(face)) return;
        const FacetVertices parent = outward_face(coarse.mesh.cells[on->cell], on->face);
        if (is_undivided(face, parent, descent)) {
            ++findings.arithmetic().filtered;
            return;
        }
        const auto piece = triangle(face, fine.mesh);
        const auto whole = triangle(parent, coarse.mesh);
        if (exact::keeps_half_of_smallest_angle(piece, whole, findings.arithmetic())) return;

        double rounding = 0;
        for (const VertexIndex v : face) rounding = std::max(rounding, descent.rounding[v]);
        const double found = smallest_angle(piece);
        const double expected = smallest_angle(whole) / 2;
        if (found >= expected - angle_slack(piece, rounding)) {
            ++by_slack;
            return;
        }
        findings.add(Code::face_angle_too_small, [&]() -> Findings::Description {
            return {{entity(face), entity(parent, Which::coarse)},
                    fmt::format("{:.9g} degrees", found * degrees_per_radian),
                    fmt::format("at least {:.9g}, half of the coarse face's smallest",
                                expected * degrees_per_radian)};
        });
    });
    by_slack = sum(findings.group(), by_slack);
    if (by_slack == 0) return "exactly";
    return fmt::format("{} of them only up to rounding", by_slack);
}

}  // namespace octetra::verify
