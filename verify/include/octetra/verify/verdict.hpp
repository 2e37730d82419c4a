#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/violation.hpp>

namespace octetra::verify {

enum class Status : std::uint8_t { passed, failed, skipped };

/// The note of a check that was skipped because of VerifyOptions::fast.
inline constexpr std::string_view not_fast = "not with --fast";

/// A check and its result.
struct Check {
    std::string name;
    Status status = Status::passed;
    std::string note;  ///< why it was skipped, or what it proved and within which bound
    double seconds = 0;
};

/// The number of decisions made in floating point with an error bound, and of those that required
/// exact arithmetic.
struct Arithmetic {
    std::uint64_t filtered = 0;
    std::uint64_t exact = 0;
};

/// Properties of the mesh that are not violations.
struct Facts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t edges = 0;
    std::uint64_t faces = 0;
    std::uint64_t boundary_faces = 0;
    std::uint64_t unused_vertices = 0;    ///< belong to no cell; in a refinement, inherited
    std::uint64_t singular_edges = 0;     ///< boundary edges not in exactly two boundary faces
    std::uint64_t singular_vertices = 0;  ///< whose neighbourhood is neither a ball nor a half ball
    // of a refinement
    std::uint64_t bisected_edges = 0;
    std::uint64_t rounded_midpoints = 0;  ///< new vertices that are not exact midpoints
    std::uint64_t cells_kept = 0;         ///< coarse cells that are also cells of the fine mesh
    int deepest = 0;                      ///< most bisections between a cell and its parent
    double rounding_bound = 0;  ///< upper bound of the deviation of a vertex, in any coordinate,
                                ///< from its position without rounding
};

/// Angles in degrees, computed in floating point; used only for reporting, not for decisions.
struct AngleFigures {
    double min_dihedral = 0;
    double max_dihedral = 0;
    double min_solid = 0;       ///< smallest solid angle, in steradians
    double min_eta = 0;         ///< mean ratio: 1 for a regular tetrahedron
    CellIndex min_dihedral_at;  ///< none() if there are no cells
};

/// Figures of the cells at this depth: the number of bisections from their coarse cell.
struct DepthFigures {
    int depth = 0;
    std::uint64_t cells = 0;
    double min_dihedral = 0;
    double min_eta = 0;
};

/// The volume of all cells with a region tag, or the area of all tagged facets with a marker; tag 0
/// if the mesh has no tags or markers. Areas of single facets are rounded; all other quantities are
/// exact until rounded to these figures.
struct TagSum {
    Marker tag = 0;
    double fine = 0;
    double coarse = 0;      ///< only of a refinement
    double difference = 0;  ///< only of a refinement: fine minus coarse
};

struct Verdict {
    std::vector<Check> checks;
    std::vector<Violation> violations;  ///< at most VerifyOptions::kept_per_code of each code
    std::array<std::uint64_t, code_count> counts{};  ///< of all violations, by code
    Facts facts;
    std::optional<AngleFigures> angles;
    std::optional<AngleFigures> coarse_angles;
    std::vector<DepthFigures> by_depth;
    /// By tag, ascending. Empty with VerifyOptions::fast, and for a refinement if a check before
    /// "sums by tag" failed. Areas are also present if the coarse mesh lists no facets.
    std::vector<TagSum> volumes;
    std::vector<TagSum> areas;
    Arithmetic arithmetic;
    std::uint64_t search_tests = 0;  ///< pairs and boxes tested in spatial searches: their cost

    [[nodiscard]] std::uint64_t count(Code code) const {
        return counts[static_cast<std::size_t>(code)];
    }
    [[nodiscard]] bool valid() const {
        return std::all_of(counts.begin(), counts.end(), [](std::uint64_t n) { return n == 0; });
    }
};

}  // namespace octetra::verify
