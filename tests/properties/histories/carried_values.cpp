#include "properties/histories/carried_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "support/refinement.hpp"

namespace octetra::properties {

using distributed::AdaptiveMesh;
using distributed::CellValues;
using distributed::Field;

namespace {

/// A cell of the whole mesh, by the numbers of its vertices.
using CellNumbers = std::array<std::uint64_t, 4>;

struct VertexValue {
    std::uint64_t vertex;
    double value;
};

struct CellValue {
    CellNumbers cell;
    double value;
};

std::vector<double> whole_of_vertices(const AdaptiveMesh& mesh, const std::vector<double>& values,
                                      std::size_t count, std::string* fault) {
    std::vector<VertexValue> own;
    for (std::size_t v = 0; v < values.size(); ++v) {
        own.push_back({static_cast<std::uint64_t>(mesh.vertex_numbers()[v]), values[v]});
    }
    std::vector<double> whole(count, std::nan(""));
    for (const auto& of_one : mesh.processes().gather(own)) {
        for (const auto& [vertex, value] : of_one) {
            if (!std::isnan(whole.at(vertex)) && whole[vertex] != value) {
                *fault = "a vertex has different values on two ranks";
            }
            whole[vertex] = value;
        }
    }
    return whole;
}

std::vector<double> whole_of_cells(const AdaptiveMesh& mesh, const std::vector<double>& values,
                                   const Mesh& whole) {
    std::vector<CellValue> own;
    for (std::size_t c = 0; c < values.size(); ++c) {
        CellValue& of_cell = own.emplace_back(CellValue{.cell = {}, .value = values[c]});
        std::ranges::transform(mesh.cells()[c], of_cell.cell.begin(), [&](VertexIndex v) {
            return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
        });
    }
    std::map<CellNumbers, double> value_of;
    for (const auto& of_one : mesh.processes().gather(own)) {
        for (const auto& [cell, value] : of_one) value_of.emplace(cell, value);
    }
    std::vector<double> result;
    for (const CellVertices& cell : whole.cells) {
        CellNumbers numbers{};
        std::ranges::transform(cell, numbers.begin(), &VertexIndex::value);
        const auto found = value_of.find(numbers);
        result.push_back(found == value_of.end() ? std::nan("") : found->second);
    }
    return result;
}

std::string fault_on_vertices(const RefinementMaps& maps, const std::vector<double>& values) {
    const std::size_t first = maps.first_midpoint.value();
    if (values.size() != first + maps.midpoint_to_edge.size()) {
        return "the numbers of values and vertices differ";
    }
    for (std::size_t v = 0; v < first; ++v) {
        // A vertex of no cell may be on no rank; it has no value then.
        if (!std::isnan(values[v]) && values[v] != value_of_input_vertex(v)) {
            return "a vertex of the input has lost its value";
        }
    }
    for (std::size_t i = 0; i < maps.midpoint_to_edge.size(); ++i) {
        const auto [a, b] = maps.midpoint_to_edge[i];
        if (values[first + i] != (values[a.value()] + values[b.value()]) / 2) {
            return "a midpoint does not have the mean of its ends";
        }
    }
    return {};
}

std::string fault_on_cells(const Mesh& mesh, const RefinementMaps& maps, const Mesh& input,
                           const std::vector<double>& values, double scale) {
    std::vector<double> sums(input.cells.size(), 0);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const CellIndex root = maps.cell_to_parent[c];
        const double value = values.at(c.value());
        if (!(value > 0)) return "a cell has no value";
        const double parts = value_of_root(root.value()) / value;
        const auto whole_parts = static_cast<std::int64_t>(parts);
        if (static_cast<double>(whole_parts) != parts ||
            test::exact_volume(test::corners_of(mesh, c), scale) * whole_parts !=
                test::exact_volume(test::corners_of(input, root), scale)) {
            return "the value of a cell is not proportional to its volume";
        }
        sums[root.value()] += value;
    }
    for (std::size_t root = 0; root < sums.size(); ++root) {
        if (sums[root] != value_of_root(root)) return "the sum over a root's cells has changed";
    }
    return {};
}

}  // namespace

double value_of_input_vertex(std::uint64_t number) {
    return static_cast<double>(number * 2'654'435'761U % 1021U);
}

double value_of_root(std::uint64_t root) {
    return static_cast<double>(1 + root * 2'654'435'761U % 61U);
}

CarriedValues first_values(const AdaptiveMesh& mesh, const Ancestries& ancestries) {
    CarriedValues values;
    for (const distributed::GlobalVertex number : mesh.vertex_numbers()) {
        values.of_vertices.push_back(value_of_input_vertex(static_cast<std::uint64_t>(number)));
    }
    for (const Ancestry& past : ancestries) values.of_cells.push_back(value_of_root(past.root));
    return values;
}

CarriedValues after_step(CarriedValues values, const distributed::Adaptation& step) {
    if (!step.changed) return values;
    return {step.transfer_vertices(std::move(values.of_vertices)),
            step.transfer_cells(std::move(values.of_cells), 1, CellValues::divided)};
}

CarriedValues moved(CarriedValues values, const distributed::Migration& move) {
    auto of_vertices = move.vertices(std::move(values.of_vertices));
    return {std::move(of_vertices), move.cells(std::move(values.of_cells))};
}

std::vector<Field> fields_of(const CarriedValues& values) {
    return {{"linear", FieldOn::vertices, 1, values.of_vertices},
            {"divided", FieldOn::cells, 1, values.of_cells}};
}

CarriedValues values_of(const std::vector<Field>& fields) {
    const std::size_t end = fields.size();
    return {std::get<std::vector<double>>(fields.at(end - 2).values),
            std::get<std::vector<double>>(fields.at(end - 1).values)};
}

WholeValues gather_values(const CarriedValues& values, const AdaptiveMesh& mesh,
                          const Mesh& whole) {
    WholeValues all;
    all.of_vertices = whole_of_vertices(mesh, values.of_vertices, whole.points.size(), &all.fault);
    all.of_cells = whole_of_cells(mesh, values.of_cells, whole);
    return all;
}

std::string fault_of_values_on(const Mesh& mesh, const RefinementMaps& maps, const Mesh& input,
                               const WholeValues& values, double scale) {
    if (!values.fault.empty()) return values.fault;
    const std::string fault = fault_on_vertices(maps, values.of_vertices);
    return fault.empty() ? fault_on_cells(mesh, maps, input, values.of_cells, scale) : fault;
}

}  // namespace octetra::properties
