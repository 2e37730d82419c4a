#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::verify {

/// A multimap from sets of N vertices, in any order, to 64-bit tags: buckets by smallest vertex,
/// sorted within a bucket. Memory: 8 bytes per vertex and 4 N + 4 (rounded up to a multiple of 8)
/// per set.
template <std::size_t N>
class Buckets {
public:
    using Vertices = std::array<VertexIndex, N>;
    struct Entry {
        std::array<std::uint32_t, N - 1> rest;  ///< all but the smallest vertex, ascending
        std::uint64_t tag;
    };

    Buckets() = default;

    /// `for_each(visit)` calls visit(vertices, tag) for each set, and is itself called twice.
    /// Precondition: vertices are less than `vertex_count`.
    Buckets(std::size_t vertex_count, auto&& for_each) : begin_(vertex_count + 1, 0) {
        for_each([&](const Vertices& v, std::uint64_t) { ++begin_[smallest(v) + 1]; });
        for (std::size_t i = 0; i < vertex_count; ++i) begin_[i + 1] += begin_[i];
        entries_.resize(begin_[vertex_count]);
        std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
        for_each([&](const Vertices& v, std::uint64_t tag) {
            const auto sorted = ascending(v);
            entries_[next[sorted[0]]++] = entry_of(sorted, tag);
        });
        for (std::size_t i = 0; i < vertex_count; ++i) {
            std::sort(at(begin_[i]), at(begin_[i + 1]), [](const Entry& a, const Entry& b) {
                return has_same_rest(a, b) ? a.tag < b.tag : precedes(a, b);
            });
        }
    }

    /// Returns all entries with these vertices, by ascending tag.
    [[nodiscard]] std::span<const Entry> find(const Vertices& v) const {
        const auto sorted = ascending(v);
        const Entry wanted = entry_of(sorted, 0);
        const auto end = entries_.begin() + offset(begin_[sorted[0] + 1]);
        const auto first =
            std::lower_bound(entries_.begin() + offset(begin_[sorted[0]]), end, wanted, precedes);
        auto last = first;
        while (last != end && has_same_rest(*last, wanted)) ++last;
        return {first, last};
    }

    [[nodiscard]] bool contains(const Vertices& v) const { return !find(v).empty(); }

    /// Calls visit(vertices, entries) for each distinct set, in ascending order, with vertices
    /// ascending.
    void for_each_group(auto&& visit) const {
        for (std::size_t i = 0; i + 1 < begin_.size(); ++i) {
            std::size_t first = begin_[i];
            while (first < begin_[i + 1]) {
                std::size_t last = first + 1;
                while (last < begin_[i + 1] && has_same_rest(entries_[last], entries_[first])) {
                    ++last;
                }
                Vertices v;
                v[0] = VertexIndex{i};
                for (std::size_t k = 1; k < N; ++k) v[k] = VertexIndex{entries_[first].rest[k - 1]};
                visit(v, std::span<const Entry>(&entries_[first], last - first));
                first = last;
            }
        }
    }

private:
    using Numbers = std::array<std::uint32_t, N>;

    /// The first two numbers of the rest as one, which compares faster.
    static std::uint64_t leading(const Entry& e) {
        if constexpr (N == 2) {
            return e.rest[0];
        } else {
            return std::uint64_t{e.rest[0]} << 32U | e.rest[1];
        }
    }
    static bool precedes(const Entry& a, const Entry& b) {
        if constexpr (N == 4) {
            if (leading(a) == leading(b)) return a.rest[2] < b.rest[2];
        }
        return leading(a) < leading(b);
    }
    static bool has_same_rest(const Entry& a, const Entry& b) {
        if constexpr (N == 4) {
            if (a.rest[2] != b.rest[2]) return false;
        }
        return leading(a) == leading(b);
    }

    static Numbers ascending(const Vertices& v) {
        Numbers n;
        for (std::size_t i = 0; i < N; ++i) {  // insertion sort: N is at most 4
            const std::uint32_t value = v[i].value();
            std::size_t k = i;
            for (; k > 0 && n[k - 1] > value; --k) n[k] = n[k - 1];
            n[k] = value;
        }
        return n;
    }
    static std::uint32_t smallest(const Vertices& v) { return ascending(v)[0]; }
    static Entry entry_of(const Numbers& sorted, std::uint64_t tag) {
        Entry e{{}, tag};
        for (std::size_t k = 1; k < N; ++k) e.rest[k - 1] = sorted[k];
        return e;
    }
    static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }
    auto at(std::size_t i) { return entries_.begin() + offset(i); }

    std::vector<std::uint64_t> begin_;
    std::vector<Entry> entries_;
};

}  // namespace octetra::verify
