#include "migrate/even_parts.hpp"

#include <algorithm>
#include <tuple>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/profile.hpp>

#include "history/steps_of.hpp"
#include "migrate/heavy_roots.hpp"
#include "partition/rcb.hpp"

namespace octetra::distributed {
namespace {

/// The weight of a part that a process has.
struct ShareOfPart {
    std::uint64_t weight = 0;
    int part = 0;
    int rank = 0;
};

/// Assigns one part to each process, in descending order of weights.
std::vector<int> matched(std::vector<ShareOfPart> shares, std::size_t process_count) {
    std::ranges::sort(shares, [](const ShareOfPart& a, const ShareOfPart& b) {
        return std::tie(b.weight, a.part, a.rank) < std::tie(a.weight, b.part, b.rank);
    });
    std::vector<int> rank_of_part(process_count, -1);
    std::vector<bool> has_part(process_count, false);
    const auto assign = [&](int part, int rank) {
        rank_of_part[static_cast<std::size_t>(part)] = rank;
        has_part[static_cast<std::size_t>(rank)] = true;
    };
    for (const ShareOfPart& share : shares) {
        const bool is_free = rank_of_part[static_cast<std::size_t>(share.part)] < 0;
        if (is_free && !has_part[static_cast<std::size_t>(share.rank)]) {
            assign(share.part, share.rank);
        }
    }
    for (std::size_t part = 0; part < process_count; ++part) {
        if (rank_of_part[part] >= 0) continue;
        const auto idle = std::ranges::find(has_part, false) - has_part.begin();
        assign(static_cast<int>(part), static_cast<int>(idle));
    }
    return rank_of_part;
}

/// Collective. Returns the load of each process after the move.
std::vector<std::uint64_t> loads_after(const Communicator& processes, std::span<const int> ranks,
                                       std::span<const std::uint64_t> weights) {
    std::vector<std::uint64_t> loads(static_cast<std::size_t>(processes.size()), 0);
    for (std::size_t r = 0; r < ranks.size(); ++r) {
        loads[static_cast<std::size_t>(ranks[r])] += weights[r];
    }
    processes.sum(std::span(loads));
    return loads;
}

}  // namespace

std::vector<int> ranks_of_parts(const Communicator& processes, std::span<const int> parts,
                                std::span<const std::uint64_t> weights) {
    std::vector<std::uint64_t> sums(static_cast<std::size_t>(processes.size()), 0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        sums[static_cast<std::size_t>(parts[i])] += weights[i];
    }
    std::vector<ShareOfPart> shares;
    for (std::size_t part = 0; part < sums.size(); ++part) {
        if (sums[part] == 0) continue;
        shares.push_back({sums[part], static_cast<int>(part), processes.rank()});
    }
    std::vector<ShareOfPart> all;
    for (const auto& of_one : processes.gather(shares)) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    std::vector<int> rank_of_part;
    if (processes.is_first()) rank_of_part = matched(std::move(all), sums.size());
    processes.broadcast(rank_of_part);
    return rank_of_part;
}

std::vector<std::uint64_t> cells_of_roots(const DistributedMesh& mesh) {
    const std::vector<std::uint32_t>& first = mesh.cell_ancestors.first;
    std::vector<std::uint64_t> counts;
    for (std::size_t r = 0; r + 1 < first.size(); ++r) counts.push_back(first[r + 1] - first[r]);
    return counts;
}

std::optional<EvenParts> even_parts(const DistributedMesh& mesh,
                                    std::span<const std::uint64_t> weights, double most_over_mean) {
    const Communicator& processes = mesh.processes;
    const Phase phase(processes, "find even parts");
    std::vector<WeighedPoint> centroids;
    std::uint64_t weight_here = 0;
    {
        const DistributedMesh input = input_of(mesh);
        const AncestorMap& roots = mesh.cell_ancestors;
        for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = input.points[input.cells[c][k]];
            const std::size_t r = c.value();
            weight_here += weights[r];
            centroids.push_back({centroid_of(corners), roots.roots[r], weights[r]});
        }
    }
    std::vector<int> ranks = bisect_coordinates(processes, centroids, processes.size());
    const std::vector<int> rank_of_part = ranks_of_parts(processes, ranks, weights);
    for (int& rank : ranks) rank = rank_of_part[static_cast<std::size_t>(rank)];
    std::vector<std::uint64_t> loads = loads_after(processes, ranks, weights);
    balance_heavy_roots(processes, weights, ranks, loads, most_over_mean);
    const std::uint64_t most = *std::ranges::max_element(loads);
    if (most >= processes.max(weight_here)) return std::nullopt;
    return EvenParts{std::move(ranks), most};
}

}  // namespace octetra::distributed
