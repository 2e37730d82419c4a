#include <array>
#include <string>
#include <utility>
#include <vector>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/quality/mesh_statistics.hpp>
#include <octetra/quality/shape.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"

namespace octetra::python {
namespace {

/// measure(corners) for each of this rank's cells.
template <class T>
py::array of_cells(const Arguments& arguments, T (*measure)(const Corners&)) {
    const Mesh& mesh = instance_from<Mesh>("mesh", arguments.values<1>()[0], "an octetra.Mesh");
    const auto points = mesh.now().points();
    std::vector<T> all;
    all.reserve(mesh.cell_count());
    const StandardArithmetic standard;
    for (const CellVertices& cell : mesh.now().cells()) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cell[k].value()];
        all.push_back(measure(corners));
    }
    return array_of(std::move(all));
}

py::object range(const std::optional<quality::Range>& range) {
    if (!range) return py::none();
    return py::make_tuple(range->min, range->max);
}

py::dict sizes(const std::vector<quality::TagTotal>& totals) {
    py::dict all;
    for (const quality::TagTotal& total : totals) {
        all[py::int_(total.tag)] = py::make_tuple(total.count, total.size);
    }
    return all;
}

py::dict dict_of(const quality::MeshStatistics& found) {
    py::dict all;
    all["vertices"] = found.counts.vertices;
    all["edges"] = found.counts.edges;
    all["faces"] = found.counts.faces;
    all["cells"] = found.counts.cells;
    all["boundary_faces"] = found.counts.boundary_faces;
    all["components"] = found.counts.components;
    all["volume"] = found.volume;
    all["boundary_area"] = found.boundary_area;
    all["regions"] = sizes(found.regions);
    all["facet_markers"] = sizes(found.facet_markers);
    all["edge_markers"] = sizes(found.edge_markers);
    all["edge_length"] = range(found.edge_length);
    all["cell_volume"] = range(found.cell_volume);
    all["face_angle"] = range(found.face_angle);
    all["dihedral_angle"] = range(found.dihedral_angle);
    all["eta"] =
        found.eta ? py::object(py::make_tuple(found.eta->min, found.eta->max)) : py::none();
    return all;
}

/// Collective. The first rank measures the whole mesh and broadcasts the result.
py::object statistics(const Arguments& arguments) {
    Mesh& mesh = instance_from<Mesh>("mesh", arguments.find("mesh", 0), "an octetra.Mesh");
    std::vector<char> pickled;
    const py::module_ pickle = py::module_::import("pickle");
    mesh.ask(arguments, [&](const od::AdaptiveMesh& now) {
        const octetra::Mesh whole = now.collect();
        now.processes().on_first([&] {
            const auto found = quality::measure(whole);
            const py::gil_scoped_acquire acquired;
            const auto bytes = pickle.attr("dumps")(dict_of(found)).cast<std::string>();
            pickled.assign(bytes.begin(), bytes.end());
        });
        now.processes().broadcast(pickled);
    });
    return pickle.attr("loads")(py::bytes(pickled.data(), pickled.size()));
}

}  // namespace

void bind_quality(py::module_& module) {
    py::module_ quality = module.def_submodule("quality", "Measures of the shape of cells.");
    const auto measure = [](auto function) {
        return [=](const Arguments& arguments) { return of_cells(arguments, function); };
    };
    def_function(quality, "dihedral_angles", "mesh", measure(&quality::dihedral_angles),
                 "float64 (cells, 6): the dihedral angles at the edges 01, 02, 03, 12, 13, 23 of "
                 "this rank's cells, in degrees.");
    def_function(quality, "mean_ratio", "mesh", measure(&quality::mean_ratio),
                 "float64 (cells,): the mean ratio eta of this rank's cells: 1 for a regular "
                 "tetrahedron, 0 for a flat one.");
    def_function(quality, "volume", "mesh",
                 measure(+[](const Corners& corners) { return volume(corners); }),
                 "float64 (cells,): the volumes of this rank's cells.");
    def_function(quality, "statistics", "mesh", &statistics,
                 "Collective. dict: the statistics of the whole mesh that `octetra info` prints, "
                 "on all ranks; the first rank needs the memory for the whole mesh. Ranges are "
                 "(minimum, maximum), or None if there is no cell; regions, facet_markers and "
                 "edge_markers are {tag: (count, volume, area or length)}; angles are in degrees.");
}

}  // namespace octetra::python
