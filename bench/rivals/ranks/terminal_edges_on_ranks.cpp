#include "rivals/ranks/terminal_edges_on_ranks.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rivals/border.hpp"
#include "rivals/cutting.hpp"
#include "rivals/ranks/first_border.hpp"
#include "rivals/ranks/number_midpoints.hpp"
#include "rivals/ranks/tell.hpp"

namespace octetra::rivals {
namespace {

/// A message about an edge shared by sender and receiver.
struct Word {
    std::uint32_t code = 0;

    Word() = default;
    Word(std::uint32_t number, bool is_ready) : code(number << 1U | (is_ready ? 1U : 0U)) {}
    [[nodiscard]] std::uint32_t number() const { return code >> 1U; }
    [[nodiscard]] bool is_ready() const { return (code & 1U) != 0; }  // otherwise only wanted
};

using Words = std::vector<std::vector<Word>>;  // for each rank, or from it

/// The progress of one rank towards one goal.
class Rank {
public:
    Rank(const ProcessGroup& ranks, Cutting& cutting, Border& border)
        : ranks_(&ranks), cutting_(&cutting), border_(&border) {}

    /// Applies received messages, and then does everything that needs no communication.
    void work(const Words& told) {
        hear(told);
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
    Words speak() {
        Words words(static_cast<std::size_t>(ranks_->size()));
        std::vector<WantedEdges::Edge> ready;
        const auto asked = cutting_->wanted().take_asked();
        cutting_->wanted().take_ready(ready);
        std::vector<SharedEdgeIndex> now_ready;
        for (const WantedEdges::Edge& edge : ready) {
            traffic_.ready += tell(edge.shared, true, words);
            now_ready.push_back(edge.shared);
        }
        std::ranges::sort(now_ready);
        for (const SharedEdgeIndex e : asked) {
            if (std::ranges::binary_search(now_ready, e)) continue;
            traffic_.asked += tell(e, false, words);
        }
        for (const SharedEdgeIndex e : now_ready) one_more_is_ready(e);
        for (const auto& to_rank : words) {
            traffic_.messages += to_rank.empty() ? 0U : 1U;
            traffic_.bytes += to_rank.size() * sizeof(Word);
        }
        return words;
    }

    void count_round() { ++traffic_.rounds; }
    [[nodiscard]] const Traffic& traffic() const { return traffic_; }

private:
    std::size_t tell(SharedEdgeIndex e, bool is_ready, Words& words) {
        const auto& sharers = border_->edge(e).sharers;
        for (const auto& [n, number] : sharers) {
            const auto rank = static_cast<std::size_t>(border_->neighbours()[n]);
            words[rank].emplace_back(number, is_ready);
        }
        return sharers.size();
    }

    void hear(const Words& told) {
        for (std::uint32_t n = 0; n < border_->neighbours().size(); ++n) {
            if (told.empty()) return;
            for (const Word word : told[static_cast<std::size_t>(border_->neighbours()[n])]) {
                const SharedEdgeIndex e = border_->edge_of({n, word.number()});
                cutting_->wanted().want_shared(e);
                if (word.is_ready()) one_more_is_ready(e);
            }
        }
    }

    void one_more_is_ready(SharedEdgeIndex e) {
        SharedEdge& edge = border_->edge(e);
        if (++edge.ready_ranks == edge.sharers.size() + 1) agreed_.push_back(e);
    }

    const ProcessGroup* ranks_;
    Cutting* cutting_;
    Border* border_;
    std::vector<SharedEdgeIndex> agreed_;
    Traffic traffic_;
};

bool has_any(const Words& words) {
    return std::ranges::any_of(words, [](const auto& of_rank) { return !of_rank.empty(); });
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
    std::optional<Cutting> cutting;
};

TerminalEdgesOnRanks::TerminalEdgesOnRanks(const ProcessGroup& ranks, PartOfMesh part,
                                           std::uint64_t vertex_count)
    : state_(std::make_unique<State>(ranks, std::move(part), vertex_count)) {}

TerminalEdgesOnRanks::~TerminalEdgesOnRanks() = default;

Traffic TerminalEdgesOnRanks::refine(const Goal& goal) {
    const ProcessGroup& ranks = *state_->ranks;
    Cutting& cutting = *state_->cutting;
    Rank rank(ranks, cutting, *state_->border);
    Words told;
    on_each(ranks, [&] {
        cutting.begin(goal, std::numeric_limits<std::size_t>::max());
        rank.work({});
    });
    for (;;) {
        const Words words = rank.speak();
        if (ranks.sum(std::uint64_t{has_any(words) ? 1U : 0U}) == 0) break;
        rank.count_round();
        told = all_to_all(ranks, words);
        on_each(ranks, [&] { rank.work(told); });
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
