#include <algorithm>
#include <set>

#include <octetra/distributed/partition.hpp>

#include "cell_graph.hpp"

namespace octetra::distributed {
namespace {

struct Cut {
    std::uint64_t links = 0;
    std::uint64_t cut_links = 0;
};

Cut cut_of(const CellGraph& graph, const std::vector<int>& cell_to_part) {
    Cut cut;
    for (std::size_t c = 0; c < cell_to_part.size(); ++c) {
        for (auto k = graph.begin[c]; k < graph.begin[c + 1]; ++k) {
            const auto neighbour =
                static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(k)]);
            if (neighbour < c) continue;  // each link once
            ++cut.links;
            if (cell_to_part[neighbour] != cell_to_part[c]) ++cut.cut_links;
        }
    }
    return cut;
}

/// The parts that have each vertex, as pairs, ascending.
std::vector<std::pair<VertexIndex, int>> parts_at_vertices(const Mesh& mesh,
                                                           const std::vector<int>& cell_to_part) {
    std::vector<std::pair<VertexIndex, int>> pairs;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const VertexIndex v : mesh.cells[c]) pairs.emplace_back(v, cell_to_part[c.value()]);
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace

PartitionStatistics measure_partition(const Mesh& mesh, const std::vector<int>& cell_to_part,
                                      int parts) {
    const auto count = static_cast<std::size_t>(parts);
    PartitionStatistics statistics{.cells_of_part = std::vector<std::uint64_t>(count),
                                   .shared_vertices_of_part = std::vector<std::uint64_t>(count),
                                   .neighbours_of_part = std::vector<std::uint64_t>(count)};
    for (const int part : cell_to_part) {
        ++statistics.cells_of_part[static_cast<std::size_t>(part)];
    }
    const Cut faces = cut_of(face_dual_graph(mesh), cell_to_part);
    statistics.inner_faces = faces.links;
    statistics.cut_faces = faces.cut_links;
    const Cut paths = cut_of(longest_edge_graph(mesh), cell_to_part);
    statistics.longest_edge_links = paths.links;
    statistics.cut_longest_edge_links = paths.cut_links;

    const auto pairs = parts_at_vertices(mesh, cell_to_part);
    std::vector<std::set<int>> neighbours(count);
    for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
        while (end < pairs.size() && pairs[end].first == pairs[begin].first) ++end;
        if (end - begin == 1) continue;
        for (std::size_t i = begin; i < end; ++i) {
            const auto part = static_cast<std::size_t>(pairs[i].second);
            ++statistics.shared_vertices_of_part[part];
            for (std::size_t j = begin; j < end; ++j) {
                if (j != i) neighbours[part].insert(pairs[j].second);
            }
        }
    }
    for (std::size_t p = 0; p < count; ++p) {
        statistics.neighbours_of_part[p] = neighbours[p].size();
    }
    return statistics;
}

}  // namespace octetra::distributed
