#include "setup/distribute_share.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include <octetra/core/orientation.hpp>
#include <octetra/core/positive_filter.hpp>
#include <octetra/core/repeated_cells.hpp>
#include <octetra/distributed/profile.hpp>

#include "assemble/ancestors_of_roots.hpp"
#include "partition/cell_weights.hpp"
#include "partition/rcb.hpp"
#include "setup/find_interfaces.hpp"
#include "setup/owners.hpp"
#include "setup/part_vertices.hpp"
#include "setup/send_cells.hpp"
#include "setup/share_corners.hpp"
#include "setup/tagged_sides.hpp"
#include "sharing/sharers.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {
namespace {

/// Computes the centroids of cells. Each cell is checked for positive orientation when its corners
/// are first accessed, because points are scattered in memory.
class CellCentroids {
public:
    explicit CellCentroids(const ShareCorners& corners) : corners_(&corners) {
        filter_.add(corners.points());
    }

    /// Writes the centroids of the cells from `first` on. The first pass over all cells must be in
    /// order.
    void write(std::size_t first, std::span<Point> centroids) {
        for (std::size_t k = 0; k < centroids.size(); ++k) {
            corners_->prefetch(first + k + 16);
            const Corners at = corners_->of(first + k);
            centroids[k] = centroid_of(at);
            if (first + k != checked_count_ || !are_positive_) continue;
            ++checked_count_;
            are_positive_ = filter_.is_surely_positive(at[0], at[1], at[2], at[3]) ||
                            orientation(at[0], at[1], at[2], at[3]) > 0;
        }
    }
    /// Returns whether the first `cells` cells are all positive; checks those not yet visited.
    [[nodiscard]] bool are_positive(std::size_t cells) {
        while (checked_count_ < cells && are_positive_) {
            Point place;
            write(checked_count_, std::span(&place, 1));
        }
        return are_positive_;
    }

private:
    const ShareCorners* corners_;
    PositiveFilter filter_;
    std::size_t checked_count_ = 0;
    bool are_positive_ = true;
};

using Weigh = std::function<std::vector<float>(const CellsToWeigh&)>;

/// The weights that bisect_coordinates() applies to cells.
struct Weights {
    std::vector<float> of_cells;  // of this process's share; empty if all cells weigh the same
    float least = 1;              // over all processes
};

/// Collective. Computes and checks the weights.
Weights weights_of(const Communicator& processes, const MeshShare& share,
                   const ShareCorners& corners, const Weigh& weigh) {
    if (!weigh) return {};
    const std::size_t count = share.lists.cells.size();
    std::vector<float> weights = weigh({.processes = processes,
                                        .first_number = share.first_cell,
                                        .cells = corners.cells(),
                                        .points = corners.points(),
                                        .regions = share.lists.regions});
    if (processes.max(weights.empty() ? 0 : 1) == 0) return {};
    constexpr std::uint64_t complement = 0xffff'ffff;
    // compared by bit pattern, which orders positive numbers correctly
    std::uint64_t least = complement;
    check_weights(count, weights);
    for (const float weight : weights) {
        least = std::min<std::uint64_t>(least, std::bit_cast<std::uint32_t>(weight));
    }
    least = complement - processes.max(complement - least);
    return {std::move(weights), std::bit_cast<float>(static_cast<std::uint32_t>(least))};
}

/// Returns parts that are blocks of cell numbers of nearly equal size.
std::vector<int> parts_by_number(const Communicator& processes, const MeshShare& share) {
    std::vector<int> parts(share.lists.cells.size());
    const auto size = static_cast<std::uint64_t>(processes.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i] = static_cast<int>((share.first_cell + i) * size / share.facts.cells);
    }
    return parts;
}

/// Returns whether two cells, with local vertex indices, have the same vertices.
bool has_repeated_cell(const IndexVector<CellIndex, CellVertices>& cells,
                       std::size_t vertex_count) {
    RepeatedCells repeated(cells.size());
    for (const CellVertices& cell : cells) repeated.add(cell);
    return !repeated.find(cells, vertex_count).cell.is_none();
}

/// Collective. Returns whether another process has a cell with the same vertices as a cell of this
/// process. Only cells whose vertices are all shared are candidates.
bool shares_cell_with_others(const DistributedMesh& mesh, const VerticesOfPart& vertices) {
    std::vector<std::array<std::uint64_t, 4>> keys;
    const auto is_shared = [&](VertexIndex v) { return vertices.is_shared[v.value()] == 1; };
    for (const CellVertices& cell : mesh.cells) {
        if (!std::ranges::all_of(cell, is_shared)) continue;
        auto& key = keys.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            key[k] = static_cast<std::uint64_t>(mesh.input_vertices[cell[k].value()]);
        }
        std::ranges::sort(key);
    }
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return !find_sharers(mesh.processes, keys).empty();
}

/// Assembles a distributed mesh from the shares that processes have read, step by step.
class Assembly {
public:
    Assembly(const Communicator& processes, MeshShare share)
        : processes_(processes), share_(std::move(share)) {
        mesh_.processes = processes;
        mesh_.index_base = share_.facts.index_base;
        mesh_.group_names = share_.facts.group_names;
        if (has_any(share_.facts.features)) {
            mesh_.features = std::make_shared<const FeatureLists>(std::move(share_.lists.features));
        }
        mesh_.input_vertex_count = share_.facts.vertices;
        mesh_.input_cell_count = share_.facts.cells;
    }

    /// Collective. Partitions the cells and sends them to their parts.
    void send_cells_to_parts(const OwnerMap& owners, PartitionMethod method, const Weigh& weigh) {
        std::optional<ShareCorners> corners;
        std::vector<int> parts;
        in_phase(processes_, "partition", [&] {
            corners.emplace(processes_, owners, share_);
            parts = find_parts(*corners, method, weigh);
            corners->forget_points();
        });
        const Phase phase(processes_, "distribute");
        CellsOfPart part = send_cells(processes_, share_, *corners, parts);
        mesh_.cells = std::move(part.cells);
        mesh_.cell_ancestors = ancestors_of_roots(std::move(part.numbers), std::move(part.regions));
    }

    /// Collective. Fetches the vertices of the cells, and the facets and edges at these vertices.
    void distribute_vertices_and_tagged(const OwnerMap& owners) {
        const Phase phase(processes_, "distribute");
        VerticesOfPart vertices = find_vertices(processes_, owners, share_, mesh_.cells);
        fetch_vertices(processes_, vertices, share_, mesh_);
        for (CellVertices& cell : mesh_.cells) {
            for (VertexIndex& v : cell) v = vertices.set.local_of(v);
        }
        Mesh& lists = share_.lists;
        lists.points = {};
        lists.point_attributes = {};
        distribute_tagged(owners, vertices, lists.facets, lists.facet_markers, share_.first_facet,
                          share_.facts.facets, share_.facts.has_facet_markers, cell_faces,
                          mesh_.facets, mesh_.facet_ancestors);
        distribute_tagged(owners, vertices, lists.edges, lists.edge_markers, share_.first_edge,
                          share_.facts.edges, share_.facts.has_edge_markers, cell_edges,
                          mesh_.edges, mesh_.edge_ancestors);
        is_sound_ = is_sound_ && !has_repeated_cell(mesh_.cells, mesh_.points.size());
        if (shares_cell_with_others(mesh_, vertices)) is_sound_ = false;
        is_shared_ = std::move(vertices.is_shared);
    }

    /// Collective. Returns the mesh, or nothing on all processes if one has found an error.
    [[nodiscard]] std::optional<DistributedMesh> finish() && {
        const Phase phase(processes_, "interfaces");
        if (processes_.max(is_sound_ ? 0 : 1) == 1) return std::nullopt;
        mesh_.interfaces = find_interfaces(mesh_, find_vertex_sharing(mesh_, is_shared_));
        return std::move(mesh_);
    }

    [[nodiscard]] OwnerMap owners() {
        return owners_of_shares(processes_, share_.first_vertex, share_.facts.vertices);
    }

private:
    /// Collective. Returns the parts of this process's cells; checks that all are positive.
    [[nodiscard]] std::vector<int> find_parts(ShareCorners& corners, PartitionMethod method,
                                              const Weigh& weigh) {
        CellCentroids centroids(corners);
        std::vector<int> parts;
        if (method == PartitionMethod::rcb) {
            const Weights weights = weights_of(processes_, share_, corners, weigh);
            WeighedPoints points{
                .count = share_.lists.cells.size(),
                .points = [&](std::size_t first,
                              std::span<Point> some) { centroids.write(first, some); },
                .number = [&](std::size_t i) { return share_.first_cell + i; },
                .weight = {}};
            if (!weights.of_cells.empty()) {
                points.weight = [&](std::size_t i) {
                    return integer_weight(weights.of_cells[i], weights.least);
                };
            }
            parts = bisect_coordinates(processes_, points, processes_.size());
        } else {
            parts = parts_by_number(processes_, share_);
        }
        is_sound_ = is_sound_ && centroids.are_positive(share_.lists.cells.size());
        return parts;
    }

    template <class I, std::size_t N, std::size_t Sides>
    void distribute_tagged(const OwnerMap& owners, const VerticesOfPart& vertices,
                           const IndexVector<I, std::array<VertexIndex, N>>& read,
                           const IndexVector<I, Marker>& markers, std::uint64_t first,
                           std::uint64_t count, bool has_markers,
                           const std::array<std::array<std::uint8_t, N>, Sides>& sides,
                           IndexVector<I, std::array<VertexIndex, N>>& list,
                           AncestorMap& ancestors) {
        if (count == 0) return;
        TaggedSides<I, N> tagged(processes_, vertices);
        if (!tagged.collect(owners, read, markers, first)) is_sound_ = false;
        if (!tagged.find_cells(mesh_.cells, sides)) is_sound_ = false;
        tagged.take(has_markers, list, ancestors);
    }

    Communicator processes_;
    MeshShare share_;
    bool is_sound_ = true;  // as far as this process has checked
    std::vector<std::uint8_t> is_shared_;
    DistributedMesh mesh_;
};

}  // namespace

std::optional<DistributedMesh> distribute_share(const Communicator& processes, MeshShare share,
                                                PartitionMethod method, const Weigh& weigh) {
    Assembly assembly(processes, std::move(share));
    const OwnerMap owners = in_phase(processes, "distribute", [&] { return assembly.owners(); });
    assembly.send_cells_to_parts(owners, method, weigh);
    assembly.distribute_vertices_and_tagged(owners);
    return std::move(assembly).finish();
}

}  // namespace octetra::distributed
