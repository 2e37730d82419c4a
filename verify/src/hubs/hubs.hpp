#pragma once

#include <vector>

#include "lookup/edge_table.hpp"
#include "mesh/judged_mesh.hpp"

namespace octetra::verify {

/// What a fan of entities has in common: a vertex, or an edge.
struct Apex {
    VertexIndex a = VertexIndex::none();
    VertexIndex b = VertexIndex::none();  ///< none() of a vertex

    [[nodiscard]] bool is_none() const { return a.is_none(); }
    [[nodiscard]] bool is_edge() const { return !b.is_none(); }
    [[nodiscard]] bool has(VertexIndex v) const { return v == a || v == b; }
    friend constexpr auto operator<=>(const Apex&, const Apex&) = default;
};

/// Vertices and edges with so many cells that not all pairs of these can be looked at.
class Hubs {
public:
    explicit Hubs(const JudgedMesh& judged);

    [[nodiscard]] bool none() const { return hubs_ == 0; }

    /// What an edge, face or cell is sorted under: the hub that it has, none if it has none. Of
    /// several, edges go before vertices, as what they have in common is more, and then the one
    /// with the most entities.
    template <std::size_t N>
    [[nodiscard]] Apex apex_of(const std::array<VertexIndex, N>& entity) const {
        if (none()) return {};
        Apex best;
        std::uint32_t most = 0;
        for (const VertexIndex v : entity) {
            if (is_hub(v) && degree_[v.value()] > most) {
                best = {v, VertexIndex::none()};
                most = degree_[v.value()];
            }
        }
        if (N == 2 || best.is_none()) return best;
        most = 0;
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                const std::uint32_t cells = cells_around(entity[i], entity[k]);
                if (cells <= many_ || cells <= most) continue;
                best = {std::min(entity[i], entity[k]), std::max(entity[i], entity[k])};
                most = cells;
            }
        }
        return best;
    }

private:
    [[nodiscard]] bool is_hub(VertexIndex v) const { return degree_[v.value()] > many_; }
    [[nodiscard]] std::uint32_t cells_around(VertexIndex v, VertexIndex w) const {
        if (!is_hub(v) || !is_hub(w)) return 0;
        const std::uint32_t cells = cells_around_.find(v, w);
        return cells == EdgeTable::absent ? 0 : cells;
    }

    std::uint32_t many_;
    std::vector<std::uint32_t> degree_;  ///< of each vertex: how many edges it has
    std::size_t hubs_ = 0;
    EdgeTable cells_around_;  ///< edges that join hubs
};

}  // namespace octetra::verify
