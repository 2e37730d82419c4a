// A quadratic (P2) function transferred over a refinement with the maps of the step: values at the
// vertices and at the midpoints of edges. Quadratic functions are transferred exactly.
//     mpirun -n 4 ./quadratic_transfer bracket.mesh
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/mpi.hpp>

namespace od = octetra::distributed;
using octetra::CellVertices;
using octetra::Point;
using octetra::VertexIndex;

namespace {

double quadratic(const Point& p) {
    return 1 + p.x - 2 * p.y + p.x * p.y - p.z * p.z + 3 * p.y * p.z;
}

struct QuadraticField {
    std::vector<double> at_vertex;
    std::vector<double> at_edge;
};

QuadraticField interpolated(const od::AdaptiveMesh& mesh, const od::MeshEdges& edges) {
    QuadraticField field;
    for (const Point& p : mesh.points()) field.at_vertex.push_back(quadratic(p));
    for (const auto& [a, b] : edges.vertices) {
        field.at_edge.push_back(
            quadratic(octetra::midpoint(mesh.points()[a.value()], mesh.points()[b.value()])));
    }
    return field;
}

// Returns barycentric coordinates, in a cell before the step, of a vertex or edge midpoint of the
// cell.
std::array<double, 4> barycentric(VertexIndex v, const CellVertices& cell,
                                  const od::Adaptation& step) {
    std::array<double, 4> weights{};
    const auto add = [&](VertexIndex corner, double weight) {
        weights[static_cast<std::size_t>(std::find(cell.begin(), cell.end(), corner) -
                                         cell.begin())] += weight;
    };
    if (v.value() < step.vertex_count_before) {
        add(v, 1);
    } else {
        for (const VertexIndex end : step.new_vertex_ends[v.value() - step.vertex_count_before]) {
            add(end, 0.5);
        }
    }
    return weights;
}

double evaluate(const std::array<double, 4>& l, const CellVertices& cell,
                const std::array<octetra::EdgeIndex, 6>& edges, const QuadraticField& field) {
    double value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        value += l[k] * (2 * l[k] - 1) * field.at_vertex[cell[k].value()];
    }
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = octetra::cell_edges[e];
        value += 4 * l[i] * l[j] * field.at_edge[edges[e].value()];
    }
    return value;
}

void run(const char* input) {
    const od::Communicator processes = od::communicator_of(MPI_COMM_WORLD);
    od::AdaptiveMesh mesh = od::AdaptiveMesh::read(processes, input);
    const od::MeshEdges edges_before = mesh.number_edges();
    const std::vector<CellVertices> cells_before(mesh.cells().begin(), mesh.cells().end());
    const QuadraticField before = interpolated(mesh, edges_before);

    std::vector<std::uint8_t> marks(mesh.cells().size());
    for (std::size_t c = 0; c < marks.size(); c += 3) marks[c] = 1;
    const od::Adaptation step = mesh.refine(marks);

    // Every vertex and edge midpoint of a cell lies in the parent of this cell.
    const od::MeshEdges edges = mesh.number_edges();
    QuadraticField after{std::vector<double>(mesh.points().size()),
                         std::vector<double>(edges.vertices.size())};
    const std::vector<std::uint32_t> parents = step.cells.parents();
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        const CellVertices& cell = mesh.cells()[c];
        const CellVertices& parent = cells_before[parents[c]];
        const auto& parent_edges = edges_before.of_cell[octetra::CellIndex{parents[c]}];
        std::array<std::array<double, 4>, 4> weights;
        for (std::size_t k = 0; k < 4; ++k) {
            weights[k] = barycentric(cell[k], parent, step);
            after.at_vertex[cell[k].value()] = evaluate(weights[k], parent, parent_edges, before);
        }
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [i, j] = octetra::cell_edges[e];
            std::array<double, 4> middle;
            for (std::size_t k = 0; k < 4; ++k) middle[k] = (weights[i][k] + weights[j][k]) / 2;
            after.at_edge[edges.of_cell[octetra::CellIndex{c}][e].value()] =
                evaluate(middle, parent, parent_edges, before);
        }
    }

    const QuadraticField expected = interpolated(mesh, edges);
    double largest = 0;
    double error = 0;
    const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            largest = std::max(largest, std::abs(b[i]));
            error = std::max(error, std::abs(a[i] - b[i]));
        }
    };
    compare(after.at_vertex, expected.at_vertex);
    compare(after.at_edge, expected.at_edge);
    std::array<double, 2> of_all{error, largest};
    MPI_Allreduce(MPI_IN_PLACE, of_all.data(), 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    if (!processes.is_first()) return;
    std::printf("%s: greatest error %g, greatest value %g\n",
                of_all[0] <= 1e-13 * of_all[1] ? "exact" : "NOT EXACT", of_all[0], of_all[1]);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int status = argc == 2 ? 0 : 2;
    if (argc != 2 && rank == 0) std::fprintf(stderr, "usage: quadratic_transfer INPUT\n");
    try {
        if (argc == 2) run(argv[1]);
    } catch (const std::exception& error) {  // the same on all processes
        if (rank == 0) std::fprintf(stderr, "%s\n", error.what());
        status = 2;
    }
    MPI_Finalize();
    return status;
}
