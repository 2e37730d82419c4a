#include <fmt/format.h>

#include "descent.hpp"

namespace octetra::verify {

std::string check_maps(const RefinementMaps& maps, const Subject& coarse, const Subject& fine,
                       const Descent& descent, Findings& findings) {
    const Mesh& mesh = fine.mesh;
    if (maps.cell_to_parent.size() != mesh.cells.size()) {
        findings.add(Code::wrong_parent, [&]() -> Findings::Description {
            return {{},
                    fmt::format("parents of {} cells", maps.cell_to_parent.size()),
                    fmt::format("{}", mesh.cells.size())};
        });
        return {};
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const CellIndex claimed = maps.cell_to_parent[c];
        const CellIndex found = descent.parent[c];
        if (claimed == found) continue;
        findings.add(Code::wrong_parent, [&]() -> Findings::Description {
            return {{entity(c), entity(found, Which::coarse)},
                    fmt::format("cell {}, counted from 0, in the map", claimed.value()),
                    "the coarse cell that it lies in"};
        });
    }

    if (maps.midpoint_to_edge.empty() && mesh.points.size() == coarse.mesh.points.size()) return {};
    const std::size_t first = maps.first_midpoint.value();
    if (first != coarse.mesh.points.size() ||
        first + maps.midpoint_to_edge.size() != mesh.points.size()) {
        findings.add(Code::wrong_midpoint_edge, [&]() -> Findings::Description {
            return {{},
                    fmt::format("edges of {} vertices from number {}", maps.midpoint_to_edge.size(),
                                first),
                    fmt::format("of {} from {}", mesh.points.size() - coarse.mesh.points.size(),
                                coarse.mesh.points.size())};
        });
        return {};
    }
    for (std::size_t i = 0; i < maps.midpoint_to_edge.size(); ++i) {
        const VertexIndex m{first + i};
        const EdgeVertices& edge = maps.midpoint_to_edge[i];
        const bool in_range =
            edge[0] < mesh.points.end_index() && edge[1] < mesh.points.end_index();
        if (in_range && edge[0] != edge[1] && is_half_way(m, edge, descent)) continue;
        findings.add(Code::wrong_midpoint_edge, [&]() -> Findings::Description {
            return {{entity(m)},
                    fmt::format("half way between {} and {}, counted from 0, in the map",
                                edge[0].value(), edge[1].value()),
                    descent.halves[m][0].is_none()
                        ? "no edge"
                        : fmt::format("between {} and {}", descent.halves[m][0].value(),
                                      descent.halves[m][1].value())};
        });
    }
    return {};
}

}  // namespace octetra::verify
