#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// The entities (cells, facets, edges; N vertices each) at every vertex, in linked lists: an entity
/// is added to or removed from a vertex in constant time, however many are there. The caller stores
/// the vertices of the entities. N times the number of entities must fit in 32 bits.
///
/// Memory: 8 bytes per vertex, unless there are no entities, and 8 N per entity.
template <class I, std::size_t N>
class Incidence {
public:
    using Vertices = std::array<VertexIndex, N>;

    /// An empty index.
    Incidence() = default;
    Incidence(std::size_t vertex_count, const IndexVector<I, Vertices>& entities) {
        if (entities.empty()) return;  // and levels add none
        reserve_with_room(heads_, vertex_count);
        heads_.resize(vertex_count);
        reserve_with_room(links_, N * entities.size());
        links_.resize(N * entities.size());
        // In reverse, so that every list is ascending.
        for (std::size_t i = entities.size(); i-- > 0;) link_all(i, entities[I{i}]);
    }

    /// Added vertices have no entities; removed vertices must have none.
    void set_vertex_count(std::size_t count) {
        if (!heads_.empty()) heads_.resize(count);
    }
    /// Reserves capacity so that appending this many entities cannot fail.
    void make_room(std::size_t added) { octetra::make_room(links_, links_.size() + N * added); }
    void append(const Vertices& vertices) {
        const std::size_t i = links_.size() / N;
        links_.resize(links_.size() + N);
        link_all(i, vertices);
    }
    void replace(I i, const Vertices& before, const Vertices& after) {
        for (std::size_t k = 0; k < N; ++k) {
            if (before[k] == after[k]) continue;
            const auto place = static_cast<std::uint32_t>(N * i.value() + k);
            unlink(place, before[k]);
            link(place, after[k]);
        }
    }

    void remove(I i, const Vertices& vertices) {
        for (std::size_t k = 0; k < N; ++k) {
            unlink(static_cast<std::uint32_t>(N * i.value() + k), vertices[k]);
        }
    }
    /// Renumbers an entity to the number of a removed one.
    void move(I from, I to, const Vertices& vertices) {
        for (std::size_t k = 0; k < N; ++k) {
            const auto place = static_cast<std::uint32_t>(N * to.value() + k);
            const Link link = links_[N * from.value() + k];
            links_[place] = link;
            (link.previous == none ? heads_[vertices[k]].first : links_[link.previous].next) =
                place;
            if (link.next != none) links_[link.next].previous = place;
        }
    }
    /// Removes all entities from `count` on, which must have been removed or moved.
    void truncate(std::size_t count) {
        if (!heads_.empty()) links_.resize(N * count);
    }
    /// Renumbers vertices: `before` has the previous numbers of the remaining vertices, ascending;
    /// those before `first` are unchanged. Removed vertices must have no entities. Updates the
    /// vertices in `entities` too.
    void keep_vertices(std::span<const VertexIndex> before, VertexIndex first,
                       IndexVector<I, Vertices>& entities) {
        if (heads_.empty()) return;
        for (VertexIndex v = first; v < VertexIndex{before.size()}; ++v) {
            const Head head = heads_[before[v.value()]];
            heads_[v] = head;
            for (std::uint32_t at = head.first; at != none; at = links_[at].next) {
                entities[I{at / N}][at % N] = v;
            }
        }
        heads_.resize(before.size());
    }

    static constexpr std::uint32_t none = VertexIndex::none_value;
    struct Head {
        std::uint32_t first = none;
        std::uint32_t count = 0;
    };
    using Heads = IndexVector<VertexIndex, Head>;
    /// Returns the lists of entities by new numbers of all vertices, for set_heads().
    [[nodiscard]] Heads renumbered(const IndexVector<VertexIndex, VertexIndex>& after) const {
        Heads heads;
        if (heads_.empty()) return heads;
        reserve_with_room(heads, heads_.size());
        heads.resize(heads_.size());
        for (VertexIndex v{0}; v < heads_.end_index(); ++v) heads[after[v]] = heads_[v];
        return heads;
    }
    void set_heads(Heads&& heads) noexcept { heads_ = std::move(heads); }

    /// Calls visit(i) for each entity that has the vertex.
    void for_each_at(VertexIndex v, auto&& visit) const {
        if (heads_.empty()) return;
        for (std::uint32_t at = heads_[v].first; at != none; at = links_[at].next) {
            visit(I{at / N});
        }
    }
    /// Calls found(i, e) for each entity i that has the edge as its edge number e in the order of
    /// cell_edges or triangle_edges. `vertices_of(i)` returns the vertices of an entity.
    void for_each_with(const EdgeVertices& edge, auto&& vertices_of, auto&& found) const {
        if (heads_.empty()) return;
        auto [few, many] = edge;
        if (heads_[few].count > heads_[many].count) std::swap(few, many);  // one end may be a hub
        for (std::uint32_t at = heads_[few].first; at != none; at = links_[at].next) {
            const I i{at / N};
            const Vertices& vertices = vertices_of(i);
            const auto other = std::ranges::find(vertices, many);
            if (other == vertices.end()) continue;
            found(i, edge_between(at % N, static_cast<std::size_t>(other - vertices.begin())));
        }
    }

private:
    /// Element N i + k is for position k of entity i.
    struct Link {
        std::uint32_t previous = none;
        std::uint32_t next = none;
    };

    /// Edges are in lexicographic order of the positions of their ends.
    static std::size_t edge_between(std::size_t i, std::size_t j) {
        if (i > j) std::swap(i, j);
        return i * (2 * N - i - 1) / 2 + (j - i - 1);
    }
    void link_all(std::size_t i, const Vertices& vertices) {
        for (std::size_t k = 0; k < N; ++k) {
            link(static_cast<std::uint32_t>(N * i + k), vertices[k]);
        }
    }
    void link(std::uint32_t place, VertexIndex v) {
        Head& head = heads_[v];
        links_[place] = {none, head.first};
        if (head.first != none) links_[head.first].previous = place;
        head.first = place;
        ++head.count;
    }
    void unlink(std::uint32_t place, VertexIndex v) {
        const Link link = links_[place];
        Head& head = heads_[v];
        (link.previous == none ? head.first : links_[link.previous].next) = link.next;
        if (link.next != none) links_[link.next].previous = link.previous;
        --head.count;
    }

    Heads heads_;
    std::vector<Link> links_;
};

}  // namespace octetra::distributed
