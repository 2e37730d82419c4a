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
#include "select/background_values.hpp"
#include "select/facet_distances.hpp"
#include "select/field_values.hpp"
#include "select/graded_sizes.hpp"
#include "topology/face_neighbours.hpp"

namespace octetra::distributed {
namespace {

std::vector<double> boundary_of(const DistributedMesh& mesh) {
    std::vector<double> values(mesh.cells.size(), 0);
    for (const auto& [cell, face] : find_boundary(mesh)) values[cell.value()] = 1;
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

/// The cells of this process.
class OwnCells {
public:
    explicit OwnCells(const DistributedMesh& mesh) : mesh_(&mesh), roots_(roots_of_cells(mesh)) {}

    CellToTest operator()(std::size_t number) const {
        CellToTest cell;
        const AncestorMap& ancestors = mesh_->cell_ancestors;
        const CellVertices& vertices = mesh_->cells[CellIndex{number}];
        for (std::size_t k = 0; k < 4; ++k) cell.corners[k] = mesh_->points[vertices[k]];
        cell.region = ancestors.markers.empty() ? 0 : ancestors.markers[roots_[number]];
        cell.root = GlobalCell{ancestors.roots[roots_[number]]};
        return cell;
    }

private:
    const DistributedMesh* mesh_;
    std::vector<std::uint32_t> roots_;
};

/// Collective. Returns the values of the external terms of a selection.
class Terms {
public:
    Terms(const DistributedMesh& mesh, const OwnCells& cells, const FieldsToUse& fields)
        : mesh_(&mesh), cells_(&cells), fields_(&fields) {}

    [[nodiscard]] TermValues of(const Selection& selection) const {
        TermValues values;
        for (const Term& term : external_terms(selection)) values.push_back(values_of(term));
        return values;
    }

private:
    [[nodiscard]] std::vector<double> values_of(const Term& term) const {
        const DistributedMesh& mesh = *mesh_;
        switch (term.quantity) {
            case Quantity::generation:
                return generations_of(mesh.cells, mesh.input_vertices.size(),
                                      mesh.midpoint_to_edge);
            case Quantity::boundary: return boundary_of(mesh);
            case Quantity::distance: return facet_distances(mesh, term);
            case Quantity::background: return background_values(mesh, term, fields_->backgrounds);
            case Quantity::graded: return graded(term);
            default: return field_values(mesh, term, *fields_);
        }
    }

    [[nodiscard]] std::vector<double> graded(const Term& term) const {
        const Selection alone{.where = {Expression(term.name)}};
        EvaluatedCells sizes = evaluate(alone.where[0], mesh_->cells.size(), *cells_, of(alone));
        check_defined(*mesh_, alone, sizes.undefined);
        return graded_sizes(*mesh_, std::move(sizes.values), term.share);
    }

    const DistributedMesh* mesh_;
    const OwnCells* cells_;
    const FieldsToUse* fields_;
};

/// Collective. Throws InputError unless all processes have the same expressions.
void check_same_expressions(const Communicator& processes, const Selection& selection) {
    std::string texts;
    for (const Expression* expression : expressions_of(selection)) {
        texts += (texts.empty() ? "" : "; ") + expression->text();
    }
    processes.check_same("expression", texts);
}

}  // namespace

std::vector<std::uint8_t> select_cells(const DistributedMesh& mesh, const Selection& selection,
                                       const FieldsToUse& fields) {
    check(selection);
    check_same_expressions(mesh.processes, selection);
    const OwnCells cells(mesh);
    SelectedCells selected = octetra::select_cells(selection, mesh.cells.size(), cells,
                                                   Terms(mesh, cells, fields).of(selection));
    check_defined(mesh, selection, selected.undefined);
    return std::move(selected.marks);
}

std::vector<double> evaluate_cells(const DistributedMesh& mesh, const Expression& expression,
                                   const FieldsToUse& fields) {
    const Selection alone{.where = {expression}};
    check_same_expressions(mesh.processes, alone);
    const OwnCells cells(mesh);
    EvaluatedCells evaluated =
        evaluate(alone.where[0], mesh.cells.size(), cells, Terms(mesh, cells, fields).of(alone));
    check_defined(mesh, alone, evaluated.undefined);
    return std::move(evaluated.values);
}

}  // namespace octetra::distributed
