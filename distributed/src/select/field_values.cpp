#include "select/field_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>

#include <fmt/format.h>

#include <octetra/core/cell_quantities.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/mean_of_four.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/exchange.hpp>

#include "numbering/cell_numbers.hpp"
#include "numbering/lowest_fault.hpp"
#include "select/size_values.hpp"

namespace octetra::distributed {
namespace {

/// Returns a number for each entity: the value, or the length of the vector of the components.
std::vector<double> numbers_of(const Field& field) {
    return std::visit(
        [&](const auto& values) {
            std::vector<double> numbers;
            numbers.reserve(values.size() / field.components);
            for (std::size_t i = 0; i < values.size(); i += field.components) {
                if (field.components == 1) {
                    numbers.push_back(static_cast<double>(values[i]));
                    continue;
                }
                double squares = 0;
                for (std::size_t k = i; k < i + field.components; ++k) {
                    const auto value = static_cast<double>(values[k]);
                    squares += value * value;
                }
                numbers.push_back(std::sqrt(squares));
            }
            return numbers;
        },
        field.values);
}

std::vector<double> maxima_of(const DistributedMesh& mesh, const std::vector<double>& of_vertex) {
    std::vector<double> of_cell;
    of_cell.reserve(mesh.cells.size());
    for (const auto& [a, b, c, d] : mesh.cells) {
        const std::array<double, 4> values{of_vertex[a.value()], of_vertex[b.value()],
                                           of_vertex[c.value()], of_vertex[d.value()]};
        const auto nan = std::ranges::find_if(values, [](double v) { return std::isnan(v); });
        of_cell.push_back(nan != values.end() ? *nan : std::ranges::max(values));
    }
    return of_cell;
}

/// Collective. Throws InputError for the invalid indicator of the cell with the lowest number of
/// all.
void check_indicators(const DistributedMesh& mesh, const Term& term,
                      std::span<const double> indicators) {
    const auto is_indicator = [](double x) { return x >= 0 && std::isfinite(x); };
    const auto fault =
        lowest_fault(mesh.processes, indicators, is_indicator, [&] { return cell_numbers(mesh); });
    if (!fault) return;
    throw InputError(
        fmt::format("{}: the indicator of cell {} is {}, not a finite number of at "
                    "least 0",
                    text_of(term), fault->number + mesh.index_base, fault->value));
}

}  // namespace

const Field& find_field(const Term& term, std::span<const Field> fields) {
    for (const FieldOn on : {FieldOn::cells, FieldOn::vertices}) {
        for (const Field& field : fields) {
            if (field.on == on && field.name == term.name) return field;
        }
    }
    std::vector<std::string> names;
    for (const Field& field : fields) names.push_back(field.name);
    refuse_field(term, names);
}

std::vector<double> means_of(const DistributedMesh& mesh, std::span<const double> of_vertex) {
    std::vector<double> of_cell;
    of_cell.reserve(mesh.cells.size());
    for (const auto& [a, b, c, d] : mesh.cells) {
        of_cell.push_back(mean_of_four(of_vertex[a.value()], of_vertex[b.value()],
                                       of_vertex[c.value()], of_vertex[d.value()]));
    }
    return of_cell;
}

std::vector<double> field_values(const DistributedMesh& mesh, const Term& term,
                                 const FieldsToUse& given) {
    if (term.quantity == Quantity::metric_longest || term.quantity == Quantity::size) {
        return size_values(mesh, term, given);
    }
    const Field& field = find_field(term, given.fields);
    std::vector<double> values = numbers_of(field);
    if (field.on == FieldOn::vertices) {
        update_copies(mesh.processes, *given.sharing, mesh.points.size(), values);
        values =
            term.quantity == Quantity::field_max ? maxima_of(mesh, values) : means_of(mesh, values);
    }
    if (term.quantity == Quantity::field || term.quantity == Quantity::field_max) return values;
    check_indicators(mesh, term, values);
    const std::vector<std::uint8_t> marks = term.quantity == Quantity::bulk
                                                ? mark_bulk(mesh.processes, values, term.share)
                                                : mark_fraction(mesh.processes, values, term.share);
    return {marks.begin(), marks.end()};
}

}  // namespace octetra::distributed
