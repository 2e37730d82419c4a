#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"
#include "lookup/places.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/lines.hpp"

namespace octetra::verify {

/// How the cells of a fine mesh come of those of a coarse one.
struct Descent {
    IndexVector<VertexIndex, VertexIndex> coarse_to_fine;  ///< none(): lost
    std::vector<char> is_coarse;  ///< of each fine vertex: is it one of the coarse mesh?

    IndexVector<CellIndex, CellIndex> parent;  ///< of each fine cell the coarse one, or none()
    /// On which face of the parent each of its faces lies; inside: -1.
    IndexVector<CellIndex, std::array<std::int8_t, 4>> face_of_parent;
    /// The face of a coarse cell that a face of a fine one lies on; nothing if it lies inside.
    [[nodiscard]] std::optional<CellFace> coarse_face(CellFace f) const {
        const std::int8_t face = face_of_parent[f.cell][f.face];
        if (face < 0) return std::nullopt;
        return CellFace{parent[f.cell], static_cast<std::size_t>(face)};
    }

    IndexVector<CellIndex, std::uint8_t> depth;  ///< how many bisections below the parent

    /// Of each fine vertex the two that it is half way between; none() for those of the coarse
    /// mesh.
    IndexVector<VertexIndex, EdgeVertices> halves;
    /// Of each fine vertex: no coordinate is farther than this from where it would be, had no
    /// midpoint been rounded.
    IndexVector<VertexIndex, double> rounding;
};

/// Finds every coarse vertex in the fine mesh: by number, if the first vertices of the fine mesh
/// are the coarse ones, else by place; and, where several fine vertices lie there, by the cells
/// that have them.
std::string find_coarse_vertices(const JudgedMesh& coarse, const JudgedMesh& fine,
                                 const Places& places, Descent& descent, Findings& findings);

/// Divides every coarse cell at midpoints until the pieces are fine cells, and every fine cell is a
/// piece once.
std::string check_descent(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                          Descent& descent, Findings& findings);

/// Is vertex m of the fine mesh half way between the ends of `edge`, not rounded, wherever the
/// vertices of the coarse mesh are?
[[nodiscard]] bool is_half_way(VertexIndex m, const EdgeVertices& edge, const Descent& descent);

}  // namespace octetra::verify
