/// DOLFINx compared with bench_refine: `peer_dolfinx MESH --levels L [--sphere X,Y,Z,R] [--write
/// OUT]` refines the mesh of a file, uniformly or at the edges of the cells whose centroid is in
/// the sphere, and prints a line of JSON. Also under mpirun.
///
/// A level is timed from barrier to barrier. It consists of creating the edges of the mesh, which
/// DOLFINx requires; the choice of cells, if there is a sphere; and refine(), which returns a new
/// mesh. The mesh is partitioned once, before the first level.

#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include <dolfinx/common/IndexMap.h>
#include <dolfinx/common/log.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/graph/AdjacencyList.h>
#include <dolfinx/mesh/Mesh.h>
#include <dolfinx/mesh/utils.h>
#include <dolfinx/refinement/plaza.h>
#include <dolfinx/refinement/refine.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/selection.hpp>

#include "measuring.hpp"

namespace octetra::bench {
namespace {

namespace dm = dolfinx::mesh;

struct Options {
    std::string mesh;
    int levels = 1;
    std::vector<double> sphere;  ///< x, y, z, radius; empty: all cells
    bool bare = false;
    std::string write;  ///< file for the refined mesh, or empty
};

// ---- meshes, there and back

bool is_first() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == 0;
}

/// Collective. The first rank reads the file; DOLFINx's own partitioner distributes the cells.
dm::Mesh read(const std::string& path) {
    const Mesh mesh = is_first() ? read_mesh(path) : Mesh{};
    std::vector<double> x;
    for (const Point& p : mesh.points) x.insert(x.end(), {p.x, p.y, p.z});
    std::vector<std::int64_t> corners;
    std::vector<std::int32_t> offsets{0};
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) corners.push_back(v.value());
        offsets.push_back(static_cast<std::int32_t>(corners.size()));
    }
    const dolfinx::fem::CoordinateElement element(dm::CellType::tetrahedron, 1);
    return dm::create_mesh(MPI_COMM_WORLD,
                           dolfinx::graph::AdjacencyList<std::int64_t>(corners, offsets), element,
                           x, {x.size() / 3, 3}, dm::GhostMode::none);
}

std::int32_t cells_of_rank(const dm::Mesh& mesh) {
    return mesh.topology().index_map(3)->size_local();
}

/// Collective. Concatenates the values of all ranks on the first one.
template <class T>
std::vector<T> gather(const std::vector<T>& values) {
    int ranks = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const int bytes = static_cast<int>(values.size() * sizeof(T));
    std::vector<int> sizes(static_cast<std::size_t>(ranks));
    MPI_Gather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::vector<int> places(sizes.size());
    std::size_t end = 0;
    for (std::size_t r = 0; r < sizes.size() && is_first(); ++r) {
        places[r] = static_cast<int>(end);
        end += static_cast<std::size_t>(sizes[r]);
    }
    std::vector<T> all(end / sizeof(T));
    MPI_Gatherv(values.data(), bytes, MPI_BYTE, all.data(), sizes.data(), places.data(), MPI_BYTE,
                0, MPI_COMM_WORLD);
    return all;
}

/// Collective. For small meshes: a single MPI message has less than 2^31 bytes.
void write(const dm::Mesh& mesh, const std::string& path) {
    const auto vertices = mesh.geometry().index_map();
    const auto x = mesh.geometry().x().first(3 * static_cast<std::size_t>(vertices->size_local()));
    const auto local = std::span(mesh.geometry().dofmap().array())
                           .first(4 * static_cast<std::size_t>(cells_of_rank(mesh)));
    std::vector<std::int64_t> global(local.size());
    vertices->local_to_global(local, global);
    const auto points = gather(std::vector<double>(x.begin(), x.end()));
    const auto corners = gather(global);
    if (!is_first()) return;
    Mesh whole;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        whole.points.append({points[i], points[i + 1], points[i + 2]});
    }
    for (std::size_t i = 0; i < corners.size(); i += 4) {
        CellVertices cell{};
        for (std::size_t c = 0; c < 4; ++c) {
            cell[c] = VertexIndex{static_cast<std::size_t>(corners[i + c])};
        }
        whole.cells.append(cell);
    }
    (void)write_mesh(whole, path);
}

// ---- a level

/// The same cells as octetra marks.
std::vector<std::int32_t> cells_in(const dm::Mesh& mesh, const Selection& sphere) {
    const auto x = mesh.geometry().x();
    const auto& dofmap = mesh.geometry().dofmap();
    std::vector<std::int32_t> marked;
    for (std::int32_t cell = 0; cell < cells_of_rank(mesh); ++cell) {
        Corners corners{};
        const auto vertices = dofmap.links(cell);
        for (std::size_t c = 0; c < 4; ++c) {
            const auto at = 3 * static_cast<std::size_t>(vertices[c]);
            corners[c] = {x[at], x[at + 1], x[at + 2]};
        }
        if (marks(sphere, corners, 0, GlobalCell{0})) marked.push_back(cell);
    }
    return marked;
}

/// Returns the seconds of this rank since `start`, and sets `start` to the present.
double lap(double& start) {
    const double now = wall_seconds();
    return now - std::exchange(start, now);
}

double of_all(double value, MPI_Op operation) {
    double result = 0;
    MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, MPI_COMM_WORLD);
    return result;
}

std::int64_t sum(std::int64_t value) {
    std::int64_t result = 0;
    MPI_Allreduce(&value, &result, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return result;
}

/// The edges of the marked cells.
std::vector<std::int32_t> edges_in(dm::Mesh& mesh, const Selection& sphere) {
    mesh.topology_mutable().create_connectivity(3, 1);
    return dm::compute_incident_entities(mesh, cells_in(mesh, sphere), 3, 1);
}

/// Makes this rank's new cells and points, but no mesh, and returns the number of cells.
std::int64_t bare_cells(const dm::Mesh& mesh, const Selection& selection,
                        const std::vector<std::int32_t>& marked) {
    namespace plaza = dolfinx::refinement::plaza;
    const auto made =
        selection.all
            ? plaza::compute_refinement_data(mesh, plaza::RefinementOptions::none)
            : plaza::compute_refinement_data(mesh, marked, plaza::RefinementOptions::none);
    return std::get<0>(made).num_nodes();
}

/// Collective. Refines, and returns the figures: seconds are the maximum over the ranks, processor
/// seconds the sum.
nlohmann::ordered_json refine_level(dm::Mesh& mesh, const Selection& selection, bool bare) {
    const std::int64_t before = sum(cells_of_rank(mesh));
    MPI_Barrier(MPI_COMM_WORLD);
    const double processor = processor_seconds();
    double start = wall_seconds();
    const double begin = start;
    mesh.topology_mutable().create_entities(1);
    const double edges = lap(start);
    const auto marked = selection.all ? std::vector<std::int32_t>{} : edges_in(mesh, selection);
    const double choice = lap(start);
    std::int64_t cells = 0;
    if (bare) {
        cells = bare_cells(mesh, selection, marked);
    } else {
        mesh = selection.all ? dolfinx::refinement::refine(mesh, false)
                             : dolfinx::refinement::refine(mesh, marked, false);
        cells = cells_of_rank(mesh);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    const double all = wall_seconds() - begin;
    const double used = processor_seconds() - processor;
    return {{"before", before},
            {"cells", sum(cells)},
            {"seconds", of_all(all, MPI_MAX)},
            {"edges_seconds", of_all(edges, MPI_MAX)},
            {"choice_seconds", of_all(choice, MPI_MAX)},
            {"processor_seconds", of_all(used, MPI_SUM)}};
}

void measure(const Options& options) {
    dm::Mesh mesh = read(options.mesh);
    Selection selection{.all = options.sphere.empty()};
    if (!options.sphere.empty()) {
        const auto& s = options.sphere;
        selection.spheres.push_back({{s[0], s[1], s[2]}, s[3]});
    }
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    for (int level = 0; level < options.levels; ++level) {
        levels.push_back(refine_level(mesh, selection, options.bare));
    }
    int ranks = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const double peak = of_all(static_cast<double>(peak_bytes()), MPI_MAX);
    const nlohmann::ordered_json line{{"program", "DOLFINx " PEER_VERSION},
                                      {"ranks", ranks},
                                      {"levels", levels},
                                      {"peak_bytes", static_cast<std::uint64_t>(peak)}};
    if (is_first()) fmt::print("{}\n", line.dump());
    if (!options.write.empty()) write(mesh, options.write);
}

int run(int argc, char** argv) {
    CLI::App app("Refines a mesh with DOLFINx and prints how long it took, as a line of JSON");
    Options options;
    app.add_option("mesh", options.mesh, "a mesh file that octetra reads")->required();
    app.add_option("--levels", options.levels);
    app.add_option("--sphere", options.sphere, "X,Y,Z,R")->delimiter(',')->expected(4);
    app.add_flag("--bare", options.bare, "make cells and points, but no mesh of them; one level");
    app.add_option("--write", options.write, "write the refined mesh, cells as DOLFINx turns them");
    CLI11_PARSE(app, argc, argv);
    loguru::g_stderr_verbosity = loguru::Verbosity_WARNING;  // by default it logs every step
    try {
        measure(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "peer_dolfinx: {}\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    return 0;
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const int status = octetra::bench::run(argc, argv);
    MPI_Finalize();
    return status;
}
