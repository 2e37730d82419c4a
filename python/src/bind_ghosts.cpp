#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

struct Ghosts {
    od::Communicator processes;
    od::GhostLayer layer;
};
using GhostsPointer = std::shared_ptr<Ghosts>;

GhostsPointer ghosts(Mesh& mesh, const std::string& name) {
    auto by = od::GhostsBy::face;
    convert_on_each(mesh.processes(), [&] {
        if (name == "vertex") {
            by = od::GhostsBy::vertex;
        } else if (name != "face") {
            throw InputError("by: 'face' or 'vertex'");
        }
    });
    return mesh.ask([&](const od::AdaptiveMesh& now) {
        return std::make_shared<Ghosts>(Ghosts{now.processes(), now.ghosts(by)});
    });
}

/// Of each ghost a member of its Owner.
template <class T>
py::array of_owners(const Ghosts& ghosts, T od::GhostLayer::Owner::*member) {
    std::vector<T> all;
    for (const auto& owner : ghosts.layer.owners) all.push_back(owner.*member);
    return array_of(std::move(all));
}

py::array ghost_values(const Ghosts& ghosts, const py::object& given) {
    const Values own =
        values_on_each(ghosts.processes, given, ghosts.layer.own_cell_count, "cells");
    return own.like(without_gil([&] {
        const auto* bytes = static_cast<const std::byte*>(own.array.data());
        return ghosts.layer.values(ghosts.processes, std::span(bytes, own.count * own.bytes()),
                                   own.bytes());
    }));
}

}  // namespace

void bind_ghosts(py::module_& module, MeshClass& mesh) {
    const auto list = [](auto of) {
        return [of](const GhostsPointer& ghosts) {
            return view(std::span(std::as_const(ghosts->layer.*of)), ghosts);
        };
    };
    using Owner = od::GhostLayer::Owner;
    py::class_<Ghosts, GhostsPointer>(
        module, "Ghosts",
        "A layer of other ranks' cells around this one's: a picture of the mesh as it was.")
        .def_property_readonly("cells", list(&od::GhostLayer::cells),
                               "int32 (ghosts, 4): their vertices; those of `points` are numbered "
                               "behind this rank's own.")
        .def_property_readonly(
            "owner_ranks", [](const Ghosts& all) { return of_owners(all, &Owner::rank); },
            "int32 (ghosts,): the ranks that have them.")
        .def_property_readonly(
            "owner_cells", [](const Ghosts& all) { return of_owners(all, &Owner::cell); },
            "int32 (ghosts,): their numbers there.")
        .def_property_readonly("regions", list(&od::GhostLayer::regions),
                               "int32 (ghosts,), or (0,) where the input has none.")
        .def_property_readonly("points", list(&od::GhostLayer::points),
                               "float64 (n, 3): vertices that this rank does not have.")
        .def_property_readonly("vertex_numbers", list(&od::GhostLayer::vertex_numbers),
                               "int64 (n,): their numbers in the whole mesh.")
        .def(
            "values", &ghost_values, py::arg("values"),
            "Collective. Values of this rank's cells, (cells, ...) of any numbers, to those of the "
            "ghosts, (ghosts, ...), a new array.");
    mesh.def("ghosts", &ghosts, py::arg("by") = "face",
             "Collective. Cells of other ranks that have a 'face', or a 'vertex', of this rank's.");
}

}  // namespace octetra::python
