#include "adapt/transfer_fields.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace octetra::cli {
namespace {

using distributed::Adaptation;
using distributed::Field;

/// For coarsening: returns whether all cells that were merged had equal values.
template <class T>
bool are_kept(const std::vector<T>& pieces, const std::vector<T>& wholes, std::size_t components,
              const distributed::EntityTransfer& cells) {
    const auto coarse_of = cells.coarse_of();
    for (std::size_t c = 0; c < coarse_of.size(); ++c) {
        for (std::size_t k = 0; k < components; ++k) {
            if (pieces[c * components + k] != wholes[coarse_of[c] * components + k]) return false;
        }
    }
    return true;
}

/// Transfers a field on this process; returns false if that is impossible.
bool transfer_field(Field& field, const Adaptation& step) {
    const auto transfer_values = [&]<class T>(std::vector<T>& values) {
        if (field.on == FieldOn::vertices) {
            if (!std::floating_point<T> && !step.is_coarser()) return false;
            values = step.transfer_vertices(std::move(values), field.components);
            return true;
        }
        if (std::floating_point<T> || !step.is_coarser()) {
            values = step.transfer_cells(std::move(values), field.components);
            return true;
        }
        const std::vector<T> pieces = std::move(values);
        values = step.transfer_cells(pieces, field.components);
        return are_kept(pieces, values, field.components, step.cells);
    };
    return std::visit(transfer_values, field.values);
}

/// Returns "field 'a' is" or "fields 'a', 'b' are".
std::string named_fields(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) {
        list += fmt::format("{}'{}'", list.empty() ? "" : ", ", name);
    }
    return names.size() == 1 ? fmt::format("field {} is", list)
                             : fmt::format("fields {} are", list);
}

}  // namespace

std::vector<std::string> transfer_fields(std::vector<Field>& fields, const Adaptation& step,
                                         const distributed::Communicator& world) {
    std::vector<std::string> on_vertices;
    std::vector<std::string> on_cells;
    std::vector<Field> transferred;
    for (Field& field : fields) {
        const bool lost_here = !transfer_field(field, step);
        if (world.max(std::uint64_t{lost_here ? 1U : 0U}) == 0) {
            transferred.push_back(std::move(field));
        } else {
            (field.on == FieldOn::vertices ? on_vertices : on_cells).push_back(field.name);
        }
    }
    fields = std::move(transferred);
    std::vector<std::string> dropped;
    if (!on_vertices.empty()) {
        dropped.push_back(
            named_fields(on_vertices) +
            " dropped: whole numbers of an edge's ends have no mean for its midpoint");
    }
    if (!on_cells.empty()) {
        dropped.push_back(named_fields(on_cells) +
                          " dropped: merged cells had different whole numbers");
    }
    return dropped;
}

void transfer_fields(std::vector<Field>& fields, const distributed::Migration& move) {
    for (Field& field : fields) {
        std::visit(
            [&](auto& values) {
                values = field.on == FieldOn::vertices
                             ? move.vertices(std::move(values), field.components)
                             : move.cells(std::move(values), field.components);
            },
            field.values);
    }
}

}  // namespace octetra::cli
