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

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/series.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/ghosts.hpp>
#include <octetra/distributed/index_map.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/migration.hpp>
#include <octetra/distributed/out_of_memory.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/sharing.hpp>
#include <octetra/distributed/sides.hpp>

namespace octetra::distributed {

/// The same on all processes.
struct StepOptions {
    Scheme scheme = Scheme::eight;
    Synchronisation synchronisation = Synchronisation::neighbour;
    /// A step that would make more cells than this, of the whole mesh, is refused.
    std::uint64_t max_cells = std::numeric_limits<std::uint64_t>::max();
    /// No step will follow: a step that changes little then takes no time and memory for what would
    /// make later ones of that kind cheap.
    bool is_last = false;

    friend bool operator==(const StepOptions&, const StepOptions&) = default;
};

/// What a process wants of a step.
struct StepRequest {
    std::span<const std::uint8_t> marks;
    StepOptions options;
};

/// What AdaptiveMesh::refine_evenly() did: first cells moved, if they did, and then the step was
/// taken, by the numbers that they have since.
struct EvenStep {
    Migration move;
    Adaptation step;
};

/// Of the arrays of a process's part those that somebody still looks at.
struct ArraysInUse {
    bool points = false;
    bool cells = false;
    bool facets = false;
    bool edges = false;
    bool vertex_numbers = false;
    bool roots = false;
};

/// The arrays of a process's part as they were; those that were not in use are empty.
struct ArraysLeft {
    std::vector<Point> points;
    std::vector<CellVertices> cells;
    std::vector<FacetVertices> facets;
    std::vector<EdgeVertices> edges;
    std::vector<GlobalVertex> vertex_numbers;
    std::vector<std::uint64_t> roots;
};

/// A tetrahedral mesh in a solver's loop: distributed over the processes of a communicator, refined
/// again and again, and asked in between. Every process has the cells that it was given and their
/// descendants, until they are rebalanced; a vertex is on every process that has a cell at it.
///
/// Numbers are local to the process, 32 bits, where nothing else is said; those of type
/// GlobalVertex, and counts, are of the whole mesh. Refinement leaves a vertex its local and its
/// global number; coarsening may change both, moving to other processes the local one. Cells and
/// tagged facets and edges may get other numbers in a step, of which its Adaptation tells. The
/// order of a process's cells is not that of files, which is the same on any number of processes.
///
/// Functions are collective where their description says so: all processes call them, in the same
/// order. What a collective function throws it throws alike on all processes, and the mesh is as it
/// was before the call: an InputError for an argument that is not right on some process, or for a
/// step that cannot be made; std::bad_alloc if one has no memory; SystemError for what else fails.
///
/// Nothing is printed, and no process is ended.
class AdaptiveMesh {
public:
    /// Collective. A mesh from a file, shared out by the partition; see read_parts().
    [[nodiscard]] static AdaptiveMesh read(const Communicator& processes,
                                           const std::filesystem::path& path,
                                           const Partition& partition = {});
    /// Collective. A mesh that the first process has; the others' `mesh` and `cell_to_rank` are not
    /// looked at.
    [[nodiscard]] static AdaptiveMesh distribute(const Communicator& processes, Mesh mesh,
                                                 const std::vector<int>& cell_to_rank);
    /// Collective. A mesh that processes hold in parts of their own making: no process ever has all
    /// of it. Cells stay where they are.
    [[nodiscard]] static AdaptiveMesh from_parts(const Communicator& processes, MeshPart part);
    /// Collective. A mesh that save() has written, on any number of processes, with its history:
    /// what is done to it from now on gives what it would have given there. No process has more
    /// than its part at any time, unless the partition is of another method than rcb. Into
    /// `fields`, null on all processes or on none, come those that were saved with it.
    ///
    /// Throws InputError where the file is damaged or no checkpoint, or processes pass different
    /// partitions, on all processes alike.
    [[nodiscard]] static AdaptiveMesh load(
        const Communicator& processes, const std::filesystem::path& path,
        const Partition& partition = {.method = PartitionMethod::rcb},
        std::vector<Field>* fields = nullptr);
    /// Collective. Of parts that are as the input was: nothing has been refined.
    explicit AdaptiveMesh(DistributedMesh part);

    ~AdaptiveMesh();
    AdaptiveMesh(const AdaptiveMesh&) = delete;
    AdaptiveMesh& operator=(const AdaptiveMesh&) = delete;
    AdaptiveMesh(AdaptiveMesh&&) noexcept;
    AdaptiveMesh& operator=(AdaptiveMesh&&) noexcept;

    /// Collective. One step of 8T-LE refinement, of the marked cells and what closure adds. `marks`
    /// has a byte for each cell of this process; not 0 means marked.
    Adaptation refine(std::span<const std::uint8_t> marks, const StepOptions& options = {});
    /// The same, for programs that make marks of something else: every process calls `request`, and
    /// what that throws on one is thrown on all, without a word between them that the step would
    /// not need anyway. Nothing in `request` is collective; it may call leave_arrays().
    Adaptation refine(const std::function<StepRequest()>& request);
    /// The same, of cells that are listed, in any order.
    Adaptation refine(std::span<const CellIndex> marked, const StepOptions& options = {});
    /// The same, of the cells that the criteria of the command line mark. Numbers of cells are
    /// those of the input.
    Adaptation refine(const Selection& selection, const StepOptions& options = {});
    /// Collective. One step that bisects these edges, each of some cell of this process, and what
    /// closure adds. It is enough that one of the processes which have an edge lists it.
    Adaptation refine_edges(std::span<const EdgeVertices> marked, const StepOptions& options = {});

    /// Collective. The same as refine(), but that cells may move first to where the step leaves all
    /// processes with about as many: after closure, when it is known how many cells each becomes,
    /// and before bisection, when there are few to move.
    EvenStep refine_evenly(std::span<const std::uint8_t> marks, const BalanceOptions& balance = {},
                           const StepOptions& options = {});
    EvenStep refine_evenly(const Selection& selection, const BalanceOptions& balance = {},
                           const StepOptions& options = {});

    /// Collective. Takes refinement back where no cell needs it any more. `may_go` has a byte for
    /// each cell of this process: not 0 where the cell may become part of the one that it was
    /// bisected from. A vertex goes when all cells at it may, none of them has been bisected since,
    /// and what stays conforms still; so every cell that is not marked stays, and none goes back
    /// by more than one step. The mesh is then the one that its steps, without what was taken
    /// back, make of the input. Marks of all cells, again and again, end in the input.
    Adaptation coarsen(std::span<const std::uint8_t> may_go);
    /// The same, of cells that are listed, in any order; or that the criteria mark.
    Adaptation coarsen(std::span<const CellIndex> may_go);
    Adaptation coarsen(const Selection& may_go);

    /// Collective. Cells go from processes that have many to those that have few, if the numbers
    /// are too different and that mends it. A cell of the input moves with all that has become of
    /// it. Which process has what changes no step to come, and no file. All local numbers change;
    /// what a program has for vertices and cells the Migration brings along.
    Migration rebalance(const BalanceOptions& options = {});
    /// Collective. The same to where a program wants them: `rank_of_root` has the process that is
    /// to have each of this process's roots().
    Migration migrate(std::span<const int> rank_of_root);
    /// Has BalanceOptions::may_forget_history made cells of a refined mesh the roots? The same on
    /// all processes.
    [[nodiscard]] bool has_forgotten_history() const;
    /// Collective. Takes that back; the last time, where it was more than once. The roots go to the
    /// processes on which they were cells then, with all that has become of them, and are
    /// descendants again: coarsening and files know what they came from. No process has more than
    /// what has become of the cells that it had.
    Migration recall_history();
    /// The numbers of the cells of the input, the roots, whose descendants this process has;
    /// ascending. They are those of a refined mesh while it has forgotten its history.
    [[nodiscard]] std::span<const std::uint64_t> roots() const;
    /// Of each cell of this process the place of its root among these. Takes time in proportion to
    /// the part.
    [[nodiscard]] std::vector<std::uint32_t> root_of_cells() const;

    [[nodiscard]] const Communicator& processes() const;

    // This process's part. Spans are valid until the mesh is refined, coarsened or moved. A tagged
    // facet or edge is on one process alone, with a cell that has it: another one may have its
    // vertices and not it.
    [[nodiscard]] std::span<const Point> points() const;
    [[nodiscard]] std::span<const CellVertices> cells() const;
    /// The region tag of each cell; empty where the input has none. Takes time in proportion to the
    /// part.
    [[nodiscard]] std::vector<Marker> regions() const;
    [[nodiscard]] std::span<const FacetVertices> facets() const;  ///< tagged ones
    [[nodiscard]] std::vector<Marker> facet_markers() const;
    /// The vertices of the tagged facets in an order that orients them: the normal, by the
    /// right-hand rule, of a facet on the boundary of the whole mesh points outward; the vertices
    /// of a facet inside ascend, as those of number_faces() do. facets() has them in the order of
    /// the input, which is that of files and orients nothing. Takes time in proportion to the part.
    [[nodiscard]] std::vector<FacetVertices> oriented_facets() const;
    [[nodiscard]] std::span<const EdgeVertices> edges() const;  ///< tagged ones
    [[nodiscard]] std::vector<Marker> edge_markers() const;
    /// Values of the input's nodal attributes, attributes_per_vertex() for each vertex; midpoints
    /// have the mean of the ends of their edge.
    [[nodiscard]] std::span<const double> vertex_attributes() const;
    [[nodiscard]] std::size_t attributes_per_vertex() const;

    /// For programs whose views of the part are to stay as they are while the mesh goes on: before
    /// a step, the mesh takes copies of these arrays to go on with, and gives away those that its
    /// spans refer to, which are then valid as long as what this returns. Takes time in proportion
    /// to the arrays. Not collective: where it throws, std::bad_alloc, nothing has changed, and
    /// Communicator::on_each() lets the other processes know.
    [[nodiscard]] ArraysLeft leave_arrays(const ArraysInUse& in_use);

    /// Of the whole mesh.
    [[nodiscard]] std::uint64_t vertex_count() const;
    /// Of each vertex of this process, its number in the whole mesh: in the canonical order, which
    /// is that of files.
    [[nodiscard]] std::span<const GlobalVertex> vertex_numbers() const;
    /// Collective. Of each cell of this process, its number in the whole mesh, in the order of
    /// files: the same on any number of processes. Takes time in proportion to the part.
    [[nodiscard]] std::vector<std::uint64_t> cell_numbers() const;
    /// Collective. Consecutive numbers for the cells of each process, rank by rank; there are no
    /// copies. make_index_map() does the same for vertices, edges and faces.
    [[nodiscard]] IndexMap<CellIndex> cell_index_map() const;
    /// What the input's file calls groups of entities with the same tag; the same on all processes.
    [[nodiscard]] const std::vector<GroupName>& group_names() const;
    /// Who else has this process's vertices, and who owns them. Sums of floating-point values over
    /// sharers differ in their last bits with the number of processes: they are rounded in another
    /// order.
    [[nodiscard]] const Sharing<VertexIndex>& vertex_sharing() const;

    // Made when they are asked for, in time in proportion to the part; pictures of the mesh as it
    // is then.

    /// The faces of this process's cells that are on the boundary of the whole mesh, tagged or not,
    /// by cell. Not collective. Other processes may have vertices of these faces without having the
    /// faces: see boundary_vertices().
    [[nodiscard]] std::vector<BoundaryFace> boundary() const;
    // Sets of vertices, for boundary conditions: a byte for each vertex of this process, 1 for the
    // vertices of the set and 0 for the others. A process may have a vertex of a boundary face or
    // of a tagged facet without having the face, so the sets are combined over all processes that
    // have the vertex; a set that is made of one process's boundary() or facets() lacks vertices.

    /// Collective. The vertices of the boundary of the whole mesh.
    [[nodiscard]] std::vector<std::uint8_t> boundary_vertices() const;
    /// Collective. The vertices of the entities of this dimension that have this marker: of tagged
    /// facets (2), of tagged edges (1), of cells by their region tag (3), or the vertices that have
    /// the marker themselves (0). No vertices where no entity has the marker. Throws
    /// InputError on all processes for another dimension, and where the arguments differ.
    [[nodiscard]] std::vector<std::uint8_t> vertices_of(Marker marker, int dimension = 2) const;
    /// Collective. The vertices of the entities of the groups with this name, of any dimension.
    /// Throws InputError on all processes where no group has the name, and where the names differ.
    [[nodiscard]] std::vector<std::uint8_t> vertices_of(std::string_view group) const;
    /// Collective. For each vertex of this process a quarter of the volume of all cells of the
    /// whole mesh that have it: the integral of its hat function, the lumped mass of P1 elements.
    /// Equal on all processes that have the vertex.
    [[nodiscard]] std::vector<double> vertex_volumes() const;
    /// Collective. The marker of each vertex of this process; empty where the input has no vertex
    /// markers. It is the one that files show, equal on all processes that have the vertex.
    [[nodiscard]] std::vector<Marker> vertex_markers() const;

    /// Collective. What is behind each face of this process's cells, also on other processes.
    [[nodiscard]] FaceNeighbours face_neighbours() const;
    /// Collective. All edges, or faces, of this process's cells, with their numbers in the whole
    /// mesh, sharers and owners.
    [[nodiscard]] MeshEdges number_edges() const;
    [[nodiscard]] MeshFaces number_faces() const;
    /// Collective. A layer of other processes' cells around this one's. Throws InputError where
    /// processes pass a different `by`.
    [[nodiscard]] GhostLayer ghosts(GhostsBy by) const;

    /// Collective. The fields of a file of Medit's, `.sol` or `.solb`, with values of this mesh's
    /// vertices and cells in the order of its files; they are called sol_1, sol_2 ... on vertices,
    /// and likewise on cells. Every process reads a share of the file. On the first, `note` is
    /// told, in a sentence, of what is in the file and not in the fields. Throws InputError
    /// ("FILE:LINE: what is wrong", of a binary file "FILE: at byte N: ...") where something is
    /// wrong with the file, or it is of another mesh.
    [[nodiscard]] std::vector<Field> read_fields(
        const std::filesystem::path& path,
        const std::function<void(const std::string&)>& note = [](const std::string&) {}) const;

    /// Collective. Writes one file, the same whatever the number of processes and the partition,
    /// or, of a `.pvtu`, each process's part as a piece. Replaces an existing file, also the one
    /// that the mesh was read from. `fields`, values of this mesh's vertices and cells, go into the
    /// formats of VTK, and of a Medit mesh into a `.sol` or `.solb` beside it, as far as that holds
    /// them. Returns what the format could not hold. Throws InputError where a field does
    /// not fit the mesh or the processes have different ones.
    [[nodiscard]] std::string write(const std::filesystem::path& path,
                                    std::span<const Field> fields = {},
                                    const WriteOptions& options = {}) const;
    /// Collective. Appends the mesh and fields to a series, whose group must be processes(). Throws
    /// what MeshSeries::append() does, and InputError for fields as write().
    void append_to(MeshSeries& series, double time, std::span<const Field> fields = {}) const;
    /// Collective. Writes a checkpoint, `.octetra`: the input, what each step did, and `fields`,
    /// values of this mesh's vertices and cells. The file is the same whatever the number of
    /// processes and the partition, unless has_forgotten_history(). It is written beside its place,
    /// brought to the disk, and then renamed: whatever happens meanwhile, a file that was there is
    /// there still, or the new one. `state`, the same on all processes, goes into the file too;
    /// read_checkpoint_facts() of octetra/core/files/checkpoint.hpp has it again. Throws InputError
    /// where a field does not fit the mesh or the processes have different fields or states.
    void save(const std::filesystem::path& path, std::span<const Field> fields = {},
              const std::optional<SavedState>& state = std::nullopt) const;
    /// Collective. The first process gets the whole mesh in the order of files, the others an empty
    /// one. Throws InputError where 32 bits cannot number it.
    [[nodiscard]] Mesh collect() const;
    /// Collective. The whole mesh as a source of slices, for writers and for verification. Refers
    /// to the mesh, which must not be refined meanwhile.
    [[nodiscard]] CanonicalMesh canonical() const;

    struct State;

private:
    explicit AdaptiveMesh(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

}  // namespace octetra::distributed
