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
#include "measures/rounded_shapes.hpp"
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
        : least_(least), above_greatest_(std::nextafter(greatest, 180.0)) {}

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
        std::string note = "dihedral angles and eta, exactly; solid angles, in floating point";
        if (by_slack > 0) {
            note = fmt::format(
                "dihedral angles, eta and solid angles, of {} cells only up to the rounding of "
                "midpoints",
                by_slack);
        }
        if (unknown > 0)
            note += fmt::format(
                "; {} cells beyond open sets, or too thin to certify, were not compared", unknown);
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
        const Fit solid_angles = fit_of_solid_angles(shape, certified.bounds.min_solid);
        const auto& bounds = certified.bounds;
        if (angles == Fit::none) {
            report(
                c, "a dihedral angle that regular refinement cannot make",
                fmt::format("{:.6g} to {:.6g} degrees", bounds.min_dihedral, bounds.max_dihedral));
        } else if (eta == Fit::none) {
            report(c, "an eta that regular refinement cannot make",
                   fmt::format("at least {:.6g}", bounds.min_eta));
        } else if (solid_angles == Fit::none) {
            report(c, "a solid angle that regular refinement cannot make",
                   fmt::format("at least {:.6g} sr", bounds.min_solid));
        } else if (std::max({angles, eta, solid_angles}) == Fit::up_to_rounding) {
            ++up_to_rounding_;
        }
    }

    /// Whether a cell is within the bounds, as it is or only if its midpoints had not been rounded.
    enum class Fit : std::uint8_t { as_it_is, up_to_rounding, none };

    Fit fit_of_angles(const Shape<4>& shape, const Certified& certified) {
        Arithmetic& arithmetic = findings_.arithmetic();
        if (certified.limits.hold_for(shape.corners, arithmetic)) return Fit::as_it_is;
        if (shape.rounding > 0) {
            const double error = dihedral_error(shape);
            const auto& bounds = certified.bounds;
            const DihedralLimits widened(std::max(0.0, bounds.min_dihedral - error),
                                         std::min(180.0, bounds.max_dihedral + error));
            if (widened.hold_for(shape.corners, arithmetic)) return Fit::up_to_rounding;
        }
        return Fit::none;
    }

    Fit fit_of_eta(const Shape<4>& shape, double least) {
        if (!exact::is_mean_ratio_less(shape.corners, least, findings_.arithmetic())) {
            return Fit::as_it_is;
        }
        const bool is_rounded = shape.rounding > 0 && exact_mean_ratio_at_most(shape) >= least;
        return is_rounded ? Fit::up_to_rounding : Fit::none;
    }

    static Fit fit_of_solid_angles(const Shape<4>& shape, double least) {
        if (solid_angles_may_reach(least, {.corners = shape.corners})) return Fit::as_it_is;
        return solid_angles_may_reach(least, shape) ? Fit::up_to_rounding : Fit::none;
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
        const Key key{bounds.min_dihedral, bounds.max_dihedral, bounds.min_eta, bounds.min_solid,
                      last_generation};
        known = &certified_.try_emplace(key, bounds, last_generation).first->second;
        return *known;
    }

    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    const Descent& descent_;
    Findings& findings_;
    shapes::Certificates certificates_;
    using Key = std::tuple<double, double, double, double, int>;
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
