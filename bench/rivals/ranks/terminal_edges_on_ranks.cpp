#include "rivals/ranks/terminal_edges_on_ranks.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rivals/border.hpp"
#include "rivals/ranks/exchange.hpp"
#include "rivals/ranks/first_border.hpp"
#include "rivals/ranks/number_midpoints.hpp"
#include "rivals/refinement_state.hpp"

namespace octetra::rivals {
namespace {

/// A message about an edge shared by sender and receiver.
struct EdgeMessage {
    std::uint32_t code = 0;

    EdgeMessage() = default;
    EdgeMessage(std::uint32_t number, bool is_ready) : code(number << 1U | (is_ready ? 1U : 0U)) {}
    [[nodiscard]] std::uint32_t number() const { return code >> 1U; }
    [[nodiscard]] bool is_ready() const { return (code & 1U) != 0; }  // otherwise only wanted
};

using Messages = std::vector<std::vector<EdgeMessage>>;  // for each rank, or from it

/// The progress of one rank towards one goal.
class Rank {
public:
    Rank(const ProcessGroup& ranks, RefinementState& cutting, Border& border)
        : ranks_(&ranks), cutting_(&cutting), border_(&border) {}

    /// Applies received messages, and then does everything that needs no communication.
    void work(const Messages& received) {
        apply_messages(received);
        for (const SharedEdgeIndex e : std::exchange(agreed_, {})) {
            cutting_->bisect({.ends = ascending(border_->edge(e).ends), .cell = {}, .shared = e});
            ++traffic_.shared_edges_bisected;
        }
        border_->number_new();
        std::vector<WantedEdges::Edge> terminal;
        for (;;) {
            cutting_->wanted().take_terminal(terminal);
            if (terminal.empty()) return;
            for (const WantedEdges::Edge& edge : terminal) cutting_->bisect(edge);
        }
    }

    /// Readiness implies that the rank wants the edge, so one message suffices.
    Messages pending_messages() {
        Messages messages(static_cast<std::size_t>(ranks_->size()));
        std::vector<WantedEdges::Edge> ready;
        const auto asked = cutting_->wanted().take_asked();
        cutting_->wanted().take_ready(ready);
        std::vector<SharedEdgeIndex> now_ready;
        for (const WantedEdges::Edge& edge : ready) {
            traffic_.ready += tell(edge.shared, true, messages);
            now_ready.push_back(edge.shared);
        }
        std::ranges::sort(now_ready);
        for (const SharedEdgeIndex e : asked) {
            if (std::ranges::binary_search(now_ready, e)) continue;
            traffic_.asked += tell(e, false, messages);
        }
        for (const SharedEdgeIndex e : now_ready) add_ready_rank(e);
        for (const auto& to_rank : messages) {
            traffic_.messages += to_rank.empty() ? 0U : 1U;
            traffic_.bytes += to_rank.size() * sizeof(EdgeMessage);
        }
        return messages;
    }

    void count_round() { ++traffic_.rounds; }
    [[nodiscard]] const Traffic& traffic() const { return traffic_; }

private:
    std::size_t tell(SharedEdgeIndex e, bool is_ready, Messages& messages) {
        const auto& sharers = border_->edge(e).sharers;
        for (const auto& [n, number] : sharers) {
            const auto rank = static_cast<std::size_t>(border_->neighbours()[n]);
            messages[rank].emplace_back(number, is_ready);
        }
        return sharers.size();
    }

    void apply_messages(const Messages& received) {
        for (std::uint32_t n = 0; n < border_->neighbours().size(); ++n) {
            if (received.empty()) return;
            for (const EdgeMessage message :
                 received[static_cast<std::size_t>(border_->neighbours()[n])]) {
                const SharedEdgeIndex e = border_->edge_of({n, message.number()});
                cutting_->wanted().want_shared(e);
                if (message.is_ready()) add_ready_rank(e);
            }
        }
    }

    void add_ready_rank(SharedEdgeIndex e) {
        SharedEdge& edge = border_->edge(e);
        if (++edge.ready_ranks == edge.sharers.size() + 1) agreed_.push_back(e);
    }

    const ProcessGroup* ranks_;
    RefinementState* cutting_;
    Border* border_;
    std::vector<SharedEdgeIndex> agreed_;
    Traffic traffic_;
};

bool has_any(const Messages& messages) {
    return std::ranges::any_of(messages, [](const auto& of_rank) { return !of_rank.empty(); });
}

}  // namespace

struct TerminalEdgesOnRanks::State {
    State(const ProcessGroup& all, PartOfMesh of_rank, std::uint64_t count)
        : ranks(&all), part(std::move(of_rank)), vertex_count(count) {
        std::optional<CellGraph> graph;
        on_each(all, [&] { graph.emplace(part.mesh); });
        border.emplace(first_border(all, *graph, part.vertex_numbers));
        cutting.emplace(std::move(*graph), &*border);
    }

    const ProcessGroup* ranks;
    PartOfMesh part;
    std::uint64_t vertex_count;
    std::optional<Border> border;
    std::optional<RefinementState> cutting;
};

TerminalEdgesOnRanks::TerminalEdgesOnRanks(const ProcessGroup& ranks, PartOfMesh part,
                                           std::uint64_t vertex_count)
    : state_(std::make_unique<State>(ranks, std::move(part), vertex_count)) {}

TerminalEdgesOnRanks::~TerminalEdgesOnRanks() = default;

Traffic TerminalEdgesOnRanks::refine(const Goal& goal) {
    const ProcessGroup& ranks = *state_->ranks;
    RefinementState& cutting = *state_->cutting;
    Rank rank(ranks, cutting, *state_->border);
    Messages received;
    on_each(ranks, [&] {
        cutting.begin(goal, std::numeric_limits<std::size_t>::max());
        rank.work({});
    });
    for (;;) {
        const Messages messages = rank.pending_messages();
        if (ranks.sum(std::uint64_t{has_any(messages) ? 1U : 0U}) == 0) break;
        rank.count_round();
        received = all_to_all(ranks, messages);
        on_each(ranks, [&] { rank.work(received); });
    }
    if (cutting.wanted().count() > 0) throw std::logic_error("ranks wait for one another");
    return rank.traffic();
}

PartOfMesh TerminalEdgesOnRanks::result() const {
    const State& state = *state_;
    const CellGraph& graph = state.cutting->graph();
    PartOfMesh out;
    out.mesh.points = graph.points;
    out.mesh.index_base = state.part.mesh.index_base;
    out.vertex_numbers = state.part.vertex_numbers;
    number_midpoints(*state.ranks, state.vertex_count, state.cutting->midpoint_to_edge(),
                     out.vertex_numbers);
    CellIndex c = graph.cells.empty() ? CellIndex::none() : CellIndex{0};
    for (; !c.is_none(); c = graph.next[c]) {
        const CellIndex root = graph.cells[c].root;
        out.mesh.cells.push_back(graph.cells[c].vertices);
        out.roots.push_back(state.part.roots[root]);
        const auto& regions = state.part.mesh.regions;
        if (!regions.empty()) out.mesh.regions.push_back(regions[root]);
    }
    return out;
}

}  // namespace octetra::rivals
