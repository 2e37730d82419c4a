#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <octetra/verify/verify.hpp>

#include "lines.hpp"
#include "subject.hpp"

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
/// are the coarse ones, else by place.
std::string find_coarse_vertices(const Subject& coarse, const Subject& fine, const Places& places,
                                 Descent& descent, Findings& findings);

/// Divides every coarse cell at midpoints until the pieces are fine cells, and every fine cell is a
/// piece once.
std::string check_descent(const Subject& coarse, const Subject& fine, Lines& lines,
                          Descent& descent, Findings& findings);

/// Is vertex m of the fine mesh half way between the ends of `edge`, not rounded, wherever the
/// vertices of the coarse mesh are?
[[nodiscard]] bool is_half_way(VertexIndex m, const EdgeVertices& edge, const Descent& descent);

/// Fine faces have one cell only where they lie on the coarse boundary.
std::string check_cover(const Subject& coarse, const Subject& fine, const Descent& descent,
                        Findings& findings);

/// The exact volumes of the pieces of each coarse cell, and the exact vector areas of the pieces of
/// each face on the coarse boundary, sum up to its own; where midpoints were rounded, to within a
/// bound that follows from Descent::rounding.
std::string check_volumes(const Subject& coarse, const Subject& fine, const Descent& descent,
                          Findings& findings);

/// Region tags, markers and attributes are those that are inherited. If the fine mesh has no
/// attributes, and `attributes_lost` says why it cannot, they are not checked.
void check_tags(const Subject& coarse, const Subject& fine, Lines& lines, const Descent& descent,
                std::string_view attributes_lost, Findings& findings);

/// A parent map says what is found here.
std::string check_maps(const RefinementMaps& maps, const Subject& coarse, const Subject& fine,
                       const Descent& descent, Findings& findings);

/// The fine mesh is what the request asks for.
std::string check_request(const Request& request, const Subject& coarse, const Subject& fine,
                          Lines& lines, const Descent& descent, Findings& findings);

}  // namespace octetra::verify
