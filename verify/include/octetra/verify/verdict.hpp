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

/// One check and how it ended.
struct Check {
    std::string name;
    Status status = Status::passed;
    std::string note;  ///< why it was skipped, or what it proves and within which bound
    double seconds = 0;
};

/// How many decisions were made in floating point with a bound on the error, and how many took
/// exact arithmetic.
struct Arithmetic {
    std::uint64_t filtered = 0;
    std::uint64_t exact = 0;
};

/// What is worth knowing and is no fault.
struct Facts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t edges = 0;
    std::uint64_t faces = 0;
    std::uint64_t boundary_faces = 0;
    std::uint64_t unused_vertices = 0;    ///< of no cell; of a refinement, inherited
    std::uint64_t singular_edges = 0;     ///< boundary edges with other than two boundary faces
    std::uint64_t singular_vertices = 0;  ///< whose cells fill neither a ball nor a half of one
    // of a refinement
    std::uint64_t bisected_edges = 0;
    std::uint64_t rounded_midpoints = 0;  ///< new vertices that are not exactly half way
    std::uint64_t cells_kept = 0;         ///< coarse cells that are cells of the fine mesh
    int deepest = 0;                      ///< most bisections between a cell and its parent
    double rounding_bound = 0;  ///< no vertex is farther, in any coordinate, from where it would be
                                ///< without rounding
};

/// Angles in degrees, computed in floating point (decisions are not made by them).
struct AngleFigures {
    double min_dihedral = 0;
    double max_dihedral = 0;
    double min_solid = 0;       ///< least solid angle, in steradians
    double min_eta = 0;         ///< mean ratio: 1 for a regular tetrahedron
    CellIndex min_dihedral_at;  ///< none() where there is no cell
};

/// Of the cells that lie this many bisections below their coarse cell.
struct DepthFigures {
    int depth = 0;
    std::uint64_t cells = 0;
    double min_dihedral = 0;
    double min_eta = 0;
};

/// The volume of all cells with a region tag, or the area of all tagged facets with a marker; with
/// tag 0 where the mesh has no tags or markers. Of single facets areas are rounded; all else is
/// exact until it is rounded to the figures here.
struct TagSum {
    Marker tag = 0;
    double fine = 0;
    double coarse = 0;      ///< of a refinement
    double difference = 0;  ///< of a refinement: by how much the fine mesh has more
};

struct Verdict {
    std::vector<Check> checks;
    std::vector<Violation> violations;  ///< as many of each code as VerifyOptions::kept_per_code
    std::array<std::uint64_t, code_count> counts{};  ///< of all violations, by code
    Facts facts;
    std::optional<AngleFigures> angles;
    std::optional<AngleFigures> coarse_angles;
    std::vector<DepthFigures> by_depth;
    /// By tag, ascending. Empty with VerifyOptions::fast, and of a refinement if a check before
    /// "sums by tag" has failed. Areas also where the coarse mesh lists no facets.
    std::vector<TagSum> volumes;
    std::vector<TagSum> areas;
    Arithmetic arithmetic;
    std::uint64_t looked_at = 0;  ///< by searches in space, pairs and boxes: their effort

    [[nodiscard]] std::uint64_t count(Code code) const {
        return counts[static_cast<std::size_t>(code)];
    }
    [[nodiscard]] bool valid() const {
        return std::all_of(counts.begin(), counts.end(), [](std::uint64_t n) { return n == 0; });
    }
};

}  // namespace octetra::verify
