#include <fmt/format.h>

#include "refinement/checks.hpp"

namespace octetra::verify {

namespace {

void check_parents(const RefinementMaps& maps, const JudgedMesh& fine, const Descent& descent,
                   Findings& findings) {
    const Numbers& fine_numbers = findings.numbers(Which::fine);
    const Numbers& coarse_numbers = findings.numbers(Which::coarse);
    for (CellIndex c{0}; c < fine.mesh.cells.end_index(); ++c) {
        if (!fine.owns(fine.mesh.cells[c])) continue;
        const CellIndex claimed = maps.cell_to_parent[fine_numbers.of(c)];
        if (claimed == coarse_numbers.of(descent.parent[c])) continue;
        findings.add(Code::wrong_parent, [&]() -> Findings::Description {
            return {{entity(c), entity(descent.parent[c], Which::coarse)},
                    fmt::format("cell {}, counted from 0, in the map", claimed.value()),
                    "the coarse cell that it lies in"};
        });
    }
}

/// Returns whether m is the midpoint of `edge`, which has numbers of the whole mesh. (Vertices
/// outside this part cannot be its ends: the edge bisected by m lies in a coarse cell that contains
/// m.)
bool is_half_way_in_whole(VertexIndex m, const EdgeVertices& edge, const JudgedMesh& fine,
                          const Descent& descent, const NumberList& numbers) {
    EdgeVertices seen;
    for (std::size_t k = 0; k < 2; ++k) {
        if (edge[k].value() >= fine.totals.vertices) return false;
        seen[k] = numbers.find(edge[k].value());
        if (!(seen[k] < fine.mesh.points.end_index())) return false;
    }
    return seen[0] != seen[1] && is_half_way(m, seen, descent);
}

void check_midpoints(const RefinementMaps& maps, const JudgedMesh& fine, const Descent& descent,
                     Findings& findings) {
    const Numbers& numbers = findings.numbers(Which::fine);
    for (VertexIndex m{0}; m < fine.mesh.points.end_index(); ++m) {
        if (numbers.of(m) < maps.first_midpoint || !fine.owns(m)) continue;
        const EdgeVertices& edge =
            maps.midpoint_to_edge[numbers.of(m).value() - maps.first_midpoint.value()];
        if (is_half_way_in_whole(m, edge, fine, descent, numbers.vertices)) continue;
        findings.add(Code::wrong_midpoint_edge, [&]() -> Findings::Description {
            const auto& [a, b] = descent.halves[m];
            return {{entity(m)},
                    fmt::format("half way between {} and {}, counted from 0, in the map",
                                edge[0].value(), edge[1].value()),
                    a.is_none() ? "no edge"
                                : fmt::format("between {} and {}", numbers.of(a).value(),
                                              numbers.of(b).value())};
        });
    }
}

}  // namespace

std::string check_maps(const RefinementMaps& maps, const JudgedMesh& coarse, const JudgedMesh& fine,
                       const Descent& descent, Findings& findings) {
    const auto report_size = [&](Code code, std::string found, std::string expected) {
        if (!findings.group().is_first()) return;
        findings.add(code, [&]() -> Findings::Description {
            return {{}, std::move(found), std::move(expected)};
        });
    };
    if (maps.cell_to_parent.size() != fine.totals.cells) {
        report_size(Code::wrong_parent,
                    fmt::format("parents of {} cells", maps.cell_to_parent.size()),
                    fmt::format("{}", fine.totals.cells));
        return {};
    }
    check_parents(maps, fine, descent, findings);

    const std::uint64_t fine_vertices = fine.totals.vertices;
    const std::uint64_t coarse_vertices = coarse.totals.vertices;
    if (maps.midpoint_to_edge.empty() && fine_vertices == coarse_vertices) return {};
    const std::size_t first = maps.first_midpoint.value();
    if (first != coarse_vertices || first + maps.midpoint_to_edge.size() != fine_vertices) {
        report_size(
            Code::wrong_midpoint_edge,
            fmt::format("edges of {} vertices from number {}", maps.midpoint_to_edge.size(), first),
            fmt::format("of {} from {}", fine_vertices - coarse_vertices, coarse_vertices));
        return {};
    }
    check_midpoints(maps, fine, descent, findings);
    return {};
}

}  // namespace octetra::verify
