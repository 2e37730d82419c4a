#include "setup/distribute_stretch.hpp"

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

#include "comm/local_failure.hpp"
#include "partition/cell_weights.hpp"
#include "partition/rcb.hpp"
#include "setup/ancestors_of_roots.hpp"
#include "setup/find_interfaces.hpp"
#include "setup/homes.hpp"
#include "setup/part_vertices.hpp"
#include "setup/send_cells.hpp"
#include "setup/sharers.hpp"
#include "setup/stretch_corners.hpp"
#include "setup/tagged_sides.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {
namespace {

/// Computes the centroids of cells. Each cell is checked for positive orientation when its corners
/// are first accessed, because points are scattered in memory.
class CellPlaces {
public:
    explicit CellPlaces(const StretchCorners& corners) : corners_(&corners) {
        filter_.add(corners.points());
    }

    /// Writes the centroids of the cells from `first` on. The first pass over all cells must be in
    /// order.
    void write(std::size_t first, std::span<Point> places) {
        for (std::size_t k = 0; k < places.size(); ++k) {
            corners_->ask_for(first + k + 16);
            const Corners at = corners_->of(first + k);
            places[k] = place_of(at);
            if (first + k != judged_ || !are_positive_) continue;
            ++judged_;
            are_positive_ = filter_.is_surely_positive(at[0], at[1], at[2], at[3]) ||
                            orientation(at[0], at[1], at[2], at[3]) > 0;
        }
    }
    /// Returns whether the first `cells` cells are all positive; checks those not yet visited.
    [[nodiscard]] bool are_positive(std::size_t cells) {
        while (judged_ < cells && are_positive_) {
            Point place;
            write(judged_, std::span(&place, 1));
        }
        return are_positive_;
    }

private:
    const StretchCorners* corners_;
    PositiveFilter filter_;
    std::size_t judged_ = 0;
    bool are_positive_ = true;
};

using Weigh = std::function<std::vector<float>(const CellsToWeigh&)>;

/// The weights that bisect_coordinates() applies to cells.
struct Weights {
    std::vector<float> of_cells;  // of this process's share; empty if all cells weigh the same
    float least = 1;              // over all processes
};

/// Collective. Computes and checks the weights.
Weights weights_of(const Communicator& processes, const MeshStretch& stretch,
                   const StretchCorners& corners, const Weigh& weigh, LocalFailure& failure) {
    if (!weigh) return {};
    const std::size_t count = stretch.lists.cells.size();
    std::vector<float> weights = weigh({.processes = processes,
                                        .first_number = stretch.first_cell,
                                        .cells = corners.cells(),
                                        .points = corners.points(),
                                        .regions = stretch.lists.regions});
    if (processes.max(weights.empty() ? 0 : 1) == 0) return {};
    constexpr std::uint64_t complement = 0xffff'ffff;
    // compared by bit pattern, which orders positive numbers correctly
    std::uint64_t least = complement;
    failure.attempt([&] {
        check_weights(count, weights);
        for (const float weight : weights) {
            least = std::min<std::uint64_t>(least, std::bit_cast<std::uint32_t>(weight));
        }
    });
    failure.agree(processes);
    least = complement - processes.max(complement - least);
    return {std::move(weights), std::bit_cast<float>(static_cast<std::uint32_t>(least))};
}

/// Returns parts that are blocks of cell numbers of nearly equal size.
std::vector<int> parts_by_number(const Communicator& processes, const MeshStretch& stretch) {
    std::vector<int> parts(stretch.lists.cells.size());
    const auto size = static_cast<std::uint64_t>(processes.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i] = static_cast<int>((stretch.first_cell + i) * size / stretch.facts.cells);
    }
    return parts;
}

/// Returns whether two cells, with local vertex indices, have the same vertices.
bool has_cell_twice(const IndexVector<CellIndex, CellVertices>& cells, std::size_t vertex_count) {
    RepeatedCells repeated(cells.size());
    for (const CellVertices& cell : cells) repeated.add(cell);
    return !repeated.find(cells, vertex_count).cell.is_none();
}

/// Collective. Returns whether another process has a cell with the same vertices as a cell of this
/// process. Only cells whose vertices are all shared are candidates.
bool has_cell_of_others(const DistributedMesh& mesh, const StretchVertices& vertices,
                        LocalFailure& failure) {
    std::vector<std::array<std::uint64_t, 4>> keys;
    failure.attempt([&] {
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
    });
    return !find_sharers(mesh.processes, keys, failure).empty();
}

/// Assembles a distributed mesh from the shares that processes have read, step by step.
class Assembly {
public:
    Assembly(const Communicator& processes, MeshStretch stretch)
        : processes_(processes), stretch_(std::move(stretch)) {
        mesh_.processes = processes;
        mesh_.index_base = stretch_.facts.index_base;
        mesh_.group_names = stretch_.facts.group_names;
        if (has_any(stretch_.facts.features)) {
            mesh_.features =
                std::make_shared<const FeatureLists>(std::move(stretch_.lists.features));
        }
        mesh_.input_vertex_count = stretch_.facts.vertices;
        mesh_.input_cell_count = stretch_.facts.cells;
    }

    /// Collective. Partitions the cells and sends them to their parts.
    void bring_cells(const Homes& homes, PartitionMethod method, const Weigh& weigh) {
        std::optional<StretchCorners> corners;
        std::vector<int> parts;
        in_phase(processes_, "partition", [&] {
            corners.emplace(processes_, homes, stretch_, failure_);
            parts = find_parts(*corners, method, weigh);
            corners->forget_points();
        });
        const Phase phase(processes_, "distribute");
        CellsOfPart part = send_cells(processes_, stretch_, *corners, parts, failure_);
        mesh_.cells = std::move(part.cells);
        failure_.attempt([&] {
            mesh_.cell_ancestors =
                ancestors_of_roots(std::move(part.numbers), std::move(part.regions));
        });
        failure_.agree(processes_);
    }

    /// Collective. Fetches the vertices of the cells, and the facets and edges at these vertices.
    void bring_what_is_at_cells(const Homes& homes) {
        const Phase phase(processes_, "distribute");
        StretchVertices vertices =
            find_vertices(processes_, homes, stretch_, mesh_.cells, failure_);
        bring_vertices(processes_, vertices, stretch_, mesh_, failure_);
        for (CellVertices& cell : mesh_.cells) {
            for (VertexIndex& v : cell) v = vertices.set.place_of(v);
        }
        Mesh& lists = stretch_.lists;
        lists.points = {};
        lists.point_attributes = {};
        bring_tagged(homes, vertices, lists.facets, lists.facet_markers, stretch_.first_facet,
                     stretch_.facts.facets, stretch_.facts.has_facet_markers, cell_faces,
                     mesh_.facets, mesh_.facet_ancestors);
        bring_tagged(homes, vertices, lists.edges, lists.edge_markers, stretch_.first_edge,
                     stretch_.facts.edges, stretch_.facts.has_edge_markers, cell_edges, mesh_.edges,
                     mesh_.edge_ancestors);
        failure_.attempt(
            [&] { is_sound_ = is_sound_ && !has_cell_twice(mesh_.cells, mesh_.points.size()); });
        if (has_cell_of_others(mesh_, vertices, failure_)) is_sound_ = false;
        is_shared_ = std::move(vertices.is_shared);
        failure_.agree(processes_);
    }

    /// Collective. Returns the mesh, or nothing on all processes if one has found an error.
    [[nodiscard]] std::optional<DistributedMesh> finish() && {
        const Phase phase(processes_, "interfaces");
        if (processes_.max(is_sound_ ? 0 : 1) == 1) return std::nullopt;
        mesh_.interfaces = find_interfaces(mesh_, find_vertex_sharing(mesh_, is_shared_));
        return std::move(mesh_);
    }

    [[nodiscard]] Homes homes() {
        return homes_of_stretches(processes_, stretch_.first_vertex, stretch_.facts.vertices,
                                  failure_);
    }

private:
    /// Collective. Returns the parts of this process's cells; checks that all are positive.
    [[nodiscard]] std::vector<int> find_parts(StretchCorners& corners, PartitionMethod method,
                                              const Weigh& weigh) {
        CellPlaces places(corners);
        std::vector<int> parts;
        if (method == PartitionMethod::rcb) {
            const Weights weights = weights_of(processes_, stretch_, corners, weigh, failure_);
            WeighedPoints points{
                .count = stretch_.lists.cells.size(),
                .points = [&](std::size_t first,
                              std::span<Point> some) { places.write(first, some); },
                .number = [&](std::size_t i) { return stretch_.first_cell + i; },
                .weight = {}};
            if (!weights.of_cells.empty()) {
                points.weight = [&](std::size_t i) {
                    return whole_weight(weights.of_cells[i], weights.least);
                };
            }
            parts = bisect_coordinates(processes_, points, processes_.size(), failure_);
        } else {
            failure_.attempt([&] { parts = parts_by_number(processes_, stretch_); });
        }
        failure_.attempt(
            [&] { is_sound_ = is_sound_ && places.are_positive(stretch_.lists.cells.size()); });
        failure_.agree(processes_);
        return parts;
    }

    template <class I, std::size_t N, std::size_t Sides>
    void bring_tagged(const Homes& homes, const StretchVertices& vertices,
                      const IndexVector<I, std::array<VertexIndex, N>>& read,
                      const IndexVector<I, Marker>& markers, std::uint64_t first,
                      std::uint64_t count, bool has_markers,
                      const std::array<std::array<std::uint8_t, N>, Sides>& sides,
                      IndexVector<I, std::array<VertexIndex, N>>& list, AncestorMap& ancestors) {
        if (count == 0) return;
        TaggedSides<I, N> tagged(processes_, vertices, failure_);
        if (!tagged.collect(homes, read, markers, first)) is_sound_ = false;
        if (!tagged.find_cells(mesh_.cells, sides)) is_sound_ = false;
        failure_.attempt([&] { tagged.take(has_markers, list, ancestors); });
        failure_.agree(processes_);
    }

    Communicator processes_;
    MeshStretch stretch_;
    LocalFailure failure_;
    bool is_sound_ = true;  // as far as this process has checked
    std::vector<std::uint8_t> is_shared_;
    DistributedMesh mesh_;
};

}  // namespace

std::optional<DistributedMesh> distribute_stretch(const Communicator& processes,
                                                  MeshStretch stretch, PartitionMethod method,
                                                  const Weigh& weigh) {
    LocalFailure failure;
    std::optional<Assembly> assembly;
    Homes homes;
    in_phase(processes, "distribute", [&] {
        failure.attempt([&] { assembly.emplace(processes, std::move(stretch)); });
        failure.agree(processes);
        homes = assembly->homes();
    });
    assembly->bring_cells(homes, method, weigh);
    assembly->bring_what_is_at_cells(homes);
    return std::move(*assembly).finish();
}

}  // namespace octetra::distributed
