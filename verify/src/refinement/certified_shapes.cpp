#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "exact/angles.hpp"
#include "exact/mean_ratio.hpp"
#include "measures/rounding_bounds.hpp"
#include "parts/exchange.hpp"
#include "refinement/checks.hpp"
#include "shapes/certificates.hpp"

namespace octetra::verify {
namespace {

using CellCorners = std::array<Point, 4>;

/// The bounds of the dihedral angles of a cell.
class DihedralLimits {
public:
    DihedralLimits(double least, double greatest)
        : least_(least), above_greatest_(std::nextafter(greatest, 360.0)) {}

    /// Decides exactly.
    [[nodiscard]] bool hold_for(const CellCorners& p, Arithmetic& arithmetic) const {
        for (std::size_t k = 0; k < 6; ++k) {
            const auto [i, j] = cell_edges[k];
            const auto [m, n] = cell_edges[5 - k];
            if (least_.exceeds_dihedral(p[i], p[j], p[m], p[n], arithmetic)) return false;
            if (!above_greatest_.exceeds_dihedral(p[i], p[j], p[m], p[n], arithmetic)) return false;
        }
        return true;
    }

private:
    exact::AngleLimit least_;
    exact::AngleLimit above_greatest_;
};

/// Returns an upper bound, in degrees, of the change of a dihedral angle by the rounding of
/// vertices. A normal, as the cross product of two edges, deviates by at most 2 e (L + e), where e
/// is the error of an edge, and L the longest edge; so it turns by at most the arc sine of the
/// ratio of this to its length, which is less than pi / 2 times the ratio. A dihedral angle is that
/// between two normals.
double angle_error(const Shape<4>& shape) {
    Bound least_normal = std::numeric_limits<Bound>::infinity();
    for (const auto& face : cell_faces) {
        const Point& from = shape.corners[face[0]];
        const auto vector = [&](const Point& to) {
            return std::array<Bound, 3>{Bound{to.x} - from.x, Bound{to.y} - from.y,
                                        Bound{to.z} - from.z};
        };
        const auto u = vector(shape.corners[face[1]]);
        const auto v = vector(shape.corners[face[2]]);
        const Bound x = u[1] * v[2] - u[2] * v[1];
        const Bound y = u[2] * v[0] - u[0] * v[2];
        const Bound z = u[0] * v[1] - u[1] * v[0];
        least_normal = std::min(least_normal, std::sqrt(x * x + y * y + z * z));
    }
    const Bound turned = 2 * shape.edge_error() * (shape.longest_edge() + shape.edge_error());
    return static_cast<double>(2 * 90 * turned / least_normal * up);
}

/// Returns an upper bound of the mean ratio of the cell with exact midpoints. Six times the volume
/// deviates by at most volume_bound(), and a squared length by at most e (2 L + e).
double exact_mean_ratio_at_most(const Shape<4>& shape) {
    const auto& p = shape.corners;
    std::array<std::array<Bound, 3>, 3> rows{};
    Bound squares = 0;
    for (const auto& [i, j] : cell_edges) {
        const std::array<Bound, 3> edge{Bound{p[j].x} - p[i].x, Bound{p[j].y} - p[i].y,
                                        Bound{p[j].z} - p[i].z};
        squares += edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2];
        if (i == 0) rows.at(j - 1U) = edge;
    }
    const auto& [u, v, w] = rows;
    const Bound volume = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                         u[2] * (v[0] * w[1] - v[1] * w[0]);
    const Bound length = shape.longest_edge();
    constexpr Bound of_this_sum = 0x1p-58L;  // in units of length^3
    const Bound greatest = volume + volume_bound(shape) + of_this_sum * length * length * length;
    const Bound least = squares - 6 * shape.edge_error() * (2 * length + shape.edge_error()) * up;
    if (least <= 0) return 1;
    return static_cast<double>(12 * std::cbrt(greatest / 2 * (greatest / 2)) / least * up);
}

class CertifiedShapesCheck {
public:
    CertifiedShapesCheck(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                         Findings& findings)
        : coarse_(coarse),
          fine_(fine),
          descent_(descent),
          findings_(findings),
          certificates_(most_shapes),
          of_root_(coarse.mesh.cells.size(), nullptr) {}

    std::string run() {
        Steps step(findings_, fine_.mesh.cells.size());
        for (CellIndex c{0}; c < fine_.mesh.cells.end_index(); ++c) {
            step();
            // A cell that was not bisected belongs to its own set.
            if (!fine_.owns(fine_.mesh.cells[c]) || descent_.depth[c] == 0) continue;
            check(c);
        }
        const std::uint64_t by_slack = sum(findings_.group(), up_to_rounding_);
        const std::uint64_t unknown = sum(findings_.group(), beyond_open_sets_);
        std::string note = by_slack == 0 ? "dihedral angles and eta, exactly"
                                         : fmt::format(
                                               "dihedral angles and eta, of {} cells only up to "
                                               "the rounding of midpoints",
                                               by_slack);
        if (unknown > 0)
            note += fmt::format("; {} cells beyond open sets were not compared", unknown);
        return note;
    }

private:
    /// A set that needs more shapes is left open, to limit the time for needles.
    static constexpr std::size_t most_shapes = 1000;

    /// A certificate with its limits.
    struct Certified {
        Certified(const ShapeBounds& bounds, int last_generation)
            : bounds(bounds),
              limits(bounds.min_dihedral, bounds.max_dihedral),
              last_generation(last_generation) {}
        ShapeBounds bounds;
        DihedralLimits limits;
        int last_generation;  ///< for which the bounds hold
    };

    void check(CellIndex c) {
        const Certified& certified = of_root(descent_.parent[c]);
        constexpr int bisections_per_generation = 3;
        const int depth = descent_.depth[c];
        if (depth > bisections_per_generation * certified.last_generation) {
            ++beyond_open_sets_;
            return;
        }
        const Shape<4> shape = shape_of(fine_.mesh.cells[c], fine_.mesh, descent_);
        const Fit angles = fit_of_angles(shape, certified);
        const Fit eta = fit_of_eta(shape, certified.bounds.min_eta);
        const auto& bounds = certified.bounds;
        if (angles == Fit::none) {
            report(
                c, "a dihedral angle that regular refinement cannot make",
                fmt::format("{:.6g} to {:.6g} degrees", bounds.min_dihedral, bounds.max_dihedral));
        } else if (eta == Fit::none) {
            report(c, "an eta that regular refinement cannot make",
                   fmt::format("at least {:.6g}", bounds.min_eta));
        } else if (angles == Fit::up_to_rounding || eta == Fit::up_to_rounding) {
            ++up_to_rounding_;
        }
    }

    /// Whether a cell is within the bounds.
    enum class Fit { exact, up_to_rounding, none };

    Fit fit_of_angles(const Shape<4>& shape, const Certified& certified) {
        Arithmetic& arithmetic = findings_.arithmetic();
        if (certified.limits.hold_for(shape.corners, arithmetic)) return Fit::exact;
        if (shape.rounding > 0) {
            const double error = angle_error(shape);
            const auto& bounds = certified.bounds;
            const DihedralLimits widened(std::max(0.0, bounds.min_dihedral - error),
                                         std::min(180.0, bounds.max_dihedral + error));
            if (widened.hold_for(shape.corners, arithmetic)) return Fit::up_to_rounding;
        }
        return Fit::none;
    }

    Fit fit_of_eta(const Shape<4>& shape, double least) {
        if (!exact::is_mean_ratio_less(shape.corners, least, findings_.arithmetic())) {
            return Fit::exact;
        }
        const bool is_rounded = shape.rounding > 0 && exact_mean_ratio_at_most(shape) >= least;
        return is_rounded ? Fit::up_to_rounding : Fit::none;
    }

    void report(CellIndex c, const char* found, const std::string& certified) {
        findings_.add(Code::shape_beyond_certificate, [&]() -> Findings::Description {
            return {{entity(c), entity(descent_.parent[c], Which::coarse)},
                    found,
                    certified + ", as certified for the coarse cell"};
        });
    }

    const Certified& of_root(CellIndex root) {
        const Certified*& known = of_root_[root];
        if (known != nullptr) return *known;
        ShapeBounds bounds;
        int last_generation = 0;
        try {
            const CellCertificate& certificate = certificates_.of(coarse_.corners(root));
            bounds = certificate.bounds;
            constexpr int any = std::numeric_limits<std::uint8_t>::max();
            last_generation =
                certificate.is_closed ? any : static_cast<int>(certificate.generations);
        } catch (const shapes::CellCertifier::TooThin&) {
            // Nothing is proved about its descendants.
        }
        const Key key{bounds.min_dihedral, bounds.max_dihedral, bounds.min_eta, last_generation};
        known = &certified_.try_emplace(key, bounds, last_generation).first->second;
        return *known;
    }

    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    const Descent& descent_;
    Findings& findings_;
    shapes::Certificates certificates_;
    using Key = std::tuple<double, double, double, int>;
    std::map<Key, Certified> certified_;
    IndexVector<CellIndex, const Certified*> of_root_;  ///< null if not known yet
    std::uint64_t up_to_rounding_ = 0;
    std::uint64_t beyond_open_sets_ = 0;
};

}  // namespace

std::string check_certified_shapes(const JudgedMesh& coarse, const JudgedMesh& fine,
                                   const Descent& descent, Findings& findings) {
    return CertifiedShapesCheck(coarse, fine, descent, findings).run();
}

}  // namespace octetra::verify
