#include "select/size_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/distributed/exchange.hpp>

#include "numbering/cell_numbers.hpp"
#include "select/field_values.hpp"

namespace octetra::distributed {
namespace {

constexpr std::size_t metric_components = 6;

/// A symmetric tensor: xx, yy, zz, xy, yz, xz.
using Metric = std::array<double, metric_components>;

Metric metric_at(std::span<const double> values, std::size_t entity) {
    Metric metric{};
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(entity * metric_components),
                metric_components, metric.begin());
    return metric;
}

/// Divides the numbers by the power of two 2^e for which the greatest is about 1. Returns e, which
/// is even.
int scale(std::span<double> numbers) {
    double greatest = 0;
    for (const double x : numbers) greatest = std::max(greatest, std::abs(x));
    if (!(greatest > 0) || !std::isfinite(greatest)) return 0;
    const int exponent = std::ilogb(greatest) / 2 * 2;
    for (double& x : numbers) x = std::scalbn(x, -exponent);
    return exponent;
}

/// False for a metric with a value that is no finite number. Whether a metric that is singular up
/// to rounding counts as positive definite depends on the order of its components.
bool is_positive_definite(Metric metric) {
    scale(metric);
    const auto& [xx, yy, zz, xy, yz, xz] = metric;
    if (!std::ranges::all_of(metric, [](double x) { return std::isfinite(x); })) return false;
    if (!(xx > 0)) return false;
    const double second = yy - xy * xy / xx;
    if (!(second > 0)) return false;
    const double mixed = yz - xy * xz / xx;
    return zz - xz * xz / xx - mixed * mixed / second > 0;
}

/// Returns the length of an edge in the mean of two metrics, alike in both directions.
double length_in(const Metric& at_a, const Metric& at_b, const Point& a, const Point& b) {
    Metric metric{};
    for (std::size_t k = 0; k < metric_components; ++k) metric[k] = at_a[k] / 2 + at_b[k] / 2;
    std::array<double, 3> along{b.x / 2 - a.x / 2, b.y / 2 - a.y / 2, b.z / 2 - a.z / 2};
    const int exponent = scale(along) + 1 + scale(metric) / 2;
    const auto& [xx, yy, zz, xy, yz, xz] = metric;
    const auto& [x, y, z] = along;
    const double square =
        ((xx * x * x + yy * y * y) + zz * z * z) + 2 * ((xy * x * y + yz * y * z) + xz * x * z);
    return std::scalbn(std::sqrt(std::max(square, 0.0)), exponent);
}

/// Collective. Throws InputError for the lowest number of an entity with is_valid(entity) false on
/// any process. `numbers()` returns the numbers of entities; it is collective.
void check_values(const DistributedMesh& mesh, const Term& term, const Field& field,
                  std::size_t count, std::string_view fault, auto&& is_valid, auto&& numbers) {
    std::vector<std::size_t> faulty;
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_valid(i)) faulty.push_back(i);
    }
    if (mesh.processes.max(faulty.size()) == 0) return;
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t lowest = none;
    const auto number_of = numbers();
    for (const std::size_t i : faulty) lowest = std::min(lowest, number_of(i));
    lowest = none - mesh.processes.max(none - lowest);
    throw InputError(fmt::format(
        "{}: the {} of {} {} is not {}", text_of(term), field.components == 1 ? "size" : "metric",
        field.on == FieldOn::cells ? "cell" : "vertex", lowest + mesh.index_base, fault));
}

/// Collective. As above, for the values of the field.
void check_field(const DistributedMesh& mesh, const Term& term, const Field& field,
                 const CanonicalNumbers& vertices, std::span<const double> values) {
    const auto check = [&](auto&& numbers) {
        if (field.components == 1) {
            check_values(
                mesh, term, field, values.size(), "above 0",
                [&](std::size_t i) { return values[i] > 0; }, numbers);
        } else {
            check_values(
                mesh, term, field, values.size() / metric_components, "positive definite",
                [&](std::size_t i) { return is_positive_definite(metric_at(values, i)); }, numbers);
        }
    };
    if (field.on == FieldOn::vertices) {
        check([&] {
            return [&](std::size_t v) {
                return static_cast<std::uint64_t>(vertices.of_vertex[VertexIndex{v}]);
            };
        });
    } else {
        check([&] { return [of_cell = cell_numbers(mesh)](std::size_t c) { return of_cell[c]; }; });
    }
}

/// Returns the greatest length of the edges of a cell in the metric.
double longest_in_metric(const Corners& corners, const std::array<Metric, 4>& metrics) {
    double longest = 0;
    for (const auto& [i, j] : cell_edges) {
        longest = std::max(longest, length_in(metrics[i], metrics[j], corners[i], corners[j]));
    }
    return longest;
}

std::vector<double> values_in_metric(const DistributedMesh& mesh, const Term& term, FieldOn on,
                                     std::span<const double> values) {
    std::vector<double> of_cell;
    of_cell.reserve(mesh.cells.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        Corners corners;
        std::array<Metric, 4> metrics;
        for (std::size_t k = 0; k < 4; ++k) {
            const VertexIndex v = mesh.cells[c][k];
            corners[k] = mesh.points[v];
            metrics[k] = metric_at(values, on == FieldOn::cells ? c.value() : v.value());
        }
        const double longest = longest_in_metric(corners, metrics);
        of_cell.push_back(term.quantity == Quantity::size
                              ? value_of(Quantity::longest, {corners, 0, GlobalCell{0}}) / longest
                              : longest);
    }
    return of_cell;
}

void check_components(const Term& term, const Field& field) {
    const bool is_metric = field.components == metric_components;
    if (is_metric || (field.components == 1 && term.quantity == Quantity::size)) return;
    throw InputError(fmt::format("{}: the field has {} component{}; {}a metric has 6",
                                 text_of(term), field.components, field.components == 1 ? "" : "s",
                                 term.quantity == Quantity::size ? "a size has 1, and " : ""));
}

}  // namespace

std::vector<double> size_values(const DistributedMesh& mesh, const Term& term,
                                const FieldsToUse& given) {
    const Field& field = find_field(term, given.fields);
    check_components(term, field);
    std::vector<double> values =
        std::visit([](const auto& list) { return std::vector<double>(list.begin(), list.end()); },
                   field.values);
    if (field.on == FieldOn::vertices) {
        update_copies(mesh.processes, *given.sharing, mesh.points.size(), std::span<double>(values),
                      field.components);
    }
    check_field(mesh, term, field, *given.numbers, values);
    if (field.components == metric_components) {
        return values_in_metric(mesh, term, field.on, values);
    }
    return field.on == FieldOn::cells ? values : means_of(mesh, values);
}

}  // namespace octetra::distributed
