#include <string>
#include <utility>

#include <octetra/core/error.hpp>

#include "arguments.hpp"
#include "backgrounds.hpp"
#include "bind.hpp"
#include "fields.hpp"

namespace octetra::python {
namespace {

/// Collective.
od::Background background_of(Mesh& mesh, const Arguments& arguments) {
    std::string name;
    std::vector<od::Field> fields;
    convert_on_each(mesh.processes(), [&] {
        const auto [called, on_vertices, on_cells] = arguments.values<3>();
        name = string_from("name", called);
        if (on_vertices.is_none() == on_cells.is_none()) {
            throw InputError("as_background() takes either vertex_values or cell_values");
        }
        const auto named = [&](const py::handle& values) {
            py::dict all;
            if (!values.is_none()) all[py::str(name)] = values;
            return all;
        };
        fields =
            fields_of(named(on_vertices), named(on_cells), mesh.vertex_count(), mesh.cell_count());
    });
    return mesh.ask(
        [&](const od::AdaptiveMesh& now) { return now.as_background(name, fields.front()); });
}

}  // namespace

std::vector<od::Background> backgrounds_of(const py::handle& given) {
    std::vector<od::Background> backgrounds;
    if (given.is_none()) return backgrounds;
    constexpr const char* expected = "a list of octetra.Background";
    if (!py::isinstance<py::list>(given) && !py::isinstance<py::tuple>(given)) {
        refuse("backgrounds", expected, given);
    }
    for (const py::handle background : given) {
        backgrounds.push_back(instance_from<od::Background>("backgrounds", background, expected));
    }
    return backgrounds;
}

void bind_background(py::module_& module, MeshClass& mesh) {
    py::class_<od::Background>(
        module, "Background",
        "Values on a mesh of their own, for background(NAME) of expressions. Mesh.as_background() "
        "returns them. They do not change with the mesh.");
    def_method(mesh, "as_background", "name, vertex_values=None, cell_values=None", &background_of,
               "Collective. Background: one value for each vertex or each cell of this mesh, for "
               "expressions on other meshes, such as mark.size(other, 'background(h)', "
               "backgrounds=[mesh.as_background('h', sizes)]). Between vertices it is linear; a "
               "point outside the mesh has the value at the closest point.");
}

}  // namespace octetra::python
