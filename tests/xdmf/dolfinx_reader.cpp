/// Reads an XDMF file with DOLFINx, on any number of ranks: `dolfinx_reader FILE.xdmf GRID...`.
/// Each rank writes its part to `found.RANK`: for each cell, and for each tagged entity, a line
/// with the name of the grid, the tag, and the coordinates of the corners.

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <dolfinx/common/IndexMap.h>
#include <dolfinx/common/log.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/io/XDMFFile.h>
#include <dolfinx/mesh/Mesh.h>
#include <dolfinx/mesh/MeshTags.h>
#include <dolfinx/mesh/utils.h>

namespace {

namespace dm = dolfinx::mesh;

void print(std::ofstream& out, const dm::Mesh& mesh, const std::string& grid, int dimension,
           const std::vector<std::int32_t>& entities, const std::vector<std::int32_t>& tags) {
    const auto corners = dm::entities_to_geometry(mesh, dimension, entities, false);
    const auto x = mesh.geometry().x();
    const auto width = static_cast<std::size_t>(dimension) + 1;
    for (std::size_t e = 0; e < entities.size(); ++e) {
        std::string line = grid + " " + std::to_string(tags[e]);
        for (std::size_t k = 0; k < width; ++k) {
            const double* const p = x.data() + 3 * corners[e * width + k];
            char text[100];
            std::snprintf(text, sizeof text, " %a,%a,%a", p[0], p[1], p[2]);
            line += text;
        }
        out << line << '\n';
    }
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    dolfinx::init_logging(argc, argv);
    {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        std::ofstream out("found." + std::to_string(rank));
        dolfinx::io::XDMFFile file(MPI_COMM_WORLD, argv[1], "r");
        const dolfinx::fem::CoordinateElement linear(dm::CellType::tetrahedron, 1);
        const auto mesh =
            std::make_shared<dm::Mesh>(file.read_mesh(linear, dm::GhostMode::none, "mesh"));
        std::vector<std::int32_t> cells(
            static_cast<std::size_t>(mesh->topology().index_map(3)->size_local()));
        std::iota(cells.begin(), cells.end(), 0);
        print(out, *mesh, "mesh", 3, cells, std::vector<std::int32_t>(cells.size(), 0));
        for (int a = 2; a < argc; ++a) {
            const std::string grid = argv[a];
            const int dimension = grid == "cell_tags" ? 3 : grid == "facet_tags" ? 2 : 1;
            mesh->topology_mutable().create_entities(dimension);
            mesh->topology_mutable().create_connectivity(dimension, 3);
            const auto tags = file.read_meshtags(mesh, grid);
            print(out, *mesh, grid, dimension, tags.indices(), tags.values());
        }
        file.close();
    }
    MPI_Finalize();
    return 0;
}
