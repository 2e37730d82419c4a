#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"
#include "lookup/point_lookup.hpp"
#include "mesh/judged_mesh.hpp"
#include "refinement/lines.hpp"

namespace octetra::verify {

/// The relation between the cells of a fine mesh and of a coarse one.
struct Descent {
    IndexVector<VertexIndex, VertexIndex> coarse_to_fine;  ///< none() if missing
    std::vector<char> is_coarse;  ///< for each fine vertex: whether it is in the coarse mesh

    IndexVector<CellIndex, CellIndex> parent;  ///< the coarse cell of each fine cell, or none()
    /// The face of the parent on which each face of a cell lies; -1 in its interior.
    IndexVector<CellIndex, std::array<std::int8_t, 4>> face_of_parent;
    /// Returns the face of a coarse cell on which a face of a fine one lies; nothing in the
    /// interior.
    [[nodiscard]] std::optional<CellFace> coarse_face(CellFace f) const {
        const std::int8_t face = face_of_parent[f.cell][f.face];
        if (face < 0) return std::nullopt;
        return CellFace{parent[f.cell], static_cast<std::size_t>(face)};
    }

    IndexVector<CellIndex, std::uint8_t> depth;  ///< number of bisections from the parent

    /// For each fine vertex, the two vertices of which it is the midpoint; none() for those of the
    /// coarse mesh.
    IndexVector<VertexIndex, EdgeVertices> halves;
    /// For each fine vertex, an upper bound of the deviation in any coordinate from its position
    /// without rounding of midpoints.
    IndexVector<VertexIndex, double> rounding;
};

/// Finds every coarse vertex in the fine mesh: by number, if the first vertices of the fine mesh
/// are the coarse ones, otherwise by coordinates; if several fine vertices coincide there, by the
/// cells that contain them.
std::string find_coarse_vertices(const JudgedMesh& coarse, const JudgedMesh& fine,
                                 const PointLookup& places, Descent& descent, Findings& findings);

/// Divides every coarse cell at midpoints until the pieces are fine cells, and checks that every
/// fine cell occurs exactly once.
std::string check_descent(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                          Descent& descent, Findings& findings);

/// Returns whether vertex m of the fine mesh is the exact midpoint of `edge`, without rounding, for
/// any coordinates of the coarse vertices.
[[nodiscard]] bool is_half_way(VertexIndex m, const EdgeVertices& edge, const Descent& descent);

}  // namespace octetra::verify
