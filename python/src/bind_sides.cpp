#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "shared_values.hpp"

namespace octetra::python {
namespace {

/// All edges or faces of this rank's cells, and the communicator of the mesh.
template <class Sides>
struct NumberedSides {
    od::Communicator processes;
    Sides sides;
    std::vector<std::array<std::int8_t, 4>> outward;  ///< of faces; see signs_of_faces()
};

template <class Sides>
void bind_class(py::module_& module, const char* name, const char* doc) {
    using Numbered = NumberedSides<Sides>;
    using Pointer = std::shared_ptr<const Numbered>;
    const auto list = [](auto of) {
        return [of](const std::shared_ptr<Numbered>& numbered) {
            const auto& values = numbered->sides.*of;
            return view(std::span(values.data(), values.size()), numbered);
        };
    };
    py::class_<Numbered, std::shared_ptr<Numbered>> made(module, name, doc);
    made.def_property_readonly("vertices", list(&Sides::vertices),
                               "int32 (n, 2 or 3): their vertices on this rank, in ascending order "
                               "of the numbers in the whole mesh, so that the direction of an edge "
                               "and the normal of a face are the same on all ranks.")
        .def_property_readonly("of_cells", list(&Sides::of_cell),
                               "int32 (cells, 6 or 4): the edges or faces of each cell: edges in "
                               "the order 01, 02, 03, 12, 13, 23, face i opposite vertex i.")
        .def_property_readonly("numbers", list(&Sides::numbers),
                               "int64 (n,): their numbers in the whole mesh, the same on any "
                               "number of ranks.")
        .def_property_readonly(
            "count", [](const Numbered& numbered) { return numbered.sides.count; },
            "int: their number in the whole mesh.")
        .def_property_readonly(
            "sharing",
            [](const std::shared_ptr<Numbered>& numbered) {
                const auto& sharing = numbered->sides.sharing;
                return SharedEntities{numbered->processes, numbered->sides.vertices.size(),
                                      std::shared_ptr<const std::decay_t<decltype(sharing)>>(
                                          Pointer(numbered), &sharing)};
            },
            "Sharing: the ranks that share them, and their owners.");
    if constexpr (std::is_same_v<Sides, od::MeshFaces>) {
        made.def_property_readonly(
            "outward",
            [](const std::shared_ptr<Numbered>& numbered) {
                return view(std::span(std::as_const(numbered->outward)), numbered);
            },
            "int8 (cells, 4): 1 where the normal of the face, by the right-hand rule on "
            "`vertices`, points out of the cell, and -1 where it points into the cell.");
    }
}

/// For each face of each cell, 1 if its normal points outward, and -1 otherwise.
std::vector<std::array<std::int8_t, 4>> signs_of_faces(const od::AdaptiveMesh& mesh) {
    std::vector<std::array<std::int8_t, 4>> signs;
    signs.reserve(mesh.cells().size());
    for (const CellVertices& cell : mesh.cells()) {
        auto& of_cell = signs.emplace_back();
        for (std::size_t face = 0; face < 4; ++face) {
            of_cell[face] = od::points_outward(cell, face) ? 1 : -1;
        }
    }
    return signs;
}

template <class Sides>
std::shared_ptr<NumberedSides<Sides>> number(Mesh& mesh, const Arguments& arguments,
                                             Sides (od::AdaptiveMesh::*made)() const) {
    return mesh.ask(arguments, [&](const od::AdaptiveMesh& now) {
        auto numbered = std::make_shared<NumberedSides<Sides>>(
            NumberedSides<Sides>{now.processes(), (now.*made)(), {}});
        if constexpr (std::is_same_v<Sides, od::MeshFaces>) numbered->outward = signs_of_faces(now);
        return numbered;
    });
}

/// Collective.
py::tuple face_neighbours(Mesh& mesh, const Arguments& arguments) {
    const od::FaceNeighbours all =
        mesh.ask(arguments, [](const od::AdaptiveMesh& now) { return now.face_neighbours(); });
    std::vector<std::array<std::int32_t, 4>> ranks(all.size());
    std::vector<std::array<CellIndex, 4>> cells(all.size());
    for (CellIndex c{0}; c < all.end_index(); ++c) {
        for (std::size_t face = 0; face < 4; ++face) {
            ranks[c.value()][face] = all[c][face].rank;
            cells[c.value()][face] = all[c][face].cell;
        }
    }
    return py::make_tuple(array_of(std::move(ranks)), array_of(std::move(cells)));
}

py::tuple boundary(const Mesh& mesh, const Arguments& arguments) {
    arguments.check();
    std::vector<CellIndex> cells;
    std::vector<std::uint8_t> faces;
    for (const auto& [cell, face] : mesh.now().boundary()) {
        cells.push_back(cell);
        faces.push_back(face);
    }
    return py::make_tuple(array_of(std::move(cells)), array_of(std::move(faces)));
}

py::array boundary_faces(const Mesh& mesh, const Arguments& arguments) {
    arguments.check();
    const od::AdaptiveMesh& now = mesh.now();
    std::vector<FacetVertices> faces;
    for (const auto& [cell, face] : now.boundary()) {
        faces.push_back(od::outward_face(now.cells()[cell.value()], face));
    }
    return array_of(std::move(faces));
}

py::array oriented_facets(const Mesh& mesh, const Arguments& arguments) {
    arguments.check();
    return array_of(mesh.now().oriented_facets());
}

/// A table of the corners of edges or faces of a cell, as an array.
template <std::size_t N, std::size_t Sides>
py::array table(const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::vector<std::array<std::int32_t, N>> rows(Sides);
    for (std::size_t i = 0; i < Sides; ++i) std::ranges::copy(sides[i], rows[i].begin());
    return array_of(std::move(rows));
}

}  // namespace

void bind_sides(py::module_& module, MeshClass& mesh) {
    bind_class<od::MeshEdges>(
        module, "Edges",
        "All edges of this rank's cells, as the mesh was at the time of the call.");
    bind_class<od::MeshFaces>(
        module, "Faces",
        "All faces of this rank's cells, as the mesh was at the time of the call.");
    module.attr("cell_edges") = table(cell_edges);
    module.attr("cell_faces") = table(od::outward_faces);
    def_method(
        mesh, "number_edges", "",
        [](Mesh& m, const Arguments& arguments) {
            return number(m, arguments, &od::AdaptiveMesh::number_edges);
        },
        "Collective. Edges: all edges of this rank's cells, tagged or not.");
    def_method(
        mesh, "number_faces", "",
        [](Mesh& m, const Arguments& arguments) {
            return number(m, arguments, &od::AdaptiveMesh::number_faces);
        },
        "Collective. Faces: all faces of this rank's cells, tagged or not.");
    def_method(mesh, "face_neighbours", "", &face_neighbours,
               "Collective. The cells behind the faces of this rank's cells, face i opposite "
               "vertex i. Returns two arrays, int32 (cells, 4): the rank that has the cell, -1 on "
               "the boundary; and the number of the cell on that rank, or -1.");
    def_method(mesh, "boundary", "", &boundary,
               "The faces of this rank's cells on the boundary of the whole mesh. Returns two "
               "arrays: the cells, int32 (n,), and the vertex of the cell that is opposite the "
               "face, uint8 (n,), from 0 to 3.");
    def_method(mesh, "boundary_faces", "", &boundary_faces,
               "int32 (n, 3): the vertices of the faces of boundary(), in the same order. The "
               "normal, by the right-hand rule, points outward.");
    def_method(mesh, "oriented_facets", "", &oriented_facets,
               "int32 (facets, 3): the vertices of the tagged facets. The normal, by the "
               "right-hand rule, of a facet on the boundary of the whole mesh points outward; the "
               "vertices of an inner facet ascend as those of number_faces() do.");
}

}  // namespace octetra::python
