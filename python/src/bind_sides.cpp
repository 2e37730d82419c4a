#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "shared_values.hpp"

namespace octetra::python {
namespace {

/// All edges or faces, and the processes that have them.
template <class Sides>
struct NumberedSides {
    od::Communicator processes;
    Sides sides;
};

template <class Sides>
void bind_class(py::module_& module, const char* name) {
    using Numbered = NumberedSides<Sides>;
    using Pointer = std::shared_ptr<const Numbered>;
    const auto list = [](auto of) {
        return [of](const std::shared_ptr<Numbered>& numbered) {
            const auto& values = numbered->sides.*of;
            return view(std::span(values.data(), values.size()), numbered);
        };
    };
    py::class_<Numbered, std::shared_ptr<Numbered>>(
        module, name, "All edges or faces of this rank's cells: a picture of the mesh as it was.")
        .def_property_readonly("vertices", list(&Sides::vertices),
                               "uint32 (n, 2 or 3): their vertices on this rank, ascending.")
        .def_property_readonly("of_cells", list(&Sides::of_cell),
                               "uint32 (cells, 6 or 4): those of each cell; edges in the order 01, "
                               "02, 03, 12, 13, 23, face i opposite vertex i.")
        .def_property_readonly("numbers", list(&Sides::numbers),
                               "uint64 (n,): their numbers in the whole mesh, the same on any "
                               "number of ranks.")
        .def_property_readonly(
            "count", [](const Numbered& numbered) { return numbered.sides.count; },
            "How many the whole mesh has.")
        .def_property_readonly(
            "sharing",
            [](const std::shared_ptr<Numbered>& numbered) {
                const auto& sharing = numbered->sides.sharing;
                return SharedEntities{numbered->processes, numbered->sides.vertices.size(),
                                      std::shared_ptr<const std::decay_t<decltype(sharing)>>(
                                          Pointer(numbered), &sharing)};
            },
            "Who else has them, and who owns them.");
}

template <class Sides>
std::shared_ptr<NumberedSides<Sides>> number(Mesh& mesh, Sides (od::AdaptiveMesh::*made)() const) {
    return mesh.ask([&](const od::AdaptiveMesh& now) {
        return std::make_shared<NumberedSides<Sides>>(
            NumberedSides<Sides>{now.processes(), (now.*made)()});
    });
}

/// Collective.
py::tuple face_neighbours(Mesh& mesh) {
    const od::FaceNeighbours all =
        mesh.ask([](const od::AdaptiveMesh& now) { return now.face_neighbours(); });
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

py::tuple boundary(const Mesh& mesh) {
    std::vector<CellIndex> cells;
    std::vector<std::uint8_t> faces;
    for (const auto& [cell, face] : mesh.now().boundary()) {
        cells.push_back(cell);
        faces.push_back(face);
    }
    return py::make_tuple(array_of(std::move(cells)), array_of(std::move(faces)));
}

}  // namespace

void bind_sides(py::module_& module, MeshClass& mesh) {
    bind_class<od::MeshEdges>(module, "Edges");
    bind_class<od::MeshFaces>(module, "Faces");
    mesh.def(
            "number_edges", [](Mesh& m) { return number(m, &od::AdaptiveMesh::number_edges); },
            "Collective. All edges of this rank's cells, tagged or not.")
        .def(
            "number_faces", [](Mesh& m) { return number(m, &od::AdaptiveMesh::number_faces); },
            "Collective. All faces of this rank's cells, tagged or not.")
        .def("face_neighbours", &face_neighbours,
             "Collective. What is behind each face of this rank's cells, face i opposite vertex i: "
             "int32 (cells, 4), the rank that has the cell there, -1 on the boundary; and uint32 "
             "(cells, 4), its number on that rank.")
        .def("boundary", &boundary,
             "The faces of this rank's cells on the boundary of the whole mesh: uint32 (n,), the "
             "cells, and uint8 (n,), the vertex of the cell that is opposite.");
}

}  // namespace octetra::python
