#include "output/field_slices.hpp"

#include <algorithm>
#include <cstring>
#include <variant>

#include "output/check_fields.hpp"
#include "output/slices.hpp"

namespace octetra::distributed {
namespace {

/// Calls visit(number, local index) for the values of entities begin .. end - 1 that this process
/// sends.
void for_each_sent(const FieldsOfPart& part, FieldOn on, std::uint64_t begin, std::uint64_t end,
                   auto&& visit) {
    if (on == FieldOn::cells) {
        for_each_between(
            *part.cell_runs, *part.cell_ancestors, begin, end,
            [&](std::uint64_t number, std::size_t place, std::size_t) {
                visit(number, part.cells_before.empty() ? place : part.cells_before[place].value());
            });
        return;
    }
    const auto& numbers = part.numbers->of_vertex;
    const auto from = std::ranges::lower_bound(numbers, GlobalVertex{begin});
    for (VertexIndex v{static_cast<std::size_t>(from - numbers.begin())};
         v < numbers.end_index() && numbers[v] < GlobalVertex{end}; ++v) {
        if (part.sharing->is_owned(v)) visit(static_cast<std::uint64_t>(numbers[v]), v.value());
    }
}

template <class T>
void send_values(const FieldsOfPart& part, const Field& field, const std::vector<T>& values,
                 const Window& window, std::vector<std::byte>& slice) {
    const int rank = part.processes->rank();
    const std::uint64_t length = window.end_of(rank) - window.begin_of(rank);
    slice.resize(length * field.components * sizeof(T));
    for (std::size_t k = 0; k < field.components; ++k) {
        const auto emit_values = [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            for_each_sent(part, field.on, begin, end, [&](std::uint64_t entity, std::size_t local) {
                emit(entity, values[local * field.components + k]);
            });
        };
        send_to_slices<T>(*part.processes, window, emit_values,
                          [&](std::uint32_t position, const T& value) {
                              const std::size_t i = position * field.components + k;
                              std::memcpy(slice.data() + i * sizeof(T), &value, sizeof(T));
                          });
    }
}

}  // namespace

FieldSlices::FieldSlices(const FieldsOfPart& part) : part_(part) {
    for (const Field& field : part.fields) facts_.push_back(facts_of(field));
}

std::span<const std::byte> FieldSlices::values(std::size_t field, const Window& window) {
    const Field& asked = part_.fields[field];
    std::visit([&](const auto& values) { send_values(part_, asked, values, window, slice_); },
               asked.values);
    return slice_;
}

}  // namespace octetra::distributed
