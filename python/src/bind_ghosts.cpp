#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "arguments.hpp"
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

od::GhostsBy ghosts_by(const std::string& name) {
    if (name == "face") return od::GhostsBy::face;
    if (name == "vertex") return od::GhostsBy::vertex;
    throw InputError(fmt::format("by must be 'face' or 'vertex', not '{}'", name));
}

GhostsPointer ghosts(Mesh& mesh, const Arguments& arguments) {
    auto by = od::GhostsBy::face;
    convert_on_each(mesh.processes(),
                    [&] { by = ghosts_by(string_from("by", arguments.values<1>()[0])); });
    return mesh.ask([&](const od::AdaptiveMesh& now) {
        return std::make_shared<Ghosts>(Ghosts{now.processes(), now.ghosts(by)});
    });
}

/// One member of the owner of each ghost.
template <class T>
py::array of_owners(const Ghosts& ghosts, T od::GhostLayer::Owner::*member) {
    std::vector<T> all;
    for (const auto& owner : ghosts.layer.owners) all.push_back(owner.*member);
    return array_of(std::move(all));
}

py::array ghost_values(const Ghosts& ghosts, const Arguments& arguments) {
    const Values own = values_on_each(ghosts.processes, [&] {
        return values_for(arguments.values<1>()[0], ghosts.layer.own_cell_count, "cells");
    });
    const auto* bytes = static_cast<const std::byte*>(own.array.data());
    return own.like(without_gil([&, size = own.bytes()] {
        return ghosts.layer.values(ghosts.processes, std::span(bytes, own.count * size), size);
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
    py::class_<Ghosts, GhostsPointer> made(
        module, "Ghosts",
        "Copies of the cells of other ranks around this rank's cells, as the mesh was at the time "
        "of the call.");
    made.def_property_readonly("cells", list(&od::GhostLayer::cells),
                               "int32 (ghosts, 4): the vertices of the ghosts. The vertices in "
                               "`points` are numbered after this rank's own.")
        .def_property_readonly(
            "owner_ranks", [](const Ghosts& all) { return of_owners(all, &Owner::rank); },
            "int32 (ghosts,): the rank that owns each ghost.")
        .def_property_readonly(
            "owner_cells", [](const Ghosts& all) { return of_owners(all, &Owner::cell); },
            "int32 (ghosts,): the number of each ghost on the rank that owns it.")
        .def_property_readonly("regions", list(&od::GhostLayer::regions),
                               "int32 (ghosts,): region tags, or (0,) if the input has none.")
        .def_property_readonly("points", list(&od::GhostLayer::points),
                               "float64 (n, 3): the coordinates of the vertices of ghosts that "
                               "this rank does not have.")
        .def_property_readonly("vertex_numbers", list(&od::GhostLayer::vertex_numbers),
                               "int64 (n,): the numbers of `points` in the whole mesh.");
    def_method(made, "values", "values", &ghost_values,
               "Collective. Transfers values of this rank's cells, (cells, ...) of any numbers, to "
               "the ghosts on other ranks. Returns the values of this rank's ghosts, a new array "
               "(ghosts, ...).");
    def_method(mesh, "ghosts", "by='face'", &ghosts,
               "Collective. Ghosts: the cells of other ranks that have a face, or with by='vertex' "
               "a vertex, in common with a cell of this rank.");
}

}  // namespace octetra::python
