#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <octetra/core/check_selection.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/estimator_marks.hpp>

#include "arrays.hpp"
#include "bind.hpp"

namespace octetra::python {
namespace {

using Estimate = std::vector<std::uint8_t> (*)(const od::Communicator&, std::span<const double>,
                                               double);

py::array marks_by(Estimate estimate, Mesh& mesh, const py::object& given, double share) {
    std::vector<double> indicators;
    convert_on_each(mesh.processes(), [&] {
        indicators = values_of<double>("indicators", given);
        if (indicators.size() != mesh.cell_count()) {
            throw InputError(std::to_string(indicators.size()) + " indicators for " +
                             std::to_string(mesh.cell_count()) + " cells");
        }
    });
    return booleans(mesh.ask(
        [&](const od::AdaptiveMesh& now) { return estimate(now.processes(), indicators, share); }));
}

Point point_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

using Coordinates = std::array<double, 3>;

/// What the criteria of the command line mark of this rank's cells.
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

/// The tag itself, or that of the group of cells with this name.
Marker region_tag(const Mesh& mesh, const std::variant<Marker, std::string>& given) {
    if (const Marker* const tag = std::get_if<Marker>(&given)) return *tag;
    const auto& name = std::get<std::string>(given);
    std::string known;
    for (const GroupName& group : mesh.now().group_names()) {
        if (group.dimension != 3) continue;
        if (group.name == name) return group.tag;
        known += (known.empty() ? "" : ", ") + group.name;
    }
    throw InputError(
        known.empty() ? fmt::format("no group of cells of this mesh has a name, as '{}'", name)
                      : fmt::format("no group of cells is called '{}'; there are {}", name, known));
}

void bind_criteria(py::module_& mark) {
    mark.def(
        "sphere",
        [](const Mesh& mesh, const Coordinates& centre, double radius) {
            return marks_of_selection(mesh, {.spheres = {{point_of(centre), radius}}});
        },
        py::arg("mesh"), py::arg("centre"), py::arg("radius"),
        "bool (cells,): is the centroid nearer to the centre than the radius? As --sphere.");
    mark.def(
        "box",
        [](const Mesh& mesh, const Coordinates& low, const Coordinates& high) {
            return marks_of_selection(mesh, {.boxes = {{point_of(low), point_of(high)}}});
        },
        py::arg("mesh"), py::arg("low"), py::arg("high"),
        "bool (cells,): is the centroid in the closed box? As --box.");
    mark.def(
        "region",
        [](const Mesh& mesh, const std::variant<Marker, std::string>& tag) {
            return marks_of_selection(mesh, {.regions = {region_tag(mesh, tag)}});
        },
        py::arg("mesh"), py::arg("tag"),
        "bool (cells,): is this the region tag? Or of the group with this name, where the file has "
        "names (.msh). As --region.");
    mark.def(
        "random",
        [](const Mesh& mesh, double fraction, std::uint64_t seed) {
            return marks_of_selection(mesh, {.random = RandomShare{fraction, seed}});
        },
        py::arg("mesh"), py::arg("fraction"), py::arg("seed") = 0,
        "bool (cells,): about this share of the cells, the same on any number of ranks. As "
        "--random.");
    mark.def(
        "larger_than",
        [](const Mesh& mesh, double volume) {
            return marks_of_selection(mesh, {.max_volume = volume});
        },
        py::arg("mesh"), py::arg("volume"),
        "bool (cells,): is the volume greater than this? As --max-volume.");
}

}  // namespace

void bind_marks(py::module_& module) {
    py::module_ mark = module.def_submodule("mark", "Which cells a step is to refine or coarsen.");
    const auto by = [](Estimate estimate) {
        return [=](Mesh& mesh, const py::object& indicators, double share) {
            return marks_by(estimate, mesh, indicators, share);
        };
    };
    mark.def("doerfler", by(&od::mark_bulk), py::arg("mesh"), py::arg("indicators"),
             py::arg("theta") = 0.5,
             "Collective. bool (cells,): the cells with the largest indicators, as few as have the "
             "share theta of the sum of all, and those that tie with the last one.\n\n"
             "indicators: (cells,), at least 0: squares, eta_T^2. 0 < theta <= 1. With equal "
             "indicators the same cells are marked on any number of ranks.");
    mark.def("maximum", by(&od::mark_maximum), py::arg("mesh"), py::arg("indicators"),
             py::arg("share") = 0.5,
             "Collective. bool (cells,): the cells whose indicator is at least share * (the "
             "greatest of all).");
    mark.def("fraction", by(&od::mark_fraction), py::arg("mesh"), py::arg("indicators"),
             py::arg("fraction") = 0.1,
             "Collective. bool (cells,): this fraction of the cells, those with the largest "
             "indicators, and those that tie with the last one.");
    bind_criteria(mark);
}

}  // namespace octetra::python
