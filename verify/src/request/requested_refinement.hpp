#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/verify.hpp>

#include "findings/findings.hpp"
#include "mesh/judged_mesh.hpp"
#include "parts/views.hpp"
#include "refinement/descent.hpp"
#include "refinement/lines.hpp"

/// Requests are replayed level by level with the vertices of the fine mesh, which must contain
/// every midpoint that is needed. The result must be the fine mesh.
namespace octetra::verify {

/// A cell between the coarse mesh and the fine one, with vertices of the fine mesh.
struct DescendantCell {
    CellVertices vertices;
    CellIndex root;  ///< its cell of the coarse mesh
};

/// A request with its meshes.
class RequestedRefinement {
public:
    RequestedRefinement(const Request& request, const JudgedMesh& coarse, const JudgedMesh& fine,
                        Lines& lines, const Descent& descent, Findings& findings)
        : request_(request),
          coarse_(coarse),
          fine_(fine),
          lines_(lines),
          descent_(descent),
          views_(coarse.views),
          findings_(findings) {}

    [[nodiscard]] const Request& request() const { return request_; }
    [[nodiscard]] const JudgedMesh& coarse() const { return coarse_; }
    [[nodiscard]] const JudgedMesh& fine() const { return fine_; }
    [[nodiscard]] Lines& lines() const { return lines_; }
    [[nodiscard]] Findings& findings() const { return findings_; }
    [[nodiscard]] const ProcessGroup& group() const { return findings_.group(); }

    [[nodiscard]] std::vector<DescendantCell> coarse_cells() const;
    /// Collective. Returns for each cell whether the selection marks it.
    [[nodiscard]] std::vector<std::uint8_t> marks_of(std::span<const DescendantCell> cells) const;
    /// Collective. Sends edges to the processes that may have them in view. Returns those received
    /// of which this process has both ends.
    [[nodiscard]] std::vector<EdgeVertices> exchange_edges(
        const std::vector<EdgeVertices>& edges) const;

    // Violations, added only if this process owns the edge.
    void report_missing(const EdgeVertices& edge) const;
    void report_needless(const EdgeVertices& edge) const;

    /// The levels for a note: "2 levels".
    [[nodiscard]] std::string levels() const;

private:
    const Request& request_;
    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    Lines& lines_;
    const Descent& descent_;
    Views views_;
    Findings& findings_;
};

}  // namespace octetra::verify
