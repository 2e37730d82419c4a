#include "adapt/cell_numbers.hpp"

#include <algorithm>
#include <cstddef>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/canonical_mesh.hpp>

namespace octetra::cli {
namespace {

/// The vertices of a cell by their numbers in the whole mesh, ascending. Unique for each cell.
using CellKey = VertexNumbers<4>;

CellKey key_of(CellKey vertices) {
    std::ranges::sort(vertices);
    return vertices;
}

struct NumberedCell {
    CellKey key;
    std::uint64_t number;
};

/// Returns the rendezvous rank of a cell.
std::size_t rendezvous_rank(const CellKey& key, std::size_t ranks) {
    return static_cast<std::size_t>((key[0] + key[1] + key[2] + key[3]) % ranks);
}

/// Collective. Sends all cells with their numbers to their rendezvous ranks; returns those
/// received, sorted by key.
std::vector<NumberedCell> numbered_cells(const distributed::AdaptiveMesh& mesh) {
    const distributed::Communicator& world = mesh.processes();
    const auto ranks = static_cast<std::size_t>(world.size());
    distributed::CanonicalMesh canonical = mesh.canonical();
    const std::uint64_t count = canonical.facts().cells;
    const Window window{0, (count + ranks - 1) / ranks, count};
    std::vector<std::vector<NumberedCell>> outboxes(ranks);
    std::uint64_t number = window.begin_of(world.rank());
    for (const VertexNumbers<4>& cell : canonical.whole().cells(window)) {
        const CellKey key = key_of(cell);
        outboxes[rendezvous_rank(key, ranks)].push_back({key, number++});
    }
    std::vector<NumberedCell> all;
    for (const auto& inbox : world.all_to_all(outboxes)) {
        all.insert(all.end(), inbox.begin(), inbox.end());
    }
    std::ranges::sort(all, {}, &NumberedCell::key);
    return all;
}

}  // namespace

std::vector<std::uint64_t> cell_numbers(const distributed::AdaptiveMesh& mesh) {
    const distributed::Communicator& world = mesh.processes();
    const auto ranks = static_cast<std::size_t>(world.size());
    const auto numbers = mesh.vertex_numbers();
    std::vector<std::vector<CellKey>> requests(ranks);
    std::vector<std::size_t> requested_ranks;
    requested_ranks.reserve(mesh.cells().size());
    for (const CellVertices& cell : mesh.cells()) {
        CellKey key;
        for (std::size_t k = 0; k < 4; ++k) {
            key[k] = static_cast<std::uint64_t>(numbers[cell[k].value()]);
        }
        key = key_of(key);
        requested_ranks.push_back(rendezvous_rank(key, ranks));
        requests[requested_ranks.back()].push_back(key);
    }
    const std::vector<NumberedCell> known = numbered_cells(mesh);
    std::vector<std::vector<std::uint64_t>> answers(ranks);
    const auto received_requests = world.all_to_all(requests);
    for (std::size_t rank = 0; rank < ranks; ++rank) {
        for (const CellKey& key : received_requests[rank]) {
            answers[rank].push_back(
                std::ranges::lower_bound(known, key, {}, &NumberedCell::key)->number);
        }
    }
    const auto answered = world.all_to_all(answers);
    std::vector<std::size_t> next(ranks, 0);
    std::vector<std::uint64_t> of_cell;
    of_cell.reserve(requested_ranks.size());
    for (const std::size_t rank : requested_ranks) of_cell.push_back(answered[rank][next[rank]++]);
    return of_cell;
}

}  // namespace octetra::cli
