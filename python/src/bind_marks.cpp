#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/check_selection.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/estimator_marks.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "backgrounds.hpp"
#include "bind.hpp"
#include "fields.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

using Estimate = std::vector<std::uint8_t> (*)(const od::Communicator&, std::span<const double>,
                                               double);

/// The mesh that is the first argument.
Mesh& mesh_in(const Arguments& arguments) {
    return instance_from<Mesh>("mesh", arguments.find("mesh", 0), "an octetra.Mesh");
}

/// Collective. `parameter` is the name of the parameter behind mesh and indicators.
py::array marks_by(Estimate estimate, const char* parameter, const Arguments& arguments) {
    Mesh& mesh = mesh_in(arguments);
    std::vector<double> indicators;
    double share = 0;
    convert_on_each(mesh.processes(), [&] {
        const auto [itself, given, number] = arguments.values<3>();
        indicators = values_of<double>("indicators", given);
        if (indicators.size() != mesh.cell_count()) {
            throw InputError(
                fmt::format("{} indicators for {} cells", indicators.size(), mesh.cell_count()));
        }
        share = number_from(parameter, number);
    });
    return booleans(mesh.ask(
        [&](const od::AdaptiveMesh& now) { return estimate(now.processes(), indicators, share); }));
}

Point point_from(const char* name, const py::handle& given) {
    const std::vector<double> numbers = values_of<double>(name, given);
    if (numbers.size() != 3) refuse(name, "three numbers", given);
    return {numbers[0], numbers[1], numbers[2]};
}

/// Marks of this rank's cells by criteria of the command line.
py::array marks_of_selection(const Mesh& mesh, const Selection& selection) {
    check(selection);
    const od::AdaptiveMesh& now = mesh.now();
    const auto points = now.points();
    const auto cells = now.cells();
    const std::vector<Marker> regions = now.regions();
    std::vector<std::uint8_t> bytes(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cells[c][k].value()];
        const Marker region = regions.empty() ? 0 : regions[c];
        bytes[c] = marks(selection, corners, region, GlobalCell{0}) ? 1 : 0;
    }
    return booleans(std::move(bytes));
}

/// Collective. The marks of an expression, with the fields that it may use.
py::array marks_where(const Arguments& arguments) {
    Mesh& mesh = mesh_in(arguments);
    Selection selection;
    std::vector<od::Field> fields;
    std::vector<od::Background> backgrounds;
    convert_on_each(mesh.processes(), [&] {
        const auto [itself, text, on_vertices, on_cells, given] = arguments.values<5>();
        selection.where.emplace_back(string_from("expression", text));
        fields = fields_of(py::reinterpret_borrow<py::object>(on_vertices),
                           py::reinterpret_borrow<py::object>(on_cells), mesh.vertex_count(),
                           mesh.cell_count());
        backgrounds = backgrounds_of(given);
    });
    return booleans(mesh.ask([&](const od::AdaptiveMesh& now) {
        return now.marked_cells(selection, fields, backgrounds);
    }));
}

/// The expression of a target size: an expression as it is, a number, or sizes or metrics of the
/// vertices, which become a field.
std::string size_from(const Mesh& mesh, const py::handle& given, std::vector<od::Field>& fields) {
    if (py::isinstance<py::str>(given)) return Expression(string_from("size", given)).text();
    if (py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given)) {
        return fmt::format("{}", number_from("size", given));
    }
    const char* const name = "size of the argument";
    const Values values = values_for(given, mesh.vertex_count(), "vertices");
    with_number_type(values.array, [&]<class T>(T) {
        fields.push_back({name, FieldOn::vertices, values.components, values.copy<T>()});
    });
    return fmt::format("size(\"{}\")", name);
}

/// Collective. The marks of cells with an edge longer than a target size.
py::array marks_by_size(const Arguments& arguments) {
    Mesh& mesh = mesh_in(arguments);
    Selection selection;
    std::vector<od::Field> fields;
    std::vector<od::Background> backgrounds;
    convert_on_each(mesh.processes(), [&] {
        const auto [itself, given, gradation, on_vertices, on_cells, others] =
            arguments.values<6>();
        fields = fields_of(py::reinterpret_borrow<py::object>(on_vertices),
                           py::reinterpret_borrow<py::object>(on_cells), mesh.vertex_count(),
                           mesh.cell_count());
        std::string size = size_from(mesh, given, fields);
        if (!gradation.is_none()) {
            const double limit = number_from("gradation", gradation);
            if (!(limit > 1 && std::isfinite(limit))) refuse("gradation", "above 1", gradation);
            size = fmt::format("graded({}, {})", size, limit);
        }
        selection.where.emplace_back(fmt::format("longest > ({})", size));
        backgrounds = backgrounds_of(others);
    });
    return booleans(mesh.ask([&](const od::AdaptiveMesh& now) {
        return now.marked_cells(selection, fields, backgrounds);
    }));
}

/// The tag, or that of the group of cells with this name.
Marker region_tag(const Mesh& mesh, const py::handle& given) {
    if (!py::isinstance<py::str>(given)) {
        return integer_from<Marker>("tag", given, ", or the name of a group of cells");
    }
    const std::string name = string_from("tag", given);
    std::string known;
    for (const GroupName& group : mesh.now().group_names()) {
        if (group.dimension != 3) continue;
        if (group.name == name) return group.tag;
        known += (known.empty() ? "" : ", ") + group.name;
    }
    throw InputError(
        known.empty()
            ? fmt::format("there is no group '{}': no group of cells of this mesh has a name", name)
            : fmt::format("there is no group '{}' of cells; the groups are {}", name, known));
}

/// One criterion, whose parameters are the mesh and `count` others, which selection() converts.
template <std::size_t count>
auto criterion(auto selection) {
    return [selection](const Arguments& arguments) {
        const Mesh& mesh = mesh_in(arguments);
        return marks_of_selection(mesh, selection(mesh, arguments.values<count + 1>()));
    };
}

void bind_criteria(py::module_& mark) {
    def_function(
        mark, "sphere", "mesh, centre, radius",
        criterion<2>([](const Mesh&, const auto& given) -> Selection {
            return {.spheres = {{point_from("centre", given[1]), number_from("radius", given[2])}}};
        }),
        "bool (cells,): marks the cells whose centroid is nearer to `centre` than `radius`. "
        "As --sphere.");
    def_function(
        mark, "box", "mesh, low, high",
        criterion<2>([](const Mesh&, const auto& given) -> Selection {
            return {.boxes = {{point_from("low", given[1]), point_from("high", given[2])}}};
        }),
        "bool (cells,): marks the cells whose centroid is in the closed box. As --box.");
    def_function(mark, "region", "mesh, tag",
                 criterion<1>([](const Mesh& mesh, const auto& given) -> Selection {
                     return {.regions = {region_tag(mesh, given[1])}};
                 }),
                 "bool (cells,): marks the cells with a region tag. tag: an integer, or the name "
                 "of a group of cells if the input file has names (.msh). As --region.");
    def_function(mark, "random", "mesh, fraction, seed=0",
                 criterion<2>([](const Mesh&, const auto& given) -> Selection {
                     return {.random = RandomShare{number_from("fraction", given[1]),
                                                   integer_from<std::uint64_t>("seed", given[2])}};
                 }),
                 "bool (cells,): marks about this fraction of the cells, the same cells on any "
                 "number of ranks. As --random.");
    def_function(mark, "larger_than", "mesh, volume",
                 criterion<1>([](const Mesh&, const auto& given) -> Selection {
                     return {.max_volume = number_from("volume", given[1])};
                 }),
                 "bool (cells,): marks the cells with a greater volume, a number above 0. As "
                 "--max-volume.");
}

}  // namespace

void bind_marks(py::module_& module) {
    py::module_ mark = module.def_submodule("mark", "Marks of cells to refine or coarsen.");
    const auto by = [](Estimate estimate, const char* parameter) {
        return [=](const Arguments& arguments) { return marks_by(estimate, parameter, arguments); };
    };
    def_function(mark, "doerfler", "mesh, indicators, theta=0.5", by(&od::mark_bulk, "theta"),
                 "Collective. bool (cells,): bulk marking. Marks the cells with the largest "
                 "indicators, as few as have the fraction theta of the sum of all indicators, and "
                 "all cells that tie with the last one.\n\n"
                 "indicators: (cells,), at least 0: squares, eta_T^2. theta: greater than 0, at "
                 "most 1. Equal indicators mark the same cells on any number of ranks.");
    def_function(mark, "maximum", "mesh, indicators, share=0.5", by(&od::mark_maximum, "share"),
                 "Collective. bool (cells,): marks the cells whose indicator is at least share "
                 "times the greatest of the whole mesh.");
    def_function(mark, "fraction", "mesh, indicators, fraction=0.1",
                 by(&od::mark_fraction, "fraction"),
                 "Collective. bool (cells,): marks this fraction of the cells, those with the "
                 "largest indicators, and all cells that tie with the last one.");
    bind_criteria(mark);
    def_function(
        mark, "where", "mesh, expression, vertex_fields=None, cell_fields=None, backgrounds=None",
        &marks_where,
        "Collective. bool (cells,): marks the cells for which the expression is true, such "
        "as \"distance(wall) < 0.1 and longest > 0.02\". As --where.\n\n"
        "expression: the same on all ranks. vertex_fields, cell_fields: {name: array}, the "
        "values that field(name) uses. backgrounds: [Background], those of "
        "background(name).");
    def_function(
        mark, "size",
        "mesh, size, gradation=None, vertex_fields=None, cell_fields=None, backgrounds=None",
        &marks_by_size,
        "Collective. bool (cells,): marks the cells with an edge longer than the target size. As "
        "--size and --gradation.\n\n"
        "size: a number, an expression such as \"0.02 + distance(wall) / 4\", or an array of the "
        "vertices: sizes (vertices,), of which the mean over a cell's vertices counts, or metrics "
        "(vertices, 6) with the components xx, yy, zz, xy, yz, xz. gradation: the size grows from "
        "a cell to the next by at most gradation - 1 for each unit of length. vertex_fields, "
        "cell_fields: {name: array}, the values that size(name) and field(name) use. backgrounds: "
        "[Background], those of background(name).");
}

}  // namespace octetra::python
