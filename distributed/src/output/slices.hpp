#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Values for one process's slice with their positions there, which strictly ascend.
template <class T>
class ValuesOfSlice {
public:
    explicit ValuesOfSlice(std::size_t likely_count) { make_room(likely_count); }

    [[nodiscard]] std::span<const std::uint32_t> positions() const {
        return {positions_.get(), count_};
    }
    [[nodiscard]] std::span<const T> values() const { return {values_.get(), count_}; }

    void clear() { count_ = 0; }
    void put(std::uint32_t position, const T& value) {
        if (count_ == room_) make_room(2 * room_);
        positions_[count_] = position;
        values_[count_] = value;
        ++count_;
    }

private:
    void make_room(std::size_t room) {
        auto positions = std::make_unique_for_overwrite<std::uint32_t[]>(room);
        auto values = std::make_unique_for_overwrite<T[]>(room);
        std::ranges::copy(this->positions(), positions.get());
        std::ranges::copy(this->values(), values.get());
        positions_ = std::move(positions);
        values_ = std::move(values);
        room_ = room;
    }

    std::size_t count_ = 0;
    std::size_t room_ = 0;
    std::unique_ptr<std::uint32_t[]> positions_;
    std::unique_ptr<T[]> values_;
};

namespace detail {

/// Encodings of positions in a message; the shortest one is used.
enum class PositionEncoding : std::uint64_t {
    one_by_one,  ///< each position
    by_runs,     ///< runs of consecutive positions
    by_bits      ///< a bit for each position up to the last
};

/// The header of a message. It is followed by the values, and then by their positions.
struct SliceHead {
    std::uint64_t values;
    PositionEncoding encoding;
    std::uint64_t count;  ///< number of positions, runs, or 64-bit words
};
struct SliceRun {
    std::uint32_t position;
    std::uint32_t count;
};

template <class T>
T read_from(const std::byte* place) {
    T value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

inline std::byte* put_bytes(std::byte* place, const void* data, std::size_t size) {
    std::memcpy(place, data, size);
    return place + size;
}

inline void put_runs(std::byte* place, std::span<const std::uint32_t> positions) {
    for (std::size_t begin = 0; begin < positions.size();) {
        std::size_t end = begin + 1;
        while (end < positions.size() && positions[end] == positions[end - 1] + 1) ++end;
        const SliceRun run{positions[begin], static_cast<std::uint32_t>(end - begin)};
        place = put_bytes(place, &run, sizeof run);
        begin = end;
    }
}

inline void put_bits(std::byte* place, std::span<const std::uint32_t> positions) {
    std::uint64_t bits = 0;
    std::uint32_t word = 0;
    for (const std::uint32_t position : positions) {
        for (; word < position / 64; ++word) {
            place = put_bytes(place, &bits, sizeof bits);
            bits = 0;
        }
        bits |= std::uint64_t{1} << position % 64;
    }
    put_bytes(place, &bits, sizeof bits);
}

/// Returns the header for positions, of which there is at least one, and the size of their encoding
/// in bytes.
inline std::pair<SliceHead, std::size_t> head_of(std::span<const std::uint32_t> positions) {
    std::size_t runs = 1;
    for (std::size_t i = 1; i < positions.size(); ++i) {
        runs += std::size_t{positions[i] != positions[i - 1] + 1};
    }
    const std::size_t words = positions.back() / 64 + 1;
    SliceHead head{positions.size(), PositionEncoding::one_by_one, positions.size()};
    std::size_t size = positions.size_bytes();
    const auto is_less = [&](PositionEncoding encoding, std::size_t count,
                             std::size_t size_of_one) {
        if (count * size_of_one >= size) return;
        head.encoding = encoding;
        head.count = count;
        size = count * size_of_one;
    };
    is_less(PositionEncoding::by_runs, runs, sizeof(SliceRun));
    is_less(PositionEncoding::by_bits, words, sizeof(std::uint64_t));
    return {head, size};
}

}  // namespace detail

template <class T>
[[nodiscard]] std::vector<std::byte> packed(const ValuesOfSlice<T>& all) {
    const auto positions = all.positions();
    if (positions.empty()) return {};
    const auto [head, size] = detail::head_of(positions);
    std::vector<std::byte> bytes(sizeof head + all.values().size_bytes() + size);
    std::byte* place = detail::put_bytes(bytes.data(), &head, sizeof head);
    place = detail::put_bytes(place, all.values().data(), all.values().size_bytes());
    switch (head.encoding) {
        case detail::PositionEncoding::one_by_one:
            detail::put_bytes(place, positions.data(), size);
            break;
        case detail::PositionEncoding::by_runs: detail::put_runs(place, positions); break;
        case detail::PositionEncoding::by_bits: detail::put_bits(place, positions); break;
    }
    return bytes;
}

/// Calls place(position, value) for each value of a message.
template <class T>
void unpack(std::span<const std::byte> bytes, auto&& place) {
    if (bytes.empty()) return;
    const auto head = detail::read_from<detail::SliceHead>(bytes.data());
    const std::byte* value = bytes.data() + sizeof head;
    const std::byte* where = value + head.values * sizeof(T);
    const auto next = [&]<class Where>(Where) {
        return detail::read_from<Where>(std::exchange(where, where + sizeof(Where)));
    };
    const auto put = [&](std::uint32_t position) {
        place(position, detail::read_from<T>(std::exchange(value, value + sizeof(T))));
    };
    for (std::uint64_t i = 0; i < head.count; ++i) {
        switch (head.encoding) {
            case detail::PositionEncoding::one_by_one: put(next(std::uint32_t{})); break;
            case detail::PositionEncoding::by_runs: {
                const auto run = next(detail::SliceRun{});
                for (std::uint32_t k = 0; k < run.count; ++k) put(run.position + k);
                break;
            }
            case detail::PositionEncoding::by_bits: {
                const auto first = static_cast<std::uint32_t>(64 * i);
                for (auto bits = next(std::uint64_t{}); bits != 0; bits &= bits - 1) {
                    put(first + static_cast<std::uint32_t>(std::countr_zero(bits)));
                }
                break;
            }
        }
    }
}

/// Collective. Sends values from the processes that have them to the processes whose slice of a
/// window contains them. `between(begin, end, emit)` calls emit(number, value) for this process's
/// values numbered begin .. end - 1, ascending. `place(position, value)` is called for each value
/// of this process's slice, once for each process that has it; the position is relative to the
/// slice.
template <class T>
void send_to_slices(const Communicator& processes, const Window& window, auto&& between,
                    auto&& place) {
    std::vector<std::vector<std::byte>> outboxes(static_cast<std::size_t>(processes.size()));
    ValuesOfSlice<T> some(std::clamp<std::uint64_t>(window.slice_length, 1, 1U << 15U));
    for (int rank = 0; rank < processes.size(); ++rank) {
        const std::uint64_t begin = window.begin_of(rank);
        const std::uint64_t end = window.end_of(rank);
        if (begin == end) continue;
        if (rank == processes.rank()) {
            between(begin, end, [&](std::uint64_t number, const T& value) {
                place(static_cast<std::uint32_t>(number - begin), value);
            });
            continue;
        }
        some.clear();
        between(begin, end, [&](std::uint64_t number, const T& value) {
            some.put(static_cast<std::uint32_t>(number - begin), value);
        });
        outboxes[static_cast<std::size_t>(rank)] = packed(some);
    }
    for (const auto& bytes : processes.all_to_all(outboxes)) unpack<T>(bytes, place);
}

/// Same as above, for values that are equal on all processes that have them.
template <class T>
void send_to_slices(const Communicator& processes, const Window& window, auto&& between,
                    std::vector<T>& slice) {
    slice.resize(window.end_of(processes.rank()) - window.begin_of(processes.rank()));
    send_to_slices<T>(processes, window, between,
                      [&](std::uint32_t position, const T& value) { slice[position] = value; });
}

}  // namespace octetra::distributed
