#include <algorithm>
#include <set>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/partition.hpp>

#include "partition/inner_faces.hpp"
#include "partition/longest_edges.hpp"
#include "partition/vertex_to_cells.hpp"

namespace octetra::distributed {
namespace {

/// Counts the cells of each part among those added.
class Tally {
public:
    explicit Tally(std::size_t parts) : counts_(parts, 0) {}

    void add(int part) {
        if (counts_[static_cast<std::size_t>(part)]++ == 0) parts_.push_back(part);
    }
    /// The parts with at least one cell.
    [[nodiscard]] const std::vector<int>& parts() const { return parts_; }
    [[nodiscard]] std::uint64_t count(int part) const {
        return counts_[static_cast<std::size_t>(part)];
    }
    void clear() {
        for (const int part : parts_) counts_[static_cast<std::size_t>(part)] = 0;
        parts_.clear();
    }

private:
    std::vector<std::uint64_t> counts_;
    std::vector<int> parts_;
};

class Measurement {
public:
    Measurement(const Mesh& mesh, const std::vector<int>& cell_to_part, int parts)
        : mesh_(&mesh),
          cell_to_part_(&cell_to_part),
          parts_(static_cast<std::size_t>(parts)),
          cells_at_vertices_(mesh) {}

    [[nodiscard]] PartitionStatistics result() const {
        PartitionStatistics statistics{
            .cells_of_part = std::vector<std::uint64_t>(parts_),
            .shared_vertices_of_part = std::vector<std::uint64_t>(parts_),
            .neighbours_of_part = std::vector<std::uint64_t>(parts_)};
        for (const int part : *cell_to_part_) {
            ++statistics.cells_of_part[static_cast<std::size_t>(part)];
        }
        count_faces(statistics);
        count_longest_edge_links(statistics);
        count_shared_vertices(statistics);
        return statistics;
    }

private:
    [[nodiscard]] int part_of(CellIndex c) const { return (*cell_to_part_)[c.value()]; }

    void count_faces(PartitionStatistics& statistics) const {
        for_each_inner_face(*mesh_, [&](const FacetVertices&, CellIndex a, CellIndex b) {
            ++statistics.inner_faces;
            if (part_of(a) != part_of(b)) ++statistics.cut_faces;
        });
    }

    /// Two cells are linked at an edge if it is the longest edge of either.
    void count_longest_edge_links(PartitionStatistics& statistics) const {
        const auto links = [](std::uint64_t longest, std::uint64_t all) {
            return longest * (all - longest) + longest * (longest - (longest > 0 ? 1 : 0)) / 2;
        };
        const LongestEdges longest_edges(*mesh_);
        Tally longest(parts_);
        Tally all(parts_);
        for (EdgeIndex e{0}; e < longest_edges.end_index(); ++e) {
            std::uint64_t cells = 0;
            for (const CellIndex c : longest_edges.cells_of(e)) longest.add(part_of(c));
            cells_at_vertices_.cells_at(longest_edges.ends(e), [&](CellIndex c) {
                all.add(part_of(c));
                ++cells;
            });
            const std::uint64_t at_edge = links(longest_edges.cells_of(e).size(), cells);
            std::uint64_t within_parts = 0;
            for (const int p : all.parts()) within_parts += links(longest.count(p), all.count(p));
            statistics.longest_edge_links += at_edge;
            statistics.cut_longest_edge_links += at_edge - within_parts;
            longest.clear();
            all.clear();
        }
    }

    void count_shared_vertices(PartitionStatistics& statistics) const {
        std::vector<std::set<int>> neighbours(parts_);
        Tally tally(parts_);
        for (VertexIndex v{0}; v < mesh_->points.end_index(); ++v) {
            for (const CellIndex c : cells_at_vertices_[v]) tally.add(part_of(c));
            if (tally.parts().size() > 1) {
                for (const int p : tally.parts()) {
                    const auto part = static_cast<std::size_t>(p);
                    ++statistics.shared_vertices_of_part[part];
                    neighbours[part].insert(tally.parts().begin(), tally.parts().end());
                }
            }
            tally.clear();
        }
        for (std::size_t p = 0; p < parts_; ++p) {
            const std::size_t with_itself = neighbours[p].size();
            statistics.neighbours_of_part[p] = with_itself - (with_itself > 0 ? 1 : 0);
        }
    }

    const Mesh* mesh_;
    const std::vector<int>* cell_to_part_;
    std::size_t parts_;
    VertexToCells cells_at_vertices_;
};

}  // namespace

PartitionStatistics measure_partition(const Mesh& mesh, const std::vector<int>& cell_to_part,
                                      int parts) {
    const StandardArithmetic standard;
    return Measurement(mesh, cell_to_part, parts).result();
}

}  // namespace octetra::distributed
