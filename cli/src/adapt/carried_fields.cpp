#include "adapt/carried_fields.hpp"

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace octetra::cli {
namespace {

using distributed::Adaptation;
using distributed::Field;

/// The value of a cell whose pieces had these; none, where whole numbers differ. What it is does
/// not depend on the order of the pieces, which is not the same on any number of processes.
template <class T>
std::optional<T> value_of_whole(std::span<T> pieces) {
    const auto less = [](T a, T b) { return std::strong_order(a, b) < 0; };
    std::ranges::sort(pieces, less);
    if (!less(pieces.front(), pieces.back())) return pieces.front();
    if constexpr (std::floating_point<T>) {
        const T count = static_cast<T>(pieces.size());
        return std::accumulate(pieces.begin(), pieces.end(), T{0},
                               [&](T sum, T value) { return sum + value / count; });
    } else {
        return std::nullopt;
    }
}

/// The pieces of each whole, one whole after the other: pieces[first[w]] to pieces[first[w + 1]].
struct PiecesOfWholes {
    std::vector<std::size_t> first;
    std::vector<std::uint32_t> pieces;
};

PiecesOfWholes pieces_of_wholes(const distributed::Succession& cells) {
    const auto whole_of = cells.whole_of();
    PiecesOfWholes all{std::vector<std::size_t>(cells.count() + 1, 0),
                       std::vector<std::uint32_t>(whole_of.size())};
    for (const std::uint32_t whole : whole_of) ++all.first[whole + std::size_t{1}];
    std::partial_sum(all.first.begin(), all.first.end(), all.first.begin());
    std::vector<std::size_t> next = all.first;
    for (std::size_t piece = 0; piece < whole_of.size(); ++piece) {
        all.pieces[next[whole_of[piece]]++] = static_cast<std::uint32_t>(piece);
    }
    return all;
}

/// The values of wholes; none where those of whole numbers differ.
template <class T>
std::optional<std::vector<T>> merged(const std::vector<T>& values, std::size_t components,
                                     const distributed::Succession& cells) {
    const PiecesOfWholes all = pieces_of_wholes(cells);
    std::vector<T> wholes;
    wholes.reserve(cells.count() * components);
    std::vector<T> of_pieces;
    for (std::size_t whole = 0; whole < cells.count(); ++whole) {
        for (std::size_t k = 0; k < components; ++k) {
            of_pieces.clear();
            for (std::size_t p = all.first[whole]; p < all.first[whole + 1]; ++p) {
                of_pieces.push_back(values[all.pieces[p] * components + k]);
            }
            const std::optional<T> value = value_of_whole(std::span<T>(of_pieces));
            if (!value) return std::nullopt;
            wholes.push_back(*value);
        }
    }
    return wholes;
}

/// Carries one field on this process; false where it cannot be.
bool carry(Field& field, const Adaptation& step) {
    const auto carry_values = [&]<class T>(std::vector<T>& values) {
        if (field.on == FieldOn::vertices) {
            if (!std::floating_point<T> && !step.is_coarser()) return false;
            values = step.transfer_vertices(std::move(values), field.components);
        } else if (!step.is_coarser()) {
            values = step.transfer_cells(std::move(values), field.components);
        } else {
            auto wholes = merged(values, field.components, step.cells);
            if (!wholes) return false;
            values = *std::move(wholes);
        }
        return true;
    };
    return std::visit(carry_values, field.values);
}

/// "field 'a' is", "fields 'a', 'b' are".
std::string named_fields(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) {
        list += fmt::format("{}'{}'", list.empty() ? "" : ", ", name);
    }
    return names.size() == 1 ? fmt::format("field {} is", list)
                             : fmt::format("fields {} are", list);
}

}  // namespace

std::vector<std::string> carry_fields(std::vector<Field>& fields, const Adaptation& step,
                                      const distributed::Communicator& world) {
    std::vector<std::string> on_vertices;
    std::vector<std::string> on_cells;
    std::vector<Field> carried;
    for (Field& field : fields) {
        const bool lost_here = !carry(field, step);
        if (world.max(std::uint64_t{lost_here ? 1U : 0U}) == 0) {
            carried.push_back(std::move(field));
        } else {
            (field.on == FieldOn::vertices ? on_vertices : on_cells).push_back(field.name);
        }
    }
    fields = std::move(carried);
    std::vector<std::string> dropped;
    if (!on_vertices.empty()) {
        dropped.push_back(
            named_fields(on_vertices) +
            " dropped: whole numbers of an edge's ends have no mean for its midpoint");
    }
    if (!on_cells.empty()) {
        dropped.push_back(named_fields(on_cells) +
                          " dropped: cells that became one had different whole numbers");
    }
    return dropped;
}

void carry_fields(std::vector<Field>& fields, const distributed::Migration& move) {
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
