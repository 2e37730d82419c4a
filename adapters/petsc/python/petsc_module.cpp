#include <petsc4py/petsc4py.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <octetra/petsc/from_plex.hpp>
#include <octetra/petsc/to_plex.hpp>

#include "arrays.hpp"
#include "held_mesh.hpp"

/// The compiled part of octetra.petsc: conversions between meshes and DMs of petsc4py.
namespace octetra::python {
namespace {

/// Returns the communicator at an address provided by mpi4py; 0: all ranks.
MPI_Comm communicator_at(std::uintptr_t address) {
    MPI_Comm comm = PETSC_COMM_WORLD;
    if (address != 0) std::memcpy(&comm, reinterpret_cast<const void*>(address), sizeof comm);
    return comm;
}

py::object to_plex(Mesh& mesh, std::uintptr_t comm, const petsc::PlexLabels& labels) {
    DM plex = mesh.ask([&](const od::AdaptiveMesh& now) {
        return petsc::to_plex(now, communicator_at(comm), labels);
    });
    auto made =
        py::reinterpret_steal<py::object>(PyPetscDM_New(plex));  // increments the reference count
    (void)DMDestroy(&plex);
    if (!made) throw py::error_already_set();
    return made;
}

std::tuple<MeshPointer, py::array, py::array> from_plex(const py::object& given,
                                                        const petsc::PlexLabels& labels) {
    const DM plex = PyPetscDM_Get(given.ptr());
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    petsc::MeshFromPlex made = without_gil([&] { return petsc::from_plex(plex, labels); });
    return {std::make_shared<Mesh>(std::move(made.mesh)), array_of(std::move(made.cell_points)),
            array_of(std::move(made.vertex_points))};
}

}  // namespace

PYBIND11_MODULE(_petsc, module) {
    module.doc() = "The compiled part of octetra.petsc.";
    py::module_::import("octetra._octetra");  // defines the type of meshes
    if (import_petsc4py() < 0) throw py::error_already_set();
    const auto labels_of = [](std::string cells, std::string faces, std::string edges,
                              std::string boundary) {
        return petsc::PlexLabels{std::move(cells), std::move(faces), std::move(edges),
                                 std::move(boundary)};
    };
    module.def(
        "to_plex",
        [=](Mesh& mesh, std::uintptr_t comm, std::string cells, std::string faces,
            std::string edges, std::string boundary) {
            return to_plex(mesh, comm,
                           labels_of(std::move(cells), std::move(faces), std::move(edges),
                                     std::move(boundary)));
        },
        py::arg("mesh"), py::arg("comm_address"), py::arg("cells"), py::arg("faces"),
        py::arg("edges"), py::arg("boundary"), "See octetra.petsc.to_plex().");
    module.def(
        "from_plex",
        [=](const py::object& plex, std::string cells, std::string faces, std::string edges) {
            return from_plex(plex,
                             labels_of(std::move(cells), std::move(faces), std::move(edges), {}));
        },
        py::arg("plex"), py::arg("cells"), py::arg("faces"), py::arg("edges"),
        "See octetra.petsc.from_plex().");
}

}  // namespace octetra::python
