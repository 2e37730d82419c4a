#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "coarsening/checks.hpp"
#include "lookup/buckets.hpp"
#include "mesh/checks.hpp"
#include "refinement/cell_divider.hpp"
#include "refinement/lines.hpp"

namespace octetra::verify {
namespace {

/// Returns the cell with vertices of the lineage; nothing if one of them has no match.
std::optional<CellVertices> as_before(const CellVertices& cell, const VertexMatch& match) {
    CellVertices before;
    for (std::size_t k = 0; k < 4; ++k) {
        before[k] = match[cell[k]];
        if (before[k].is_none()) return std::nullopt;
    }
    return before;
}

/// Returns whether each vertex of a cell is a corner of a cut cell, or the midpoint of two of its
/// corners. Then the cell is contained in the cut one.
bool is_made_of(const CellVertices& cell, const CutCell& cut, const Lineage& lineage) {
    const auto is_corner = [&](VertexIndex v) {
        return std::find(cut.vertices.begin(), cut.vertices.end(), v) != cut.vertices.end();
    };
    return std::all_of(cell.begin(), cell.end(), [&](VertexIndex v) {
        if (is_corner(v)) return true;
        const auto& [a, b] = lineage.halves[v];
        return is_corner(a) && is_corner(b);
    });
}

constexpr int beyond_input = std::numeric_limits<int>::max();

/// Returns the number of steps by which the containing cell is coarser than a cell of the mesh
/// before: 1 if it contains the cell that the last step cut here, and so on.
int generations_back(const CellVertices& cell, CellIndex before, const Lineage& lineage) {
    int steps = 1;
    for (std::uint32_t at = lineage.cells.present[before.value()].parent; at != no_parent;
         at = lineage.cells.cut[at].parent) {
        if (is_made_of(cell, lineage.cells.cut[at], lineage)) return steps;
        ++steps;
    }
    return beyond_input;
}

/// The mesh before, used as the fine mesh when dividing cells.
struct BeforeMesh {
    explicit BeforeMesh(const Lineage& lineage) : mesh(mesh_of(lineage)), places(mesh.points) {
        Findings not_looked_at(0);
        (void)check_well_formed(judged, not_looked_at);
    }
    static Mesh mesh_of(const Lineage& lineage) {
        Mesh mesh;
        mesh.points = lineage.points;
        for (const PresentCell& cell : lineage.cells.present) mesh.cells.append(cell.vertices);
        return mesh;
    }

    Mesh mesh;
    PointLookup places;
    JudgedMesh judged = judged_whole(mesh, Which::before);
};

}  // namespace

std::string check_unions(const Lineage& lineage, int levels, const Mesh& after,
                         const VertexMatch& match, Findings& findings) {
    const BeforeMesh before(lineage);
    Lines lines(before.judged, before.places);
    CellDivider divider(judged_whole(after, Which::fine), before.judged, lines);
    CellFinder cells_before(before.judged);
    std::size_t unions = 0;
    Steps step(findings, after.cells.size());
    for (CellIndex c{0}; c < after.cells.end_index(); ++c) {
        step();
        const auto cell = as_before(after.cells[c], match);
        if (!cell) continue;  // has a vertex that was already reported
        if (!cells_before.find(*cell).is_none()) continue;
        if (!divider.divide_cell(*cell)) {
            findings.add(Code::cell_not_before, [&]() -> Findings::Description {
                return {{entity(c), entity(divider.undivided(), Which::before)},
                        "no cells of the mesh before fill this piece of it",
                        "one of its cells, or a union of them"};
            });
            continue;
        }
        ++unions;
        int most = 0;
        CellIndex farthest;
        for (const Leaf& leaf : divider.leaves()) {
            const int steps = generations_back(*cell, leaf.cell, lineage);
            if (steps > most) {
                most = steps;
                farthest = leaf.cell;
            }
        }
        if (most <= levels) continue;
        findings.add(Code::too_many_generations, [&]() -> Findings::Description {
            return {{entity(c), entity(farthest, Which::before)},
                    most == beyond_input ? "not contained in any ancestor of the second"
                                         : fmt::format("{} steps back from the second", most),
                    fmt::format("at most {}", levels)};
        });
    }
    return fmt::format("{} cells of the mesh before, {} unions of these, at most {} step{} back",
                       after.cells.size() - unions, unions, levels, levels == 1 ? "" : "s");
}

std::string check_pieces(const Remainder& rest, const Mesh& after, const VertexMatch& match,
                         Findings& findings) {
    const Buckets<4> cells(rest.reasons.size(), [&](auto&& visit) {
        for (std::size_t c = 0; c < rest.cells.present.size(); ++c) {
            visit(rest.cells.present[c].vertices, c);
        }
    });
    for (CellIndex c{0}; c < after.cells.end_index(); ++c) {
        const auto cell = as_before(after.cells[c], match);
        if (cell && cells.contains(*cell)) continue;
        findings.add(Code::wrong_pattern, [&]() -> Findings::Description {
            return {{entity(c)},
                    "a cell that longest-edge bisection does not create",
                    "one created from the edges whose midpoints are kept"};
        });
    }
    return "those that longest-edge bisection creates from the edges whose midpoints are kept";
}

}  // namespace octetra::verify
