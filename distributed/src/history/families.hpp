#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "history/vertex_levels.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// Reconstructs the history from a list in canonical order, of cells, tagged facets or edges (N
/// vertices each). Siblings are contiguous there apart from descendants of other siblings, so one
/// pass over the list finds all families, each after those of its members, up to the roots.
///
/// A child has one new vertex for each bisection of its parent that produced it, so its fraction of
/// the parent follows from its vertices alone; a family is complete when the fractions sum to the
/// whole. Entries between two members of a family are descendants of another member.
template <std::size_t N, class Note>
class Families {
public:
    using Vertices = std::array<VertexIndex, N>;

    /// A member of a family, or a root.
    struct Member {
        Vertices vertices;
        Note note;
    };

    /// `levels` must outlive this object.
    explicit Families(const VertexLevels& levels) : levels_(&levels) {}

    /// Processes the next entity of the list. Calls on_parent(level, parent, members) for each
    /// family that it completes; the result is the parent's note, `level` is the level that divided
    /// the parent, and the members are in canonical order. Calls on_root(root, note) when a root
    /// is complete.
    void add(const Vertices& vertices, Note note, auto&& on_parent, auto&& on_root) {
        Member next{vertices, note};
        for (std::uint32_t level = levels_->newest(next.vertices); level > 0;
             level = levels_->newest(next.vertices)) {
            if (open_.empty() || open_.back().level < level) {
                open_.push_back({level, 0, members_.size()});
            }
            const VertexIndex first_new = levels_->begin(level);
            Open& family = open_.back();
            family.shares += whole >> count_new(next.vertices, first_new);
            members_.push_back(next);
            if (family.shares < whole) return;
            const std::span<const Member> members = std::span(members_).subspan(family.begin);
            next.vertices = parent_of(members, first_new);
            next.note = on_parent(level, std::as_const(next.vertices), members);
            members_.resize(family.begin);
            open_.pop_back();
        }
        on_root(std::as_const(next.vertices), next.note);
    }

    /// The number of members of a family whose parent had all edges bisected.
    static constexpr unsigned whole = 1U << (N - 1);

    /// Returns whether the entities `next` are such a family, complete and contiguous. If so, the
    /// caller may add their parent in place of them, which is faster than adding each. `level` is
    /// the level that made the first one.
    [[nodiscard]] bool are_family(std::span<const Vertices, whole> next,
                                  std::uint32_t level) const {
        if (level == 0 || (!open_.empty() && open_.back().level == level)) return false;
        const VertexIndex first_new = levels_->begin(level);
        const VertexIndex end_new = levels_->end(level);
        bool are = true;
        for (const Vertices& vertices : next) {
            unsigned newer = 0;
            for (const VertexIndex v : vertices) newer += v >= end_new ? 1U : 0U;
            are = are && newer == 0 && count_new(vertices, first_new) == N - 1;
        }
        return are;
    }
    /// Returns the parent of such a family: at each position, the parent's corner has the lowest
    /// index.
    [[nodiscard]] static Vertices parent_of(std::span<const Vertices, whole> family) {
        Vertices parent = family[0];
        for (const Vertices& vertices : family) {
            for (std::size_t k = 0; k < N; ++k) parent[k] = std::min(parent[k], vertices[k]);
        }
        return parent;
    }

private:
    struct Open {
        std::uint32_t level;
        unsigned shares;
        std::size_t begin;  ///< index of its first member
    };

    static unsigned count_new(const Vertices& vertices, VertexIndex first_new) {
        unsigned count = 0;
        for (const VertexIndex v : vertices) count += v >= first_new ? 1U : 0U;
        return count;
    }
    /// A corner keeps its position in every child that has it, and each corner is in at least one
    /// child.
    static Vertices parent_of(std::span<const Member> members, VertexIndex first_new) {
        Vertices parent;
        for (const Member& member : members) {
            for (std::size_t k = 0; k < N; ++k) {
                if (member.vertices[k] < first_new) parent[k] = member.vertices[k];
            }
        }
        return parent;
    }

    const VertexLevels* levels_;
    std::vector<Open> open_;  ///< each nested in the one before
    std::vector<Member> members_;
};

/// Returns the local index of the edge with these ends in a cell, facet or tagged edge.
template <std::size_t N>
[[nodiscard]] std::size_t edge_between(const std::array<VertexIndex, N>& vertices,
                                       const EdgeVertices& ends) {
    const auto position = [&](VertexIndex v) {
        return static_cast<std::size_t>(std::ranges::find(vertices, v) - vertices.begin());
    };
    const auto [i, j] = std::minmax({position(ends[0]), position(ends[1])});
    return i * (2 * N - i - 1) / 2 + (j - i - 1);  // edges are in lexicographic order
}

}  // namespace octetra::distributed
