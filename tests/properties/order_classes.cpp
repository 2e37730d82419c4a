#include "properties/order_classes.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <octetra/core/mesh.hpp>

namespace octetra::properties {
namespace {

/// The edges of the four faces; face i lies opposite corner i.
constexpr std::array<EdgeBits, 4> edges_of_faces() {
    std::array<EdgeBits, 4> faces{};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t e = 0; e < 6; ++e) {
            if (cell_edges[e][0] != i && cell_edges[e][1] != i) faces[i] |= 1U << e;
        }
    }
    return faces;
}

EdgeBits longest_of(const Order& order, EdgeBits edges) {
    for (const std::size_t e : order) {
        if ((edges >> e & 1U) != 0) return 1U << e;
    }
    return 0;
}

/// The edges that a cell marks: none, or those of scheme 4t or 2t.
std::array<EdgeBits, 3> marked_inside(const Order& order) {
    EdgeBits of_faces = 0;
    for (const EdgeBits face : edges_of_faces()) of_faces |= longest_of(order, face);
    return {0, of_faces, 1U << order.front()};
}

/// For each set of marks inside and outside, the shared edges that are marked after closure.
std::vector<EdgeBits> response(const Order& order, EdgeBits shared) {
    std::vector<EdgeBits> result;
    for (const EdgeBits inside : marked_inside(order)) {
        for (EdgeBits outside = 0; outside < 1U << 6U; ++outside) {
            if ((outside & ~shared) != 0) continue;
            result.push_back(closed_in_cell(order, inside | outside) & shared);
        }
    }
    return result;
}

}  // namespace

std::size_t number_of(const Order& order) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        std::size_t smaller_behind = 0;
        for (std::size_t k = i + 1; k < 6; ++k) smaller_behind += order[k] < order[i] ? 1U : 0U;
        number = number * (6 - i) + smaller_behind;
    }
    return number;
}

EdgeBits closed_in_cell(const Order& order, EdgeBits marked) {
    while (true) {
        EdgeBits more = marked;
        for (const EdgeBits face : edges_of_faces()) {
            if ((more & face) != 0) more |= longest_of(order, face);
        }
        if (more == marked) return marked;
        marked = more;
    }
}

OrderClasses classes_of_orders(EdgeBits shared) {
    OrderClasses result;
    std::map<std::pair<std::vector<std::size_t>, std::vector<EdgeBits>>, std::size_t> numbers;
    Order order{0, 1, 2, 3, 4, 5};
    do {
        std::vector<std::size_t> descending;
        for (const std::size_t e : order) {
            if ((shared >> e & 1U) != 0) descending.push_back(e);
        }
        const auto [place, is_new] =
            numbers.emplace(std::pair(descending, response(order, shared)), numbers.size());
        if (is_new) result.classes.push_back({descending, 0});
        result.class_of.push_back(place->second);
        ++result.classes[place->second].size;
    } while (std::ranges::next_permutation(order).found);
    return result;
}

}  // namespace octetra::properties
