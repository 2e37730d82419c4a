#include <octetra/distributed/adaptive_mesh.hpp>

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/marks.hpp"
#include "comm/local_failure.hpp"
#include "level/planned_level.hpp"
#include "numbering/canonical_numbers.hpp"
#include "sharing/sharing_builder.hpp"
#include "sharing/vertex_sharing.hpp"
#include "topology/face_neighbours.hpp"
#include "topology/find_ghosts.hpp"
#include "topology/number_sides.hpp"

namespace octetra::distributed {

struct AdaptiveMesh::State {
    DistributedMesh mesh;
    CanonicalNumbers numbers;
    Sharing<VertexIndex> sharing;
    int step_count = 0;

    explicit State(DistributedMesh part)
        : mesh(std::move(part)), numbers(input_numbers(mesh)), sharing(find_vertex_sharing(mesh)) {}

    Adaptation step(const std::function<MarkedCells()>& mark, const StepOptions& options);
};

namespace {

/// The numbers of a level's new vertices: taken back unless they are kept.
class NewNumbers {
public:
    explicit NewNumbers(CanonicalNumbers& numbers)
        : numbers_(&numbers), end_(numbers.of_vertex.end_index()), count_(numbers.vertex_count) {}
    ~NewNumbers() {
        if (numbers_ != nullptr) numbers_->forget_from(end_, count_);
    }
    NewNumbers(const NewNumbers&) = delete;
    NewNumbers& operator=(const NewNumbers&) = delete;
    NewNumbers(NewNumbers&&) = delete;
    NewNumbers& operator=(NewNumbers&&) = delete;
    void keep() noexcept { numbers_ = nullptr; }

private:
    CanonicalNumbers* numbers_;
    VertexIndex end_;
    std::uint64_t count_;
};

/// Before the level is committed.
Adaptation adaptation_of(PlannedLevel& plan, const DistributedMesh& mesh) {
    const std::size_t before = mesh.level_begin.back().value();
    const auto new_ends =
        std::span(mesh.midpoint_to_edge).subspan(before - mesh.input_vertices.size());
    ListChanges changes = plan.changes();
    return {.changed = true,
            .cells = std::move(changes.cells),
            .facets = std::move(changes.facets),
            .edges = std::move(changes.edges),
            .vertex_count_before = before,
            .new_vertex_ends = {new_ends.begin(), new_ends.end()},
            .synchronisation = plan.counts};
}

Adaptation unchanged(const DistributedMesh& mesh) {
    return {.changed = false,
            .cells = Succession(mesh.cells.size()),
            .facets = Succession(mesh.facets.size()),
            .edges = Succession(mesh.edges.size()),
            .vertex_count_before = mesh.points.size(),
            .new_vertex_ends = {},
            .synchronisation = {}};
}

/// The marker of each entity of a list.
template <class I>
std::vector<Marker> all_markers(const AncestorMap& ancestors, const auto* unordered,
                                std::size_t count) {
    std::vector<Marker> markers;
    if (ancestors.markers.empty()) return markers;
    markers.resize(count);
    if (unordered != nullptr) {
        unordered->for_each_root(I{0}, I{count}, ancestors, [&](I i, std::size_t root) {
            markers[i.value()] = ancestors.markers[root];
        });
        return markers;
    }
    for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
        std::fill(markers.begin() + ancestors.first[r], markers.begin() + ancestors.first[r + 1],
                  ancestors.markers[r]);
    }
    return markers;
}

}  // namespace

Adaptation AdaptiveMesh::State::step(const std::function<MarkedCells()>& mark,
                                     const StepOptions& options) {
    const RefineOptions refine_options{.scheme = options.scheme,
                                       .levels = 1,
                                       .synchronisation = options.synchronisation,
                                       .max_cells = options.max_cells,
                                       .on_level = {}};
    const int level = step_count + 1;
    const Phase phase(mesh.processes, "level", level);
    PlannedLevel plan = plan_level(mesh, mark, refine_options, Tuning{}, level);
    if (!plan.changes_anything()) return unchanged(mesh);

    NewNumbers new_numbers(numbers);
    SharingBuilder<VertexIndex> shared(sharing, mesh.processes.rank());
    Adaptation adaptation;
    LocalFailure failure;
    {
        const Phase numbering(mesh.processes, "number vertices");
        numbers.number_midpoints(mesh, mesh.points.end_index(), sharing.shared(), failure);
    }
    failure.attempt([&] {
        auto midpoints = plan.level->shared_midpoints();
        for (std::size_t i = 0; i < midpoints.size(); ++i) {
            shared.share(mesh.interfaces[i].rank, std::move(midpoints[i]));
        }
        shared.prepare(
            [&](VertexIndex v) { return static_cast<std::uint64_t>(numbers.of_vertex[v]); });
        adaptation = adaptation_of(plan, mesh);
    });
    failure.agree(mesh.processes);

    plan.commit();
    shared.commit();
    new_numbers.keep();
    ++step_count;
    return adaptation;
}

AdaptiveMesh::AdaptiveMesh(std::unique_ptr<State> state) : state_(std::move(state)) {}
AdaptiveMesh::AdaptiveMesh(DistributedMesh part)
    : state_(std::make_unique<State>(std::move(part))) {}
AdaptiveMesh::~AdaptiveMesh() = default;
AdaptiveMesh::AdaptiveMesh(AdaptiveMesh&&) noexcept = default;
AdaptiveMesh& AdaptiveMesh::operator=(AdaptiveMesh&&) noexcept = default;

AdaptiveMesh AdaptiveMesh::read(const Communicator& processes, const std::filesystem::path& path,
                                const Partition& partition) {
    Mesh mesh;
    std::vector<int> cell_to_rank;
    processes.on_first([&] {
        mesh = read_mesh(path);
        cell_to_rank = partition_cells(mesh, processes.size(), partition);
    });
    return distribute(processes, std::move(mesh), cell_to_rank);
}

AdaptiveMesh AdaptiveMesh::distribute(const Communicator& processes, Mesh mesh,
                                      const std::vector<int>& cell_to_rank) {
    return AdaptiveMesh(distributed::distribute(processes, std::move(mesh), cell_to_rank));
}

AdaptiveMesh AdaptiveMesh::from_parts(const Communicator& processes, MeshPart part) {
    return AdaptiveMesh(distribute_parts(processes, std::move(part)));
}

Adaptation AdaptiveMesh::refine(std::span<const std::uint8_t> marks, const StepOptions& options) {
    // That all are marked, on all processes, needs no closure.
    const bool all_here =
        marks.size() == cells().size() && std::ranges::find(marks, 0) == marks.end();
    if (processes().max(all_here ? 0 : 1) == 0) return refine(Selection{.all = true}, options);
    return state_->step([&] { return marked_by_bytes(state_->mesh, marks); }, options);
}

Adaptation AdaptiveMesh::refine(std::span<const CellIndex> marked, const StepOptions& options) {
    return state_->step([&] { return marked_by_list(state_->mesh, marked); }, options);
}

Adaptation AdaptiveMesh::refine(const Selection& selection, const StepOptions& options) {
    return state_->step([&] { return mark_cells(state_->mesh, selection, false); }, options);
}

Adaptation AdaptiveMesh::refine_edges(std::span<const EdgeVertices> marked,
                                      const StepOptions& options) {
    return state_->step([&] { return cells_with_marked_edges(state_->mesh, marked); }, options);
}

const Communicator& AdaptiveMesh::processes() const { return state_->mesh.processes; }
std::span<const Point> AdaptiveMesh::points() const { return state_->mesh.points; }
std::span<const CellVertices> AdaptiveMesh::cells() const { return state_->mesh.cells; }
std::span<const FacetVertices> AdaptiveMesh::facets() const { return state_->mesh.facets; }
std::span<const EdgeVertices> AdaptiveMesh::edges() const { return state_->mesh.edges; }

std::vector<Marker> AdaptiveMesh::regions() const {
    const DistributedMesh& mesh = state_->mesh;
    return all_markers<CellIndex>(
        mesh.cell_ancestors, mesh.adjacency ? &mesh.adjacency->cells : nullptr, mesh.cells.size());
}
std::vector<Marker> AdaptiveMesh::facet_markers() const {
    const DistributedMesh& mesh = state_->mesh;
    return all_markers<FacetIndex>(mesh.facet_ancestors,
                                   mesh.adjacency ? &mesh.adjacency->facets : nullptr,
                                   mesh.facets.size());
}
std::vector<Marker> AdaptiveMesh::edge_markers() const {
    const DistributedMesh& mesh = state_->mesh;
    return all_markers<EdgeIndex>(
        mesh.edge_ancestors, mesh.adjacency ? &mesh.adjacency->edges : nullptr, mesh.edges.size());
}

std::uint64_t AdaptiveMesh::vertex_count() const { return state_->numbers.vertex_count; }
std::span<const GlobalVertex> AdaptiveMesh::vertex_numbers() const {
    return state_->numbers.of_vertex;
}
const Sharing<VertexIndex>& AdaptiveMesh::vertex_sharing() const { return state_->sharing; }

std::vector<BoundaryFace> AdaptiveMesh::boundary() const { return find_boundary(state_->mesh); }
FaceNeighbours AdaptiveMesh::face_neighbours() const { return find_face_neighbours(state_->mesh); }
MeshEdges AdaptiveMesh::number_edges() const {
    return distributed::number_edges(state_->mesh, state_->numbers, state_->sharing.shared());
}
MeshFaces AdaptiveMesh::number_faces() const {
    return distributed::number_faces(state_->mesh, state_->numbers, state_->sharing.shared());
}
GhostLayer AdaptiveMesh::ghosts(GhostsBy by) const {
    return find_ghosts(
        state_->mesh, state_->numbers, state_->sharing, [&] { return regions(); }, by);
}

Mesh AdaptiveMesh::collect() const { return collect_copy(state_->mesh).mesh; }
CanonicalMesh AdaptiveMesh::canonical() const { return CanonicalMesh::of(state_->mesh); }

std::string AdaptiveMesh::write(const std::filesystem::path& path) const {
    CanonicalMesh whole = canonical();
    return write_mesh(whole, path);
}

}  // namespace octetra::distributed
