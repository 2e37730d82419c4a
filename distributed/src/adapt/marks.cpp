#include "adapt/marks.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/vertex_buckets.hpp>

namespace octetra::distributed {
namespace {

/// Size of blocks that are skipped if no byte is set: long enough for vector instructions.
constexpr std::size_t block_size = 256;
constexpr std::size_t word_size = sizeof(std::uint64_t);

std::uint64_t word_at(const std::uint8_t* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, word_size);
    return word;
}

bool is_any_set(const std::uint8_t* block) {
    std::uint64_t any = 0;
    for (std::size_t k = 0; k < block_size; k += word_size) any |= word_at(block + k);
    return any != 0;
}

void append_marked(MarkedCells& marked, std::span<const std::uint8_t> marks, std::size_t begin,
                   std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
        if (marks[k] != 0) marked.cells.push_back(CellIndex{k});
    }
}

void append_marked_of_block(MarkedCells& marked, std::span<const std::uint8_t> marks,
                            std::size_t begin) {
    for (std::size_t k = begin; k < begin + block_size; k += word_size) {
        if (word_at(&marks[k]) != 0) append_marked(marked, marks, k, k + word_size);
    }
}

}  // namespace

MarkedCells marked_by_bytes(const DistributedMesh& mesh, std::span<const std::uint8_t> marks) {
    if (marks.size() != mesh.cells.size()) {
        throw InputError(fmt::format("rank {}: {} marks for {} cells", mesh.processes.rank(),
                                     marks.size(), mesh.cells.size()));
    }
    MarkedCells marked;
    // Performance matters if few cells are marked: most blocks, and most words of others, are
    // empty.
    const std::size_t whole_blocks = marks.size() / block_size * block_size;
    for (std::size_t begin = 0; begin < whole_blocks; begin += block_size) {
        if (is_any_set(&marks[begin])) append_marked_of_block(marked, marks, begin);
    }
    append_marked(marked, marks, whole_blocks, marks.size());
    marked.count = marked.cells.size();
    marked.tested = marks.size();
    return marked;
}

MarkedCells marked_by_list(const DistributedMesh& mesh, std::span<const CellIndex> listed) {
    MarkedCells marked;
    marked.cells.assign(listed.begin(), listed.end());
    std::ranges::sort(marked.cells);
    marked.cells.erase(std::unique(marked.cells.begin(), marked.cells.end()), marked.cells.end());
    if (!marked.cells.empty() && marked.cells.back() >= mesh.cells.end_index()) {
        throw InputError(fmt::format("rank {}: cell {} is marked, but there are only {} cells",
                                     mesh.processes.rank(), marked.cells.back().value(),
                                     mesh.cells.size()));
    }
    marked.count = marked.cells.size();
    marked.tested = listed.size();
    return marked;
}

MarkedCells cells_with_marked_edges(const DistributedMesh& mesh,
                                    std::span<const EdgeVertices> marked) {
    MarkedCells cells;
    if (marked.empty()) return cells;
    IndexVector<EdgeIndex, EdgeVertices> edges;
    for (const auto& [a, b] : marked) {
        if (std::max(a, b) >= mesh.points.end_index()) {
            throw InputError(
                fmt::format("rank {}: edge {} {} is marked, but there are only {} vertices",
                            mesh.processes.rank(), a.value(), b.value(), mesh.points.size()));
        }
        edges.push_back({a, b});
    }
    const VertexBuckets<EdgeIndex, 2> buckets(edges, mesh.points.size());
    IndexVector<EdgeIndex, std::uint8_t> met(edges.size(), 0);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        unsigned mask = 0;
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [i, j] = cell_edges[e];
            buckets.find({mesh.cells[c][i], mesh.cells[c][j]}, [&](EdgeIndex edge) {
                if (met[edge] == 0) mask |= 1U << e;
                met[edge] = 1;
            });
        }
        if (mask == 0) continue;
        cells.cells.push_back(c);
        cells.edges.push_back(static_cast<EdgeMask>(mask));
    }
    const auto missing = std::ranges::find(met, std::uint8_t{0});
    if (missing != met.end()) {
        const auto& [a, b] = marked[static_cast<std::size_t>(missing - met.begin())];
        throw InputError(fmt::format("rank {}: edge {} {} is marked, but no cell has it",
                                     mesh.processes.rank(), a.value(), b.value()));
    }
    cells.count = cells.cells.size();
    cells.tested = mesh.cells.size();
    return cells;
}

}  // namespace octetra::distributed
