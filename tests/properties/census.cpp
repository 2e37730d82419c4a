#include "properties/census.hpp"

#include <algorithm>
#include <optional>

#include <octetra/core/edge_order.hpp>

namespace octetra::properties {
namespace {

/// Longest first; nothing if two edges have the same length.
std::optional<Order> order_without_ties(const std::vector<Point>& points,
                                        const std::array<std::size_t, 4>& cell) {
    std::array<double, 6> squared{};
    for (std::size_t e = 0; e < 6; ++e) {
        squared[e] =
            squared_length({points[cell[cell_edges[e][0]]], points[cell[cell_edges[e][1]]]});
    }
    Order order{0, 1, 2, 3, 4, 5};
    std::ranges::sort(order, [&](std::size_t e, std::size_t f) { return squared[e] > squared[f]; });
    for (std::size_t i = 0; i < 5; ++i) {
        if (squared[order[i]] == squared[order[i + 1]]) return {};
    }
    return order;
}

/// The number of the order of each cell.
using OrderNumbers = std::vector<std::size_t>;

std::optional<OrderNumbers> orders_of(const std::vector<Point>& points, const Complex& complex) {
    OrderNumbers numbers;
    for (const auto& cell : complex) {
        const auto order = order_without_ties(points, cell);
        if (!order) return {};
        numbers.push_back(number_of(*order));
    }
    return numbers;
}

constexpr std::uint64_t number_base =
    1024;  // greater than the numbers of orders, classes and cells

/// Combines the class of each cell into one number; `cell_with_order` contributes its order in
/// place of its class.
std::uint64_t joined(const Census& census, const OrderNumbers& orders,
                     std::size_t cell_with_order) {
    std::uint64_t number = cell_with_order;
    for (std::size_t c = 0; c < orders.size(); ++c) {
        const std::size_t order = orders[c];
        const std::size_t digit = c == cell_with_order ? order : census.classes[c].class_of[order];
        number = number * number_base + digit;
    }
    return number;
}

/// Calls `use` with the kind and the number of each combination.
template <class Use>
void for_each_combination(const Census& census, const OrderNumbers& orders, Use&& use) {
    use(1U, joined(census, orders, orders.size()));
    for (std::size_t c = 0; c < orders.size(); ++c) {
        use(0U, c * number_base + orders[c]);
        if (census.is_full) use(2U, joined(census, orders, c));
    }
}

/// At most about 1000 symmetries, evenly spaced: three cells apart from one another have 82,944.
std::vector<std::vector<std::size_t>> some_symmetries(const Complex& complex) {
    const std::vector<std::vector<std::size_t>> all = symmetries(complex);
    std::vector<std::vector<std::size_t>> some;
    for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / 1000) some.push_back(all[i]);
    return some;
}

}  // namespace

Census empty_census(const Complex& complex, bool is_full) {
    return {complex, is_full, classes_of_cells(complex), some_symmetries(complex), {}};
}

bool has_new(const Census& census, const std::vector<Point>& points) {
    const auto orders = orders_of(points, census.complex);
    if (!orders) return false;
    bool is_new = false;
    for_each_combination(census, *orders, [&](std::size_t kind, std::uint64_t number) {
        is_new = is_new || !census.met[kind].contains(number);
    });
    return is_new;
}

void note(Census& census, const std::vector<Point>& points) {
    std::vector<Point> image(points.size());
    for (const auto& numbers : census.symmetries) {
        for (std::size_t v = 0; v < points.size(); ++v) image[numbers[v]] = points[v];
        const auto orders = orders_of(image, census.complex);
        for_each_combination(census, orders.value(), [&](std::size_t kind, std::uint64_t number) {
            census.met[kind].insert(number);
        });
    }
}

CombinationCounts counts(const Census& census) {
    return {census.met[0].size(), census.met[1].size(), census.met[2].size()};
}

}  // namespace octetra::properties
