#include "level/synchronise.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include <octetra/distributed/profile.hpp>

namespace octetra::distributed {
namespace {

using Outboxes = std::vector<std::vector<std::uint32_t>>;

std::vector<int> neighbours_of(const DistributedMesh& mesh) {
    std::vector<int> ranks;
    for (const Interface& interface : mesh.interfaces) ranks.push_back(interface.rank);
    return ranks;
}

template <class T>
std::uint64_t count(const std::vector<std::vector<T>>& boxes) {
    std::uint64_t sum = 0;
    for (const auto& box : boxes) sum += box.size();
    return sum;
}

/// The local closure of the paper: all marks that follow without communication.
void close_locally(MarkedEdges& closure, const DistributedMesh& mesh) {
    const Phase phase(mesh.processes, "closure");
    closure.drain();
}

/// A mark sent through the gateway: the edge at a position of the list that two ranks share.
struct BorderSelection {
    std::int32_t from = 0;
    std::int32_t to = 0;
    std::uint32_t position = 0;
};

/// The gateway on the first process: passes each mark on once, unless the other rank has sent it
/// too.
class Gateway {
public:
    [[nodiscard]] std::vector<std::vector<BorderSelection>> route(
        const std::vector<std::vector<BorderSelection>>& from_each) {
        std::set<Key> marked_by_both;
        for (const auto& selections : from_each) {
            for (const BorderSelection& s : selections) {
                if (!known_.insert(key_of(s)).second) marked_by_both.insert(key_of(s));
            }
        }
        std::vector<std::vector<BorderSelection>> to_each(from_each.size());
        for (const auto& selections : from_each) {
            for (const BorderSelection& s : selections) {
                if (marked_by_both.contains(key_of(s))) continue;
                to_each[static_cast<std::size_t>(s.to)].push_back(s);
            }
        }
        return to_each;
    }

private:
    using Key = std::tuple<std::int32_t, std::int32_t, std::uint32_t>;
    static Key key_of(const BorderSelection& s) {
        return {std::min(s.from, s.to), std::max(s.from, s.to), s.position};
    }
    std::set<Key> known_;
};

std::vector<BorderSelection> addressed(const Outboxes& outboxes, const DistributedMesh& mesh) {
    std::vector<BorderSelection> selections;
    for (std::size_t i = 0; i < outboxes.size(); ++i) {
        for (const std::uint32_t position : outboxes[i]) {
            selections.push_back({mesh.processes.rank(), mesh.interfaces[i].rank, position});
        }
    }
    return selections;
}

}  // namespace

SynchronisationCounts synchronise_by_neighbours(MarkedEdges& closure, const DistributedMesh& mesh) {
    const Communicator& processes = mesh.processes;
    const std::vector<int> neighbours = neighbours_of(mesh);
    SynchronisationCounts counts;
    while (true) {
        close_locally(closure, mesh);
        const Outboxes outboxes = closure.take_outboxes();
        if (processes.max(count(outboxes)) == 0) return counts;
        note_round(processes);
        ++counts.rounds;
        counts.messages += neighbours.size();
        counts.edges += count(outboxes);
        counts.bytes += count(outboxes) * sizeof outboxes[0][0];
        const auto inboxes = processes.exchange_after_agreement(neighbours, outboxes);
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            for (const std::uint32_t position : inboxes[i]) closure.mark_from(i, position);
        }
    }
}

SynchronisationCounts synchronise_by_gateway(MarkedEdges& closure, const DistributedMesh& mesh) {
    const Communicator& processes = mesh.processes;
    const std::vector<int> neighbours = neighbours_of(mesh);
    Gateway gateway;
    SynchronisationCounts counts;
    while (true) {
        close_locally(closure, mesh);
        const std::vector<BorderSelection> selections = addressed(closure.take_outboxes(), mesh);
        if (processes.max(selections.size()) == 0) return counts;
        note_round(processes);
        ++counts.rounds;
        const auto from_each = processes.gather(selections);
        std::vector<std::vector<BorderSelection>> to_each;
        std::uint64_t edges = selections.size();
        if (processes.is_first()) {
            // Marks from the gateway to itself are not messages.
            to_each = gateway.route(from_each);
            edges = count(to_each) - to_each.front().size();
        }
        counts.messages +=
            processes.is_first() ? static_cast<std::uint64_t>(processes.size()) - 1 : 1;
        counts.edges += edges;
        counts.bytes += edges * sizeof(BorderSelection);
        for (const BorderSelection& s : processes.scatter(to_each)) {
            const auto sender = std::ranges::lower_bound(neighbours, s.from);
            closure.mark_from(static_cast<std::size_t>(sender - neighbours.begin()), s.position);
        }
    }
}

}  // namespace octetra::distributed
