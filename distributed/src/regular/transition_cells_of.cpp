#include "regular/transition_cells_of.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/core/huge_pages.hpp>

#include "history/families.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {
namespace {

using Kind = TransitionCells::Kind;

[[noreturn]] void refuse() {
    throw InputError("the steps are not those of refinement with the regular closure");
}

TransitionCells::Kinds kinds_of(const DistributedMesh& mesh, const VertexLevels& levels) {
    using CellFamilies = Families<4, CellIndex>;
    TransitionCells::Kinds kinds;
    kinds.assign(mesh.cells.size(), Kind::regular);
    CellFamilies families(levels);
    const auto on_parent = [&](std::uint32_t level, const CellVertices& parent,
                               std::span<const CellFamilies::Member> members) {
        if (levels.newest(parent) + 1 != level) refuse();
        if (members.size() < CellFamilies::whole) {
            Kind kind = Kind::first_sibling;
            for (const CellFamilies::Member& member : members) {
                if (member.note.is_none()) refuse();  // it was bisected
                kinds[member.note] = std::exchange(kind, Kind::further_sibling);
            }
        }
        return CellIndex::none();
    };
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        families.add(mesh.cells[c], c, on_parent, [](auto&&...) {});
    }
    return kinds;
}

}  // namespace

TransitionCells::Generations generations_of(const DistributedMesh& mesh) {
    const VertexLevels levels(mesh);
    TransitionCells::Generations generations;
    reserve_with_room(generations, mesh.points.size());
    generations.resize(mesh.points.size(), 0);
    for (std::uint32_t level = 1; level <= levels.count(); ++level) {
        const VertexIndex end = std::min(levels.end(level), mesh.points.end_index());
        std::fill(generations.begin() + levels.begin(level).value(),
                  generations.begin() + end.value(), level);
    }
    return generations;
}

TransitionCells transition_cells_of(const DistributedMesh& mesh) {
    return {mesh, kinds_of(mesh, VertexLevels(mesh)), generations_of(mesh)};
}

}  // namespace octetra::distributed
