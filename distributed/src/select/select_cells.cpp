#include "select/select_cells.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <octetra/core/cell_quantities.hpp>
#include <octetra/core/check_selection.hpp>
#include <octetra/core/select_cells.hpp>

#include "level/incremental/adjacency.hpp"
#include "numbering/cell_numbers.hpp"
#include "select/facet_distances.hpp"
#include "select/field_values.hpp"
#include "topology/face_neighbours.hpp"

namespace octetra::distributed {
namespace {

std::vector<double> boundary_of(const DistributedMesh& mesh) {
    std::vector<double> values(mesh.cells.size(), 0);
    for (const auto& [cell, face] : find_boundary(mesh)) values[cell.value()] = 1;
    return values;
}

/// Collective.
TermValues values_of(const DistributedMesh& mesh, const Selection& selection,
                     const FieldsToUse& fields) {
    TermValues values;
    for (const Term& term : external_terms(selection)) {
        switch (term.quantity) {
            case Quantity::generation:
                values.push_back(
                    generations_of(mesh.cells, mesh.input_vertices.size(), mesh.midpoint_to_edge));
                break;
            case Quantity::boundary: values.push_back(boundary_of(mesh)); break;
            case Quantity::distance: values.push_back(facet_distances(mesh, term)); break;
            default: values.push_back(field_values(mesh, term, fields)); break;
        }
    }
    return values;
}

/// Returns the position of the root of each cell of this process among its roots.
std::vector<std::uint32_t> roots_of_cells(const DistributedMesh& mesh) {
    std::vector<std::uint32_t> roots(mesh.cells.size());
    if (mesh.adjacency != nullptr) {
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            roots[c.value()] = mesh.adjacency->cells.root_of(c);
        }
        return roots;
    }
    const AncestorMap& ancestors = mesh.cell_ancestors;
    for (std::uint32_t r = 0; r < ancestors.roots.size(); ++r) {
        std::fill(roots.begin() + ancestors.first[r], roots.begin() + ancestors.first[r + 1], r);
    }
    return roots;
}

/// Collective. Throws InputError for the undefined value with the lowest cell number of all.
void check_defined(const DistributedMesh& mesh, const Selection& selection,
                   const std::vector<UndefinedValue>& undefined) {
    const Communicator& processes = mesh.processes;
    if (processes.max(undefined.size()) == 0) return;
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const std::vector<std::uint64_t> numbers = cell_numbers(mesh);
    std::pair<std::uint64_t, std::uint64_t> lowest{none, none};  // cell and expression
    for (const auto& [cell, expression] : undefined) {
        lowest = std::min(lowest, {numbers[cell], expression});
    }
    const std::uint64_t cell = none - processes.max(none - lowest.first);
    const std::uint64_t here = lowest.first == cell ? lowest.second : none;
    const std::uint64_t expression = none - processes.max(none - here);
    refuse_undefined(selection, expression, cell + mesh.index_base);
}

/// Collective. Throws InputError unless all processes have the same expressions.
void check_same_expressions(const Communicator& processes, const Selection& selection) {
    std::string texts;
    for (const Expression* expression : expressions_of(selection)) {
        texts += (texts.empty() ? "" : "; ") + expression->text();
    }
    processes.check_same("where", texts);
}

}  // namespace

std::vector<std::uint8_t> select_cells(const DistributedMesh& mesh, const Selection& selection,
                                       const FieldsToUse& fields) {
    check(selection);
    check_same_expressions(mesh.processes, selection);
    const std::vector<std::uint32_t> roots = roots_of_cells(mesh);
    const AncestorMap& ancestors = mesh.cell_ancestors;
    SelectedCells selected = octetra::select_cells(
        selection, mesh.cells.size(),
        [&](std::size_t number) {
            CellToTest cell;
            const CellVertices& vertices = mesh.cells[CellIndex{number}];
            for (std::size_t k = 0; k < 4; ++k) cell.corners[k] = mesh.points[vertices[k]];
            cell.region = ancestors.markers.empty() ? 0 : ancestors.markers[roots[number]];
            cell.root = GlobalCell{ancestors.roots[roots[number]]};
            return cell;
        },
        values_of(mesh, selection, fields));
    check_defined(mesh, selection, selected.undefined);
    return std::move(selected.marks);
}

}  // namespace octetra::distributed
