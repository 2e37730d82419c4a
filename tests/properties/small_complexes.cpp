#include "properties/small_complexes.hpp"

#include <algorithm>
#include <initializer_list>
#include <numeric>

#include <octetra/core/mesh.hpp>

namespace octetra::properties {
namespace {

bool has_vertex(const std::array<std::size_t, 4>& cell, std::size_t v) {
    return std::ranges::find(cell, v) != cell.end();
}

EdgeBits shared_edges(const Complex& complex, std::size_t cell) {
    EdgeBits shared = 0;
    for (std::size_t e = 0; e < 6; ++e) {
        const Edge edge = edge_of(complex[cell], e);
        for (std::size_t other = 0; other < complex.size(); ++other) {
            if (other != cell && has_vertex(complex[other], edge[0]) &&
                has_vertex(complex[other], edge[1])) {
                shared |= 1U << e;
            }
        }
    }
    return shared;
}

/// For each vertex the set of cells that have it: bit c for cell c.
std::vector<unsigned> cells_at_vertices(const Complex& complex) {
    std::vector<unsigned> cells(vertex_count(complex), 0);
    for (std::size_t c = 0; c < complex.size(); ++c) {
        for (const std::size_t v : complex[c]) cells[v] |= 1U << c;
    }
    return cells;
}

/// Adds all bijections that extend `numbers` to the remaining vertices and preserve the set of
/// cells of each vertex.
void add_numberings(std::vector<std::vector<std::size_t>>& result,
                    std::vector<std::size_t>& numbers, const std::vector<unsigned>& cells,
                    const std::vector<unsigned>& wanted) {
    if (numbers.size() == cells.size()) {
        result.push_back(numbers);
        return;
    }
    for (std::size_t v = 0; v < cells.size(); ++v) {
        const bool is_free = std::ranges::find(numbers, v) == numbers.end();
        if (!is_free || cells[v] != wanted[numbers.size()]) continue;
        numbers.push_back(v);
        add_numberings(result, numbers, cells, wanted);
        numbers.pop_back();
    }
}

}  // namespace

Complex three_cells(std::size_t all, std::size_t ab, std::size_t ac, std::size_t bc) {
    std::array<std::vector<std::size_t>, 3> cells;
    std::size_t next = 0;
    const auto add = [&](std::size_t count, std::initializer_list<std::size_t> to) {
        for (; count > 0; --count, ++next) {
            for (const std::size_t cell : to) cells[cell].push_back(next);
        }
    };
    add(all, {0, 1, 2});
    add(ab, {0, 1});
    add(ac, {0, 2});
    add(bc, {1, 2});
    Complex complex;
    for (std::size_t c = 0; c < 3; ++c) {
        add(4 - cells[c].size(), {c});
        complex.push_back({cells[c][0], cells[c][1], cells[c][2], cells[c][3]});
    }
    return complex;
}

Complex two_cells(std::size_t shared) {
    Complex complex = three_cells(0, shared, 0, 0);
    complex.pop_back();
    return complex;
}

std::vector<Complex> all_small_complexes() {
    std::vector<Complex> complexes{{{0, 1, 2, 3}}};
    for (std::size_t shared = 0; shared <= 3; ++shared) complexes.push_back(two_cells(shared));
    for (std::size_t all = 0; all <= 2; ++all) {  // 3 would be all at one face
        for (std::size_t ab = 0; all + ab <= 3; ++ab) {
            for (std::size_t ac = 0; ac <= ab && all + ab + ac <= 4; ++ac) {
                for (std::size_t bc = 0; bc <= ac; ++bc) {
                    complexes.push_back(three_cells(all, ab, ac, bc));
                }
            }
        }
    }
    return complexes;
}

Edge edge_of(const std::array<std::size_t, 4>& cell, std::size_t e) {
    const std::size_t a = cell[cell_edges[e][0]];
    const std::size_t b = cell[cell_edges[e][1]];
    return {std::min(a, b), std::max(a, b)};
}

std::size_t vertex_count(const Complex& complex) {
    std::size_t count = 0;
    for (const auto& cell : complex) count = std::max(count, std::ranges::max(cell) + 1);
    return count;
}

std::vector<std::vector<std::size_t>> symmetries(const Complex& complex) {
    const std::vector<unsigned> cells = cells_at_vertices(complex);
    std::vector<std::size_t> new_cells(complex.size());
    std::iota(new_cells.begin(), new_cells.end(), 0U);
    std::vector<std::vector<std::size_t>> result;
    do {
        std::vector<unsigned> wanted(cells.size(), 0);
        for (std::size_t v = 0; v < cells.size(); ++v) {
            for (std::size_t c = 0; c < complex.size(); ++c) {
                wanted[v] |= (cells[v] >> c & 1U) << new_cells[c];
            }
        }
        std::vector<std::size_t> numbers;
        add_numberings(result, numbers, cells, wanted);
    } while (std::ranges::next_permutation(new_cells).found);
    return result;
}

std::vector<OrderClasses> classes_of_cells(const Complex& complex) {
    std::vector<OrderClasses> classes;
    for (std::size_t cell = 0; cell < complex.size(); ++cell) {
        classes.push_back(classes_of_orders(shared_edges(complex, cell)));
    }
    return classes;
}

}  // namespace octetra::properties
