#include "level/full_sweep/edge_numbering.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/huge_pages.hpp>

namespace octetra::distributed {

/// Stars under construction, in buckets of sixteen edges, the size of a cache line. A vertex whose
/// bucket is full gets further buckets.
struct EdgeNumbering::Buckets {
    struct alignas(64) Bucket : std::array<VertexIndex, in_bucket> {};

    explicit Buckets(std::size_t vertices) : vertex_count(vertices) {
        reserve_with_room(of, vertex_count);
        of.resize(vertex_count);
    }
    /// Returns the bucket that follows another one, or 0.
    [[nodiscard]] std::uint32_t after(std::uint32_t bucket) const {
        return next.empty() ? 0 : next[bucket];
    }
    [[nodiscard]] std::uint32_t count_at(std::uint32_t vertex) const {
        std::uint32_t count = 0;
        std::uint32_t bucket = vertex;
        for (; after(bucket) != 0; bucket = after(bucket)) count += in_bucket;
        count += first_of_sixteen(of[bucket].data(), VertexIndex::none());
        return count < searched || !hub_counts.contains(vertex) ? count : hub_counts.at(vertex);
    }
    std::uint32_t add_after(std::uint32_t bucket) {
        const auto added = static_cast<std::uint32_t>(of.size());
        of.emplace_back();
        next.resize(of.size(), 0);
        return next[bucket] = added;
    }

    std::size_t vertex_count;
    std::vector<Bucket> of;  ///< one for each vertex, followed by further ones
    std::vector<std::uint32_t> next;
    std::unordered_map<std::uint32_t, std::uint32_t> hub_counts;  ///< above `searched` edges
};

EdgeNumbering::EdgeNumbering(std::size_t vertex_count,
                             const IndexVector<CellIndex, CellVertices>& cells) {
    number(vertex_count, cells.size(),
           [&](std::size_t k) -> const CellVertices& { return cells[CellIndex{k}]; });
}

EdgeNumbering::EdgeNumbering(std::size_t vertex_count,
                             const IndexVector<CellIndex, CellVertices>& cells,
                             std::vector<CellIndex> of)
    : of_(std::move(of)) {
    number(vertex_count, of_.size(),
           [&](std::size_t k) -> const CellVertices& { return cells[of_[k]]; });
    cell_to_row_.assign(cells.size(), static_cast<std::uint32_t>(of_.size()));
    for (std::uint32_t row = 0; row < of_.size(); ++row) cell_to_row_[of_[row]] = row;
    rows_.emplace_back().fill(other());
}

/// Numbers the edges of the cells cell_at(0) .. cell_at(cell_count - 1).
void EdgeNumbering::number(std::size_t vertex_count, std::size_t cell_count, const auto& cell_at) {
    Buckets buckets(vertex_count);
    find_positions(cell_count, cell_at, buckets);
    compact(buckets);
    for (std::size_t k = 0; k < cell_count; ++k) {
        const CellVertices& cell = cell_at(k);
        for (std::size_t e = 0; e < 6; ++e) {
            const auto& [a, b] = cell_edges[e];
            const VertexIndex low = std::min(cell[a], cell[b]);
            EdgeIndex& edge = rows_[k][e];
            edge = EdgeIndex{std::size_t{begin_[low.value()]} + edge.value()};
        }
    }
}

/// Determines for each edge of each cell its position in the star of its lower end.
void EdgeNumbering::find_positions(std::size_t cell_count, const auto& cell_at, Buckets& buckets) {
    constexpr std::size_t ahead = 8;
    reserve_in_huge_pages(rows_, cell_count + 1);
    for (std::size_t k = 0; k < cell_count; ++k) {
        if (k + ahead < cell_count) {
            for (const VertexIndex v : cell_at(k + ahead)) {
                __builtin_prefetch(&buckets.of[v.value()], 1);
            }
        }
        const CellVertices& cell = cell_at(k);
        auto& places = rows_.emplace_back();
        for (std::size_t e = 0; e < 6; ++e) {
            const VertexIndex a = cell[cell_edges[e][0]];
            const VertexIndex b = cell[cell_edges[e][1]];
            // Without a branch, which would be mispredicted.
            const std::uint32_t exchange = (a.value() ^ b.value()) & -std::uint32_t{b < a};
            const VertexIndex low{a.value() ^ exchange};
            const VertexIndex high{b.value() ^ exchange};
            auto& bucket = buckets.of[low.value()];
            std::uint32_t place = first_of_sixteen(bucket.data(), high);
            if (place == in_bucket) {
                place = first_of_sixteen(bucket.data(), VertexIndex::none());
                if (place < in_bucket) {
                    bucket[place] = high;
                } else {
                    place = find_overflow_position(low, high, buckets);
                }
            }
            places[e] = EdgeIndex{place};
        }
    }
}

/// The same for an edge that is not in the first bucket, which is full.
std::uint32_t EdgeNumbering::find_overflow_position(VertexIndex low, VertexIndex high,
                                                    Buckets& buckets) {
    std::uint32_t bucket = low.value();
    for (std::uint32_t before = in_bucket; before < searched; before += in_bucket) {
        const std::uint32_t next = buckets.after(bucket);
        bucket = next != 0 ? next : buckets.add_after(bucket);
        VertexIndex* const list = buckets.of[bucket].data();
        const std::uint32_t place = first_of_sixteen(list, high);
        if (place < in_bucket) return before + place;
        const std::uint32_t free = first_of_sixteen(list, VertexIndex::none());
        if (free < in_bucket) {
            list[free] = high;
            return before + free;
        }
    }
    const auto count = buckets.hub_counts.try_emplace(low.value(), searched).first;
    const auto [edge, is_new] = hub_edges_.try_emplace(key(low, high), count->second);
    if (is_new) ++count->second;
    return edge->second;
}

/// Numbers the edges star by star.
void EdgeNumbering::compact(const Buckets& buckets) {
    begin_.reserve(buckets.vertex_count + 1);
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < buckets.vertex_count; ++v) {
        begin_.push_back(static_cast<std::uint32_t>(count));
        count += buckets.count_at(v);
    }
    if (count >= EdgeIndex::limit - searched) {
        throw std::length_error(
            fmt::format("one process has {} edges, more than 32 bits number: "
                        "use more processes",
                        count));
    }
    begin_.push_back(static_cast<std::uint32_t>(count));

    // Buckets are copied completely: elements after the last edge are overwritten by the next star.
    high_end_.resize(count + read_beyond);
    for (std::uint32_t v = 0; v < buckets.vertex_count; ++v) {
        auto to = high_end_.begin() + begin_[v];
        std::uint32_t bucket = v;
        do {
            to = std::ranges::copy(buckets.of[bucket], to).out;
            bucket = buckets.after(bucket);
        } while (bucket != 0);
    }
    for (const auto& [key, place] : hub_edges_) {
        high_end_[begin_[key >> 32U] + place] = VertexIndex{key & VertexIndex::none_value};
    }
}

}  // namespace octetra::distributed
