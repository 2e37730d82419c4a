#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/adaptive_steps.hpp"

/// The marks of expressions, and their values, in the cells of a whole mesh.
namespace octetra::distributed {

inline Corners corners_of_whole(const Mesh& mesh, CellIndex c) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.cells[c][k]];
    return corners;
}

class EvaluatedMesh : public AdaptiveMeshIn {
protected:
    /// Collective. Returns the marks of an expression for all cells in canonical order.
    static std::vector<std::uint8_t> marks_where(const AdaptiveMesh& mesh, const std::string& text,
                                                 const std::vector<Field>& fields = {},
                                                 const std::vector<Background>& backgrounds = {}) {
        std::map<std::uint64_t, std::uint8_t> by_number;
        const auto numbers = test::of_all(mesh.cell_numbers());
        const auto lists =
            test::of_all(mesh.marked_cells({.where = {Expression(text)}}, fields, backgrounds));
        for (std::size_t r = 0; r < numbers.size(); ++r) {
            for (std::size_t c = 0; c < numbers[r].size(); ++c) {
                by_number[numbers[r][c]] = lists[r][c];
            }
        }
        std::vector<std::uint8_t> all;
        for (const auto& [number, mark] : by_number) all.push_back(mark);
        return all;
    }
    /// Collective. Expects that an expression has exactly these values in the cells of the whole
    /// mesh, which the first process has.
    static void expect_values(const AdaptiveMesh& mesh, const std::string& text,
                              const std::vector<double>& expected,
                              const std::vector<Background>& backgrounds = {}) {
        SCOPED_TRACE(text);
        const auto numbers = mesh.cell_numbers();
        std::vector<double> all = expected;
        mesh.processes().broadcast(all);
        Field values{"expected", FieldOn::cells, 1, std::vector<double>()};
        for (const std::uint64_t number : numbers) {
            std::get<std::vector<double>>(values.values).push_back(all[number]);
        }
        const auto marks = marks_where(mesh, text + " == field(expected)", {values}, backgrounds);
        for (std::size_t c = 0; c < marks.size(); ++c) ASSERT_EQ(marks[c], 1) << "cell " << c;
    }
};

}  // namespace octetra::distributed
