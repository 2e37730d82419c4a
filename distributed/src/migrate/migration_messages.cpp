#include "migrate/migration_messages.hpp"

#include <algorithm>
#include <utility>

namespace octetra::distributed {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// Returns the processes that this one sends to or receives from, and this process.
std::vector<int> partners_of(const SideOfMove& before, const SideOfMove& after) {
    const Communicator& processes = before.mesh->processes;
    std::vector<bool> is_partner(static_cast<std::size_t>(processes.size()), false);
    is_partner[static_cast<std::size_t>(processes.rank())] = true;
    for (const int rank : before.rank_of_root) is_partner[static_cast<std::size_t>(rank)] = true;
    for (const int rank : after.rank_of_root) is_partner[static_cast<std::size_t>(rank)] = true;
    std::vector<int> ranks;
    for (int rank = 0; rank < processes.size(); ++rank) {
        if (is_partner[static_cast<std::size_t>(rank)]) ranks.push_back(rank);
    }
    return ranks;
}

/// One side of the messages to all partners.
class Side {
public:
    Side(const SideOfMove& side, const std::vector<int>& partners)
        : side_(&side), roots_(partners.size()), last_met_(side.mesh->points.size(), none) {
        for (std::size_t r = 0; r < side.rank_of_root.size(); ++r) {
            const auto p = std::ranges::lower_bound(partners, side.rank_of_root[r]);
            roots_[static_cast<std::size_t>(p - partners.begin())].push_back(
                static_cast<std::uint32_t>(r));
        }
    }

    [[nodiscard]] Numbers cells(std::size_t partner) const {
        Numbers cells;
        for_each_cell(partner, [&](CellIndex c) {
            cells.push_back(side_->unordered_cell_ids.empty()
                                ? c.value()
                                : side_->unordered_cell_ids[c.value()].value());
        });
        return cells;
    }
    /// Returns the vertices of these cells for which is_wanted() is true, ascending.
    [[nodiscard]] Numbers vertices(std::size_t partner, auto&& is_wanted) {
        Numbers vertices;
        const auto mark = static_cast<std::uint32_t>(partner);
        for_each_cell(partner, [&](CellIndex c) {
            for (const VertexIndex v : side_->mesh->cells[c]) {
                if (std::exchange(last_met_[v], mark) == mark) continue;
                if (is_wanted(v)) vertices.push_back(v.value());
            }
        });
        std::ranges::sort(vertices);
        return vertices;
    }

private:
    static constexpr std::uint32_t none = VertexIndex::none_value;

    void for_each_cell(std::size_t partner, auto&& visit) const {
        const std::vector<std::uint32_t>& first = side_->mesh->cell_ancestors.first;
        for (const std::uint32_t r : roots_[partner]) {
            for (CellIndex c{first[r]}; c < CellIndex{first[r + 1]}; ++c) visit(c);
        }
    }

    const SideOfMove* side_;
    std::vector<Numbers> roots_;                        ///< by partner
    IndexVector<VertexIndex, std::uint32_t> last_met_;  ///< the last partner that has the vertex
};

}  // namespace

MovedEntities moved_entities(const SideOfMove& before, const SideOfMove& after,
                             const Sharing<VertexIndex>& sharing, Migration::Message kept) {
    const Communicator& processes = before.mesh->processes;
    const std::vector<int> partners = partners_of(before, after);
    Side out(before, partners);
    Side in(after, partners);
    Migration::Entities cells{before.mesh->cells.size(), after.mesh->cells.size(), {}};
    Migration::Entities vertices{before.mesh->points.size(), after.mesh->points.size(), {}};
    IndexVector<VertexIndex, std::uint8_t> is_here;
    is_here.assign(after.mesh->points.size(), 0);
    IndexVector<VertexIndex, std::uint8_t> is_received = is_here;
    for (const std::uint32_t w : kept.received) is_here[VertexIndex{w}] = 1;
    for (std::size_t p = 0; p < partners.size(); ++p) {
        cells.messages.push_back({out.cells(p), in.cells(p)});
        if (partners[p] == processes.rank()) {
            vertices.messages.push_back(std::move(kept));
            continue;
        }
        const auto has_not = [&](VertexIndex v) {
            return std::ranges::find(sharing.sharers(v), partners[p]) == sharing.sharers(v).end();
        };
        Numbers sent = out.vertices(p, has_not);
        Numbers received = in.vertices(p, [&](VertexIndex w) { return is_here[w] == 0; });
        for (std::uint32_t& w : received) {
            if (std::exchange(is_received[VertexIndex{w}], 1) != 0) w = Migration::repeated;
        }
        vertices.messages.push_back({std::move(sent), std::move(received)});
    }
    return {partners, std::move(cells), std::move(vertices)};
}

}  // namespace octetra::distributed
