#include <complex>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/levels.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "collective.hpp"
#include "shared_values.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

/// One level, and its entities as soon as they were asked for.
struct Level {
    od::Levels levels;
    std::size_t index;
    std::shared_ptr<const od::LevelLists> computed;

    [[nodiscard]] std::size_t vertex_count() const { return levels.points(index).size(); }
    const od::LevelLists& lists() {
        if (!computed) computed = std::make_shared<od::LevelLists>(levels.lists(index));
        return *computed;
    }
};

py::list levels_of(Mesh& mesh, const Arguments& arguments) {
    od::LevelOptions options;
    convert_on_each(mesh.processes(), [&] {
        const auto [growth] = arguments.values<1>();
        options.growth = number_from("growth", growth);
    });
    const od::Levels levels =
        mesh.ask([&](const od::AdaptiveMesh& now) { return now.levels(options); });
    py::list all;
    for (std::size_t k = 0; k < levels.count(); ++k) all.append(Level{levels, k, nullptr});
    return all;
}

/// A property that is a view of an array of LevelLists.
auto list_view(auto member) {
    return [member](Level& level) {
        const auto& list = level.lists().*member;
        using T = typename std::decay_t<decltype(list)>::value_type;
        return view(std::span<const T>(list), level.computed);
    };
}

/// The values as double precision numbers; complex ones are two. Throws InputError for other types.
Values real_values(const Level& level, const py::object& given) {
    Values values = values_for(given, level.vertex_count(), "vertices of the level");
    const py::dtype type = values.array.dtype();
    if (!type.equal(py::dtype::of<double>()) &&
        !type.equal(py::dtype::of<std::complex<double>>())) {
        refuse("values", "float64 or complex128", py::str(py::object(type)));
    }
    return values;
}

py::array prolonged(const Level& level, const Arguments& arguments) {
    const Values values = real_values(level, arguments.values<1>()[0]);
    const std::size_t components = values.bytes() / sizeof(double);
    return values.like(level.levels.prolong(level.index, values.copy<double>(), components));
}

/// Collective.
py::array restricted(const Level& level, const Arguments& arguments) {
    const Values values = values_on_each(
        level.levels.processes(), [&] { return real_values(level, arguments.values<1>()[0]); });
    const std::size_t components = values.bytes() / sizeof(double);
    return values.like(without_gil([&, copy = values.copy<double>()] {
        return level.levels.restrict_residual(level.index, copy, components);
    }));
}

/// Collective.
py::tuple prolongation_of(const Level& level, const Arguments& arguments) {
    convert_on_each(level.levels.processes(), [&] { arguments.check(); });
    od::SparseRows rows = without_gil([&] { return level.levels.prolongation(level.index); });
    return py::make_tuple(array_of(std::move(rows.row_begin)), array_of(std::move(rows.columns)),
                          array_of(std::move(rows.values)));
}

py::tuple parents_of(const Level& level, const Arguments& arguments) {
    arguments.check();
    od::LevelParents found = level.levels.parents(level.index);
    return py::make_tuple(array_of(std::move(found.parents)), array_of(std::move(found.halvings)));
}

std::string text_of(const Level& level) {
    return fmt::format("<octetra.Level: {} of {}, {} vertices>", level.index, level.levels.count(),
                       level.levels.vertex_count(level.index));
}

void bind_level(py::module_& module) {
    using Lists = od::LevelLists;
    py::class_<Level> level(
        module, "Level",
        "A level of Mesh.levels(): this rank's part of a mesh between the input and the present "
        "mesh. It remains valid when the mesh changes. The vertices of a level are the first ones "
        "of the next level, with the same local and global numbers and owners.");
    level
        .def_property_readonly(
            "step", [](const Level& l) { return l.levels.step(l.index); },
            "int: how many steps of the history made the level.")
        .def_property_readonly(
            "vertex_count", [](const Level& l) { return l.levels.vertex_count(l.index); },
            "int: the number of vertices of the whole level.")
        .def_property_readonly(
            "points",
            [](const Level& l) {
                return view(l.levels.points(l.index), std::make_shared<const od::Levels>(l.levels));
            },
            "float64 (vertices, 3).")
        .def_property_readonly(
            "vertex_numbers",
            [](const Level& l) {
                return view(l.levels.vertex_numbers(l.index),
                            std::make_shared<const od::Levels>(l.levels));
            },
            "int64 (vertices,): numbers in the whole mesh.")
        .def_property_readonly(
            "vertex_sharing",
            [](const Level& l) {
                return SharedEntities{l.levels.processes(), l.vertex_count(),
                                      std::make_shared<const od::Sharing<VertexIndex>>(
                                          l.levels.vertex_sharing(l.index))};
            },
            "Sharing: the ranks that share this rank's vertices, and their owners.")
        .def_property_readonly("cells", list_view(&Lists::cells),
                               "int32 (cells, 4). Computed on first access, as the lists below.")
        .def_property_readonly("regions", list_view(&Lists::regions),
                               "int32 (cells,), or empty if the input has none.")
        .def_property_readonly("facets", list_view(&Lists::facets),
                               "int32 (facets, 3): tagged facets.")
        .def_property_readonly("facet_markers", list_view(&Lists::facet_markers),
                               "int32 (facets,), or empty if the input has none.")
        .def_property_readonly("edges", list_view(&Lists::edges), "int32 (edges, 2): tagged edges.")
        .def_property_readonly("edge_markers", list_view(&Lists::edge_markers),
                               "int32 (edges,), or empty if the input has none.")
        .def("__repr__", &text_of);
    def_method(level, "parents", "", &parents_of,
               "(int32 (cells,), uint8 (cells,)): for each cell of a level from 1 on, the cell of "
               "the previous level that contains it, and h: it has 2**-h of that cell's volume.");
    def_method(level, "prolongation", "", &prolongation_of,
               "Collective. (row_begin, columns, values): compressed sparse rows of the "
               "interpolation of P1 values to the next level. Rows are the next level's vertices "
               "that this rank owns, in the order of its vertex_sharing.index_map(); columns are "
               "numbers of this level's vertex_sharing.index_map().");
    def_method(level, "prolong", "values", &prolonged,
               "Interpolates values of vertices, float64 or complex128 (vertices, ...), to the "
               "next level; a midpoint gets the mean of the ends of its edge. Returns a new "
               "array.");
    def_method(level, "restrict_residual", "values", &restricted,
               "Collective. Multiplies values, float64 or complex128 (vertices, ...), by the "
               "transpose of the previous level's prolongation(). The values of owners are used. "
               "Returns a new array, equal on all ranks that share a vertex.");
}

}  // namespace

void bind_levels(py::module_& module, MeshClass& mesh) {
    bind_level(module);
    def_method(mesh, "levels", "growth=1.7", &levels_of,
               "Collective. A list of Level: nested meshes from the input to this mesh, each with "
               "at least `growth` times the vertices of the previous one, except the second. They "
               "share one copy of the mesh.");
}

}  // namespace octetra::python
