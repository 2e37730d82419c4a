#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <octetra/core/error.hpp>
#include <octetra/dolfinx/convert.hpp>

#include "arrays.hpp"
#include "held_mesh.hpp"

/// The compiled part of octetra.dolfinx. Meshes are objects of the modules octetra._octetra and
/// dolfinx.cpp, which must have been imported.
namespace octetra::python {
namespace {

using DolfinxMesh = ::dolfinx::mesh::Mesh;
using Array32 = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using Tags = std::tuple<int, Array32, Array32>;  ///< dimension, indices and values

/// Returns the tags as two arrays, or None.
py::object arrays_of(const std::optional<dolfinx::MarkerTags>& tags) {
    if (!tags) return py::none();
    return py::make_tuple(array_of(tags->indices()), array_of(tags->values()));
}

std::optional<od::GhostsBy> ghosts_by(const std::optional<std::string>& name) {
    if (!name) return std::nullopt;
    if (*name == "face") return od::GhostsBy::face;
    if (*name == "vertex") return od::GhostsBy::vertex;
    throw InputError("ghosts: 'face', 'vertex' or None");
}

py::tuple to_mesh(Mesh& mesh, const std::optional<std::string>& ghosts, bool tags) {
    auto made = mesh.ask([&](const od::AdaptiveMesh& now) {
        dolfinx::HandoverOptions options{.tags = tags};
        now.processes().transaction([&] { options.ghosts = ghosts_by(ghosts); });
        return dolfinx::to_mesh(now, options);
    });
    return py::make_tuple(std::const_pointer_cast<DolfinxMesh>(made.mesh),
                          arrays_of(made.cell_tags), arrays_of(made.facet_tags),
                          array_of(std::move(made.cells)), array_of(std::move(made.vertices)));
}

std::vector<std::int32_t> vector_of(const Array32& array) {
    return {array.data(), array.data() + array.size()};
}

std::optional<dolfinx::MarkerTags> tags_of(const std::shared_ptr<DolfinxMesh>& mesh,
                                           const std::optional<Tags>& tags) {
    if (!tags) return std::nullopt;
    const auto& [dimension, indices, values] = *tags;
    return dolfinx::MarkerTags(mesh, dimension, vector_of(indices), vector_of(values));
}

py::tuple from_mesh(const std::shared_ptr<DolfinxMesh>& mesh, const std::optional<Tags>& cells,
                    const std::optional<Tags>& facets) {
    const auto cell_tags = tags_of(mesh, cells);
    const auto facet_tags = tags_of(mesh, facets);
    auto [made, handover] = without_gil([&] {
        return dolfinx::from_mesh(mesh, cell_tags ? &*cell_tags : nullptr,
                                  facet_tags ? &*facet_tags : nullptr);
    });
    return py::make_tuple(std::make_shared<Mesh>(std::move(made)),
                          array_of(std::move(handover.cells)),
                          array_of(std::move(handover.vertices)));
}

}  // namespace

PYBIND11_MODULE(_dolfinx, module) {
    module.doc() = "The compiled part of octetra.dolfinx.";
    module.def("to_mesh", &to_mesh, py::arg("mesh"), py::arg("ghosts"), py::arg("tags"),
               "Collective. Returns the mesh for DOLFINx, cell tags and facet tags as (indices, "
               "values) or None, cells, vertices.");
    module.def(
        "from_mesh", &from_mesh, py::arg("mesh"), py::arg("cell_tags"), py::arg("facet_tags"),
        "Collective. Converts a DOLFINx mesh, with tags as (dimension, indices, values) or None; "
        "returns mesh, cells, vertices.");
}

}  // namespace octetra::python
