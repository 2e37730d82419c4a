#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/closure.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/series.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/background.hpp>
#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/ghosts.hpp>
#include <octetra/distributed/index_map.hpp>
#include <octetra/distributed/levels.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/migration.hpp>
#include <octetra/distributed/out_of_memory.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/sharing.hpp>
#include <octetra/distributed/sides.hpp>

namespace octetra::distributed {

/// Options of a step, the same on all processes.
struct StepOptions {
    Scheme scheme = Scheme::eight;  ///< the edges that a marked cell marks
    /// Closure::regular requires Scheme::eight, and a mesh that was refined with no other closure;
    /// it bounds the shapes of all cells of later steps. Vertices then do not keep their numbers.
    Closure closure = Closure::longest_edge;
    /// Does not affect the result.
    Synchronisation synchronisation = Synchronisation::neighbour;
    /// A step after which the whole mesh would have more cells than this is refused.
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    /// No step will follow: a step that changes few cells then omits the time and memory for data
    /// structures that only later steps use.
    bool is_last = false;

    friend bool operator==(const StepOptions&, const StepOptions&) = default;
};

/// The arguments of a step on one process.
struct StepRequest {
    std::span<const std::uint8_t> marks;  ///< a byte for each cell, as for AdaptiveMesh::refine()
    StepOptions options;
};

/// The result of AdaptiveMesh::refine_evenly(): an optional migration, followed by the step. The
/// step uses the local numbers after the migration.
struct EvenStep {
    Migration move;
    Adaptation step;
};

/// The arrays of a process's part to which the program still holds views.
struct ArraysInUse {
    bool points = false;
    bool cells = false;
    bool facets = false;
    bool edges = false;
    bool vertex_numbers = false;
    bool roots = false;
};

/// The previous arrays of a process's part; those that were not in use are empty.
struct DetachedArrays {
    std::vector<Point> points;
    std::vector<CellVertices> cells;
    std::vector<FacetVertices> facets;
    std::vector<EdgeVertices> edges;
    std::vector<GlobalVertex> vertex_numbers;
    std::vector<std::uint64_t> roots;
};

/// A tetrahedral mesh for an adaptive solver: distributed over the processes of a communicator, and
/// refined, coarsened and queried in a loop. Every process has the cells that were assigned to it
/// and their descendants, until they are migrated; a vertex is on every process that has a cell
/// with it.
///
/// Numbers are local to the process, with 32 bits, unless stated otherwise; those of type
/// GlobalVertex, and counts, refer to the whole mesh. Refinement preserves the local and the global
/// number of a vertex, unless its closure is Closure::regular; coarsening may change both, and
/// migration the local one. Cells and tagged
/// facets and edges may be renumbered by each step, as its Adaptation describes. The order of a
/// process's cells differs from the canonical order of files, which does not depend on the number
/// of processes.
///
/// A function is collective if its description says so: all processes must call it, in the same
/// order. A collective function throws the same exception on all processes and then leaves the mesh
/// as it was before the call: InputError for an invalid argument on any process or a step that
/// cannot be performed, std::bad_alloc if a process runs out of memory, SystemError for other
/// failures.
///
/// No function prints or ends a process.
class AdaptiveMesh {
public:
    /// Collective. Reads a mesh from a file and distributes it by the partition; see read_parts().
    [[nodiscard]] static AdaptiveMesh read(const Communicator& processes,
                                           const std::filesystem::path& path,
                                           const Partition& partition = {});
    /// Collective. Distributes a mesh that the first process holds; `cell_to_rank` has the rank of
    /// each cell. The arguments of other processes are ignored.
    [[nodiscard]] static AdaptiveMesh distribute(const Communicator& processes, Mesh mesh,
                                                 const std::vector<int>& cell_to_rank);
    /// Collective. Creates a mesh from parts that the processes already hold; no process ever holds
    /// the whole mesh. Cells stay on their processes.
    [[nodiscard]] static AdaptiveMesh from_parts(const Communicator& processes, MeshPart part);
    /// Collective. Loads a checkpoint that save() has written on any number of processes, with its
    /// history: all later operations have the same results as on the saved mesh. No process ever
    /// holds more than its part, unless the partition method is not rcb. `fields` must be null on
    /// all processes or on none; if it is not null, the saved fields are assigned to it.
    ///
    /// Throws InputError on all processes if the file is damaged or not a checkpoint, or if
    /// processes pass different partitions.
    [[nodiscard]] static AdaptiveMesh load(
        const Communicator& processes, const std::filesystem::path& path,
        const Partition& partition = {.method = PartitionMethod::rcb},
        std::vector<Field>* fields = nullptr);
    /// Collective. Creates a mesh from parts of an unrefined input.
    explicit AdaptiveMesh(DistributedMesh part);

    ~AdaptiveMesh();
    AdaptiveMesh(const AdaptiveMesh&) = delete;
    AdaptiveMesh& operator=(const AdaptiveMesh&) = delete;
    AdaptiveMesh(AdaptiveMesh&&) noexcept;
    AdaptiveMesh& operator=(AdaptiveMesh&&) noexcept;

    /// Collective. Performs one step of 8T-LE refinement of the marked cells, with closure. `marks`
    /// has a byte for each cell of this process; a nonzero byte marks the cell.
    Adaptation refine(std::span<const std::uint8_t> marks, const StepOptions& options = {});
    /// The same for programs that compute marks from other data: every process calls `request`, and
    /// an exception that it throws on one process is thrown on all. `request` must not call
    /// collective functions; it may call detach_arrays().
    Adaptation refine(const std::function<StepRequest()>& request);
    /// The same for a list of cells, in any order, as local numbers.
    Adaptation refine(std::span<const CellIndex> marked, const StepOptions& options = {});
    /// The same for cells that the criteria of the command line mark. Its cell numbers are those of
    /// the input. Expressions must be the same on all processes, and have no fields: see
    /// marked_cells().
    Adaptation refine(const Selection& selection, const StepOptions& options = {});
    /// Collective. Performs one step that bisects these edges, each of some cell of this process,
    /// with closure. At least one of the sharers of an edge must list it.
    Adaptation refine_edges(std::span<const EdgeVertices> marked, const StepOptions& options = {});

    /// Collective. The same as refine(), but first migrates cells if the step would leave the
    /// processes with uneven numbers of cells. They migrate after closure, when the number of
    /// children of each cell is known, and before bisection, when the data to move are small. With
    /// Closure::regular, whose levels are known one after the other, cells migrate if their present
    /// numbers are uneven, and BalanceOptions::only_if_it_pays has no effect.
    EvenStep refine_evenly(std::span<const std::uint8_t> marks, const BalanceOptions& balance = {},
                           const StepOptions& options = {});
    EvenStep refine_evenly(const Selection& selection, const BalanceOptions& balance = {},
                           const StepOptions& options = {});

    /// Collective. Reverses refinement where it is no longer needed. `may_coarsen` has a byte for
    /// each cell of this process, nonzero if the cell may be merged into its parent. A vertex is
    /// removed if all cells with it are marked, none of them has been bisected since, and the mesh
    /// without it is conforming. So each unmarked cell is kept, and no cell is coarsened by more
    /// than one step. The result is the mesh that the steps, without the removed vertices, produce
    /// from the input. Repeated coarsening of all cells restores the input.
    Adaptation coarsen(std::span<const std::uint8_t> may_coarsen);
    /// The same for a list of cells, in any order, or for cells that the criteria mark.
    Adaptation coarsen(std::span<const CellIndex> may_coarsen);
    Adaptation coarsen(const Selection& may_coarsen);

    /// Collective. Returns a byte for each cell of this process: 1 if the selection marks it, else
    /// 0. The same cells are marked on any number of processes. `fields`, values of this mesh's
    /// vertices and cells, are those that expressions may use; on a vertex that several processes
    /// have, the owner's value counts; `backgrounds` likewise are those of background(). The
    /// expressions must be the same on all processes.
    ///
    /// Throws InputError on all processes if a criterion is invalid, if an expression has no value
    /// in some cell (0/0, sqrt(-1)) or uses a field, background or marker that does not exist, the
    /// generation while has_forgotten_history(), or if fields do not fit the mesh.
    [[nodiscard]] std::vector<std::uint8_t> marked_cells(
        const Selection& selection, std::span<const Field> fields = {},
        std::span<const Background> backgrounds = {}) const;
    /// Collective. Returns the value of an expression in each cell of this process, under the same
    /// conditions as marked_cells().
    [[nodiscard]] std::vector<double> cell_values(
        const Expression& expression, std::span<const Field> fields = {},
        std::span<const Background> backgrounds = {}) const;

    /// Collective. Returns the number of cells of the whole mesh that refine() would make, with any
    /// max_cells. The mesh is unchanged.
    [[nodiscard]] std::uint64_t cells_after(std::span<const std::uint8_t> marks,
                                            const StepOptions& options = {});
    /// Collective. Returns those of the marked cells with the longest edges, and of equally long
    /// ones those with the lowest numbers, as many as refine() can refine without exceeding `cells`
    /// cells. Takes the time of at most 4 log2(number of marked cells) closures.
    [[nodiscard]] std::vector<std::uint8_t> marks_within(std::span<const std::uint8_t> marks,
                                                         std::uint64_t cells,
                                                         const StepOptions& options = {});

    /// Collective. Returns a copy of this mesh with a field of one component, to be used as a
    /// background mesh by marked_cells() of any mesh of the same group of processes. Values of
    /// vertices are interpolated linearly; on a vertex that several processes have, the owner's
    /// value counts. Throws InputError on all processes if the field does not fit this mesh or has
    /// several components.
    [[nodiscard]] Background as_background(std::string name, const Field& field) const;

    /// Collective. Migrates cells from processes with many to processes with few, if the numbers
    /// are too different and migration improves them. A cell of the input migrates with all its
    /// descendants. The distribution does not affect the results of later steps or the contents of
    /// files. All local numbers change; the returned Migration moves the program's data for
    /// vertices and cells.
    Migration rebalance(const BalanceOptions& options = {});
    /// Collective. Migrates roots to given ranks: `rank_of_root` has the destination rank of each
    /// of this process's roots().
    Migration migrate(std::span<const int> rank_of_root);
    /// Returns whether BalanceOptions::may_forget_history has made cells of a refined mesh the
    /// roots; the same on all processes.
    [[nodiscard]] bool has_forgotten_history() const;
    /// Collective. Reverts the last replacement of roots by BalanceOptions::may_forget_history. The
    /// roots migrate, with all their descendants, to the ranks on which they were cells when they
    /// became roots, and are descendants of the previous roots again: coarsening and files use the
    /// previous history. A process then has no more than the descendants of the cells that it had
    /// at that time.
    Migration recall_history();
    /// Returns the numbers in the input of the roots whose descendants this process has, ascending.
    /// While the mesh has forgotten its history, they are numbers of cells of a refined mesh.
    [[nodiscard]] std::span<const std::uint64_t> roots() const;
    /// Returns for each cell of this process the position of its root in roots(). Takes time
    /// proportional to the part.
    [[nodiscard]] std::vector<std::uint32_t> root_of_cells() const;

    /// The processes over which the mesh is distributed.
    [[nodiscard]] const Communicator& processes() const;

    // The part of this process. Spans are valid until the mesh is refined, coarsened or migrated. A
    // tagged facet or edge is on one process only, which has a cell with it: another process may
    // have its vertices without having the facet or edge.

    /// The coordinates of each vertex of this process.
    [[nodiscard]] std::span<const Point> points() const;
    /// The vertices of each cell of this process, in positive orientation, as local numbers.
    [[nodiscard]] std::span<const CellVertices> cells() const;
    /// Returns the region tag of each cell; empty if the input has none. Takes time proportional to
    /// the part.
    [[nodiscard]] std::vector<Marker> regions() const;
    /// The vertices of each tagged facet of this process, as local numbers.
    [[nodiscard]] std::span<const FacetVertices> facets() const;
    /// Returns the marker of each tagged facet; empty if the input has none. Takes time
    /// proportional to the part.
    [[nodiscard]] std::vector<Marker> facet_markers() const;
    /// Returns the vertices of the tagged facets in an order that orients them: the normal, by the
    /// right-hand rule, of a facet on the boundary of the whole mesh points outward; the vertices
    /// of a facet inside are ascending, as those of number_faces(). facets() has the order of the
    /// input and of files, which defines no orientation. Takes time proportional to the part.
    [[nodiscard]] std::vector<FacetVertices> oriented_facets() const;
    /// The vertices of each tagged edge of this process, as local numbers.
    [[nodiscard]] std::span<const EdgeVertices> edges() const;
    /// Returns the marker of each tagged edge; empty if the input has none. Takes time proportional
    /// to the part.
    [[nodiscard]] std::vector<Marker> edge_markers() const;
    /// The nodal attributes of the input, attributes_per_vertex() for each vertex; a midpoint has
    /// the mean of the ends of its edge.
    [[nodiscard]] std::span<const double> vertex_attributes() const;
    /// The number of nodal attributes of each vertex; 0 if the input has none.
    [[nodiscard]] std::size_t attributes_per_vertex() const;

    /// Preserves views of the part across a step: the mesh continues with copies of these arrays,
    /// and the original arrays, to which earlier spans refer, are returned; the spans stay valid as
    /// long as the result lives. Takes time proportional to the arrays. Not collective: if it
    /// throws std::bad_alloc, nothing has changed, and Communicator::transaction() notifies the
    /// other processes.
    [[nodiscard]] DetachedArrays detach_arrays(const ArraysInUse& in_use);

    /// The number of the first vertex and cell in files: 0 or 1. Errors use the numbers of files.
    [[nodiscard]] std::uint32_t index_base() const;
    /// The number of vertices of the whole mesh.
    [[nodiscard]] std::uint64_t vertex_count() const;
    /// The global number of each vertex of this process: in the canonical order, as in files.
    [[nodiscard]] std::span<const GlobalVertex> vertex_numbers() const;
    /// Collective. Returns the global number of each cell of this process, in the order of files:
    /// the same for any number of processes. Takes time proportional to the part.
    [[nodiscard]] std::vector<std::uint64_t> cell_numbers() const;
    /// Collective. Returns consecutive numbers of the cells of each process, rank by rank; there
    /// are no copies. For vertices, edges and faces see make_index_map().
    [[nodiscard]] IndexMap<CellIndex> cell_index_map() const;
    /// The names in the input's file of groups of entities with the same tag; the same on all
    /// processes.
    [[nodiscard]] const std::vector<GroupName>& group_names() const;
    /// The sharers and owners of this process's vertices. Sums of floating-point values over
    /// sharers depend in their last bits on the number of processes, which determines the order of
    /// summation.
    [[nodiscard]] const Sharing<VertexIndex>& vertex_sharing() const;

    // The following functions compute their results on demand, in time proportional to the part;
    // results are snapshots of the mesh.

    /// Returns the faces of this process's cells on the boundary of the whole mesh, tagged or not,
    /// ordered by cell. Not collective. Other processes may have vertices of these faces without
    /// having the faces: see boundary_vertices().
    [[nodiscard]] std::vector<BoundaryFace> boundary() const;
    // Sets of vertices, for boundary conditions: a byte for each vertex of this process, 1 for the
    // vertices of the set and 0 for the others. A process may have a vertex of a boundary face or
    // of a tagged facet without having the face, so the sets are combined over all sharers of a
    // vertex; a set derived from one process's boundary() or facets() alone lacks vertices.

    /// Collective. Returns the vertices of the boundary of the whole mesh.
    [[nodiscard]] std::vector<std::uint8_t> boundary_vertices() const;
    /// Collective. Returns the vertices of the entities of this dimension with this marker: tagged
    /// facets (2), tagged edges (1), cells with this region tag (3), or vertices with the marker
    /// (0). The set is empty if no entity has the marker. Throws InputError on all processes for
    /// any other dimension, and if the arguments differ between processes.
    [[nodiscard]] std::vector<std::uint8_t> vertices_of(Marker marker, int dimension = 2) const;
    /// Collective. Returns the vertices of the entities of the groups with this name, of any
    /// dimension. Throws InputError on all processes if no group has the name, and if the names
    /// differ between processes.
    [[nodiscard]] std::vector<std::uint8_t> vertices_of(std::string_view group) const;
    /// Collective. Returns for each vertex of this process a quarter of the volume of all cells of
    /// the whole mesh that have it: the integral of its hat function, or the lumped mass of P1
    /// elements. Equal on all sharers of a vertex.
    [[nodiscard]] std::vector<double> vertex_volumes() const;
    /// Collective. Returns the marker of each vertex of this process, as in files; empty if the
    /// input has no vertex markers. Equal on all sharers of a vertex.
    [[nodiscard]] std::vector<Marker> vertex_markers() const;

    /// Collective. Returns the neighbour through each face of this process's cells, also on other
    /// processes.
    [[nodiscard]] FaceNeighbours face_neighbours() const;
    /// Collective. Returns all edges, or faces, of this process's cells, with their global numbers,
    /// sharers and owners.
    [[nodiscard]] MeshEdges number_edges() const;
    [[nodiscard]] MeshFaces number_faces() const;
    /// Collective. Returns a layer of ghosts around this process's cells. Throws InputError if
    /// processes pass different values of `by`.
    [[nodiscard]] GhostLayer ghosts(GhostsBy by) const;

    /// Collective. Returns nested meshes, from the input to this mesh, with the transfer of values
    /// between them: a hierarchy for a multigrid solver. It is a copy, which remains valid when
    /// this mesh changes, and takes the memory of the mesh's points and lists once. With
    /// has_forgotten_history(), the coarsest level is the mesh at the time when its cells became
    /// roots. Throws InputError on all processes for invalid or differing options.
    [[nodiscard]] Levels levels(const LevelOptions& options = {}) const;

    /// Collective. Reads the fields of a Medit solution file, `.sol` or `.solb`, or of the sections
    /// $NodeData and $ElementData of a Gmsh file of this mesh, `.msh`, with values of this mesh's
    /// vertices and cells in the order of its files; they are named sol_1, sol_2 ... on vertices,
    /// and likewise on cells. Every process reads a share of a Medit file. On the first
    /// process `note` is called with a sentence for data in the file that are not in the result.
    /// Throws InputError ("FILE:LINE: what is wrong"; for a binary file "FILE: at byte N: ...") if
    /// the file is invalid or does not fit the mesh.
    [[nodiscard]] std::vector<Field> read_fields(
        const std::filesystem::path& path,
        const std::function<void(const std::string&)>& note = [](const std::string&) {}) const;

    /// Collective. Writes one file, whose contents do not depend on the number of processes and the
    /// partition, or for `.pvtu` also one piece for each process. Replaces an existing file, even
    /// the one that the mesh was read from. `fields`, values of this mesh's vertices and cells, are
    /// written in VTK formats, and for a Medit mesh to a `.sol` or `.solb` beside it, as far as the
    /// format supports them. Returns a description of data that the format could not represent.
    /// Throws InputError if a field does not fit the mesh or processes have different fields.
    [[nodiscard]] std::string write(const std::filesystem::path& path,
                                    std::span<const Field> fields = {},
                                    const WriteOptions& options = {}) const;
    /// Collective. Appends the mesh and fields to a series, whose group must be processes(). Throws
    /// the exceptions of MeshSeries::append(), and InputError for fields as write() does.
    void append_to(MeshSeries& series, double time, std::span<const Field> fields = {}) const;
    /// Collective. Writes a checkpoint, `.octetra`: the input, the history, and `fields`, values of
    /// this mesh's vertices and cells. The contents do not depend on the number of processes and
    /// the partition, unless has_forgotten_history(). The file is written under a temporary name in
    /// the same directory, synchronised to disk, and then renamed, so that an interruption leaves
    /// either the existing file or the new one. `state`, which must be the same on all processes,
    /// is stored in the file; read_checkpoint_facts() of octetra/core/files/checkpoint.hpp reads
    /// it. Throws InputError if a field does not fit the mesh or processes have different fields or
    /// states.
    void save(const std::filesystem::path& path, std::span<const Field> fields = {},
              const std::optional<SavedState>& state = std::nullopt) const;
    /// Collective. Returns the whole mesh in canonical order on the first process, and an empty
    /// mesh on the others. Throws InputError if its entities cannot be numbered with 32 bits.
    [[nodiscard]] Mesh collect() const;
    /// Collective. Returns the whole mesh as a source of slices, for writers and for verification.
    /// Refers to this mesh, which must not change in the meantime.
    [[nodiscard]] CanonicalMesh canonical() const;

    struct State;

private:
    explicit AdaptiveMesh(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

}  // namespace octetra::distributed
