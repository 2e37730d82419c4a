#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/kept_vertices.hpp"
#include "coarsen/level_removals.hpp"
#include "history/families.hpp"

namespace octetra::distributed {

/// A list (of cells, tagged facets or edges) after the removal of vertices, in canonical order;
/// vertices have their previous numbers.
template <class I, std::size_t N>
struct CoarserList {
    IndexVector<I, std::array<VertexIndex, N>> list;
    std::vector<std::uint32_t> first;  ///< as in AncestorMap
    /// For each previous entity, the entity that it is or was merged into, and the number of
    /// bisections that separate it from that entity.
    std::vector<std::uint32_t> coarse_of;
    std::vector<std::uint8_t> halvings;
};

/// The children of a parent, in canonical order.
template <std::size_t N>
struct Pieces {
    std::size_t count = 0;
    std::array<std::array<VertexIndex, N>, 8> vertices;
};

/// The midpoints of a parent's edges that are kept, none() for other edges.
template <std::size_t N>
using KeptMidpoints = std::array<VertexIndex, N*(N - 1) / 2>;

/// Computes a CoarserList in one pass. A family with removed vertices is divided anew by the
/// remaining midpoints: members that are also children in the new division keep their position and
/// their descendants, and the others are merged into one of the new children.
template <class I, std::size_t N>
class ListCoarsening {
public:
    using Vertices = std::array<VertexIndex, N>;

    ListCoarsening(const VertexLevels& levels, const LevelRemovals& removals,
                   const KeptVertices& kept)
        : levels_(&levels), removals_(&removals), kept_(&kept), families_(levels) {}

    /// divide(level, root, parent, midpoints) returns the children of a parent; `root` is the
    /// position of its root among this process's roots.
    [[nodiscard]] CoarserList<I, N> run(const IndexVector<I, Vertices>& list, auto&& divide) {
        reserve_in_huge_pages(result_.coarse_of, list.size());
        reserve_in_huge_pages(result_.halvings, list.size());
        reserve_in_huge_pages(result_.list, list.size());
        const auto on_parent = [&](std::uint32_t level, const Vertices& parent,
                                   std::span<const Member> members) {
            return merge(level, parent, members, divide);
        };
        const auto on_root = [&](const Vertices&, const Note& note) {
            result_.first.push_back(note.begin);
        };
        const std::span<const Vertices> all = list;
        for (std::size_t i = 0; i < all.size();) {
            if (i + whole <= all.size()) {
                const auto next = all.subspan(i).template first<whole>();
                level_ = levels_->newest(next[0], level_);
                if (families_.are_family(next, level_) &&
                    add_uniform_family(next, on_parent, on_root)) {
                    i += whole;
                    continue;
                }
            }
            add(all[i++], on_parent, on_root);
        }
        result_.first.push_back(end());
        if (result_.list.size() < result_.list.capacity() / 2) result_.list.shrink_to_fit();
        return std::move(result_);
    }

private:
    /// The offsets of the descendants of an entity in the new list and in the old one.
    struct Note {
        std::uint32_t begin = 0;
        std::uint32_t begin_before = 0;
        bool has_removed_vertex = false;  ///< then it is an entity of the old list, not bisected
    };
    using Member = typename Families<N, Note>::Member;

    static constexpr unsigned whole = Families<N, Note>::whole;

    void add(const Vertices& vertices, auto&& on_parent, auto&& on_root) {
        const std::uint8_t removed = count_removed(vertices);
        const Note note{end(), end_before(), removed > 0};
        result_.coarse_of.push_back(note.begin);
        result_.halvings.push_back(removed);
        result_.list.push_back(vertices);
        families_.add(vertices, note, on_parent, on_root);
    }
    /// Adds a family of which all new vertices are kept, or none: the most frequent cases.
    [[nodiscard]] bool add_uniform_family(std::span<const Vertices, whole> family, auto&& on_parent,
                                          auto&& on_root) {
        const bool all_removed = removals_->all_removed(level_) || has_only(0, family);
        if (!all_removed && !removals_->all_kept(level_) && !has_only(1, family)) return false;
        const Note note{end(), end_before(), false};
        const Vertices parent = families_.parent_of(family);
        if (all_removed) {
            result_.coarse_of.insert(result_.coarse_of.end(), whole, note.begin);
            result_.list.push_back(parent);
        } else {
            for (unsigned k = 0; k < whole; ++k) result_.coarse_of.push_back(note.begin + k);
            result_.list.insert(result_.list.end(), family.begin(), family.end());
        }
        result_.halvings.insert(result_.halvings.end(), whole, all_removed ? N - 1 : 0);
        families_.add(parent, note, on_parent, on_root);
        return true;
    }
    /// Returns whether all new vertices of a family are kept (1), or all are removed (0).
    [[nodiscard]] bool has_only(std::uint8_t is_kept,
                                std::span<const Vertices, whole> family) const {
        const VertexIndex first_new = levels_->begin(level_);
        return std::ranges::all_of(family, [&](const Vertices& vertices) {
            return std::ranges::all_of(
                vertices, [&](VertexIndex v) { return v < first_new || (*kept_)[v] == is_kept; });
        });
    }

    [[nodiscard]] std::uint32_t end_before() const {
        return static_cast<std::uint32_t>(result_.coarse_of.size());
    }
    [[nodiscard]] std::uint32_t end() const { return result_.list.end_index().value(); }
    [[nodiscard]] std::uint8_t count_removed(const Vertices& vertices) const {
        unsigned removed = 0;
        for (const VertexIndex v : vertices) removed += 1U - (*kept_)[v];
        return static_cast<std::uint8_t>(removed);
    }

    Note merge(std::uint32_t level, const Vertices& parent, std::span<const Member> members,
               auto&& divide) {
        const Note note{members[0].note.begin, members[0].note.begin_before, false};
        if (std::ranges::none_of(members,
                                 [](const Member& m) { return m.note.has_removed_vertex; })) {
            return note;
        }
        const auto midpoints = kept_midpoints(level, parent, members);
        Pieces<N> pieces{1, {parent}};
        if (std::ranges::any_of(midpoints, [](VertexIndex v) { return !v.is_none(); })) {
            pieces = divide(level, result_.first.size(), parent, midpoints);
        }
        family_.clear();
        for (std::size_t k = 0; k < pieces.count; ++k) {
            append_child(pieces.vertices[k], parent, members);
        }
        result_.list.resize(note.begin);
        result_.list.insert(result_.list.end(), family_.begin(), family_.end());
        return note;
    }

    [[nodiscard]] KeptMidpoints<N> kept_midpoints(std::uint32_t level, const Vertices& parent,
                                                  std::span<const Member> members) const {
        KeptMidpoints<N> midpoints;
        const VertexIndex first_new = levels_->begin(level);
        for (const Member& member : members) {
            for (const VertexIndex v : member.vertices) {
                if (v < first_new || (*kept_)[v] == 0) continue;
                midpoints[edge_between(parent, levels_->ends(v))] = v;
            }
        }
        return midpoints;
    }

    /// Appends to the new list of the family all members that a child is, or that are merged into
    /// it.
    void append_child(const Vertices& piece, const Vertices& parent,
                      std::span<const Member> members) {
        const auto begin = static_cast<std::uint32_t>(members[0].note.begin + family_.size());
        bool is_made = false;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const auto& [vertices, note] = members[k];
            if (!note.has_removed_vertex) {
                if (vertices == piece) move(members, k, begin);
                continue;
            }
            if (without_removed(vertices, parent) != piece) continue;
            result_.coarse_of[note.begin_before] = begin;
            is_made = true;
        }
        if (is_made) family_.push_back(piece);
    }
    /// Moves the descendants of a member that is kept.
    void move(std::span<const Member> members, std::size_t k, std::uint32_t begin) {
        const auto& note = members[k].note;
        const bool is_last = k + 1 == members.size();
        const std::uint32_t note_end = is_last ? end() : members[k + 1].note.begin;
        const std::uint32_t before_end = is_last ? end_before() : members[k + 1].note.begin_before;
        family_.insert(family_.end(), result_.list.begin() + note.begin,
                       result_.list.begin() + note_end);
        if (begin == note.begin) return;
        for (std::size_t i = note.begin_before; i < before_end; ++i) {
            result_.coarse_of[i] += begin - note.begin;  // may be negative, modulo 2^32
        }
    }
    /// A child has a midpoint at the position of an end of its edge. If the midpoint is removed,
    /// the end replaces it.
    [[nodiscard]] Vertices without_removed(Vertices vertices, const Vertices& parent) const {
        for (std::size_t k = 0; k < N; ++k) {
            if ((*kept_)[vertices[k]] == 0) vertices[k] = parent[k];
        }
        return vertices;
    }

    const VertexLevels* levels_;
    const LevelRemovals* removals_;
    const KeptVertices* kept_;
    std::uint32_t level_ = 0;  ///< of the next list entry, a good guess for the entry after it
    Families<N, Note> families_;
    CoarserList<I, N> result_;
    IndexVector<I, Vertices> family_;  ///< the new list of one family
};

}  // namespace octetra::distributed
