#pragma once

#include <algorithm>
#include <cstdint>

#include <octetra/core/mesh_source.hpp>
#include <octetra/core/window_pieces.hpp>

#include "files/output/number_text.hpp"
#include "files/output/output_file.hpp"

namespace octetra {

/// Returns the number of list entries that each process puts in one turn: few enough for a buffer,
/// and enough to make turns rare; of a short list, an equal share.
[[nodiscard]] inline std::uint64_t lines_of_a_turn(std::uint64_t count, const ProcessGroup& group) {
    const std::uint64_t most = group.size() > 1 ? 1U << 15U : 1U << 12U;
    return std::clamp(count / static_cast<std::uint64_t>(group.size()) + 1, std::uint64_t{1}, most);
}

/// Collective. Calls put_slice(window, number of the slice's first entity) for this process's
/// slices of a list, in turns with the other processes.
void put_list(OutputFile& out, std::uint64_t count, const ProcessGroup& group, auto&& put_slice) {
    const std::uint64_t length = lines_of_a_turn(count, group);
    const std::uint64_t stride = length * static_cast<std::uint64_t>(group.size());
    for (Window window{0, length, count}; window.begin < count; window.begin += stride) {
        put_slice(window, window.begin_of(group.rank()));
        if (group.size() > 1) out.end_turn_later();
    }
}

/// Returns a window that is the whole list, with one slice for each process.
[[nodiscard]] inline Window share_window(std::uint64_t count, const ProcessGroup& group) {
    const auto processes = static_cast<std::uint64_t>(group.size());
    return {0, (count + processes - 1) / processes, count};
}

/// Collective. Same as put_list(), if each process can compute the size in bytes of its slice of
/// share_window(): then no process waits for the output of lower ranks. In most meshes a block of
/// the canonical order lies in few parts, so that turns would keep most processes idle.
void put_list_in_ranges(OutputFile& out, std::uint64_t count, const ProcessGroup& group,
                        auto&& bytes_of, auto&& put_slice) {
    if (group.size() == 1) return put_list(out, count, group, put_slice);
    const Window stretches = share_window(count, group);
    out.begin_ranges(bytes_of(stretches));
    for_each_piece(stretches, lines_of_a_turn(count, group), [&](const Window& window) {
        put_slice(window, window.begin_of(group.rank()));
        out.end_turn_later();
    });
    out.end_ranges();
}

/// Same for rows of `row_size` bytes.
void put_list_of_rows(OutputFile& out, std::uint64_t count, const ProcessGroup& group,
                      std::size_t row_size, auto&& put_slice) {
    const auto bytes_of = [&](const Window& stretches) {
        return stretches.length_of(group.rank()) * row_size;
    };
    put_list_in_ranges(out, count, group, bytes_of, put_slice);
}

/// Returns the total length of the numbers begin .. end - 1 as text.
[[nodiscard]] inline std::uint64_t text_length_between(std::uint64_t begin, std::uint64_t end) {
    std::uint64_t length = 0;
    while (begin < end) {
        const std::uint64_t digits = text_length(begin);
        std::uint64_t more = 1;  // the first number with more digits
        for (std::uint64_t k = 0; k < digits; ++k) more *= 10;
        const std::uint64_t next = more > begin ? std::min(end, more) : end;
        length += (next - begin) * digits;
        begin = next;
    }
    return length;
}

/// Returns the size in bytes of the row numbers of a process's slice as text, with one separator
/// after each; the rows of the list are numbered from `first`.
[[nodiscard]] inline std::uint64_t bytes_of_row_numbers(const Window& slices, int rank,
                                                        std::uint64_t first) {
    return text_length_between(first + slices.begin_of(rank), first + slices.end_of(rank)) +
           slices.length_of(rank);
}

}  // namespace octetra
