#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <octetra/core/error.hpp>
#include <octetra/verify/certify_shapes.hpp>

#include "arguments.hpp"
#include "bind.hpp"
#include "collective.hpp"

namespace octetra::python {
namespace {

namespace ov = verify;

/// Collective. Throws InputError on all ranks unless the cells of the mesh are those of its input.
void check_unrefined(const od::AdaptiveMesh& mesh) {
    const bool is_refined =
        mesh.has_forgotten_history() || mesh.cells().size() != mesh.roots().size();
    if (mesh.processes().sum(std::uint64_t{is_refined ? 1U : 0U}) == 0) return;
    throw InputError(
        "certify_shapes: the mesh has been refined, but a certificate is that of the input: call "
        "it before refinement, or octetra certify with a file of the input or a checkpoint");
}

/// Collective. Certifies the cells of the mesh.
ov::ShapeCertificate certify(Mesh& mesh, const Arguments& arguments) {
    ov::CertifyOptions options;
    convert_on_each(mesh.processes(), [&] {
        const auto [limit, worst] = arguments.values<2>();
        options.limit = integer_from<std::uint32_t>("limit", limit);
        options.worst = integer_from<std::uint32_t>("worst", worst);
        if (options.limit == 0) refuse("limit", "a number from 1 on", limit);
    });
    return mesh.ask([&](const od::AdaptiveMesh& now) {
        check_unrefined(now);
        od::CanonicalMesh canonical = now.canonical();
        return ov::certify_shapes(ov::slice_of(canonical.whole()), now.processes(), options);
    });
}

py::dict bounds_dict(const ov::ShapeBounds& bounds) {
    py::dict all;
    all["min_dihedral"] = bounds.min_dihedral;
    all["max_dihedral"] = bounds.max_dihedral;
    all["min_eta"] = bounds.min_eta;
    all["min_solid"] = bounds.min_solid;
    return all;
}

py::list worst_cells(const ov::ShapeCertificate& certificate) {
    py::list all;
    for (const ov::CertifiedCell& cell : certificate.worst) {
        py::dict one = bounds_dict(cell.certificate.bounds);
        one["cell"] = cell.cell;
        one["centroid"] = py::make_tuple(cell.centroid.x, cell.centroid.y, cell.centroid.z);
        one["shapes"] = cell.certificate.shapes;
        one["generations"] = cell.certificate.generations;
        one["closed"] = cell.certificate.is_closed;
        all.append(one);
    }
    return all;
}

}  // namespace

void bind_certificate(py::module_& module, MeshClass& mesh) {
    using Certificate = ov::ShapeCertificate;
    py::class_<Certificate>(module, "ShapeCertificate",
                            "The result of Mesh.certify_shapes(). The same on all ranks.")
        .def_property_readonly("closed", &Certificate::is_closed,
                               "bool: whether the bounds hold at any level.")
        .def_readonly("holds_to_generation", &Certificate::holds_to_generation,
                      "int or None: the last generation for which the bounds hold, unless closed.")
        .def_property_readonly(
            "bounds", [](const Certificate& found) { return bounds_dict(found.bounds); },
            "{'min_dihedral', 'max_dihedral' in degrees, 'min_eta', 'min_solid' in steradians}: "
            "bounds of all cells, rounded outward.")
        .def_readonly("cells", &Certificate::cells, "int: the number of cells.")
        .def_readonly("closed_cells", &Certificate::closed_cells,
                      "int: the number of cells whose set of shapes is closed.")
        .def_readonly("max_shapes", &Certificate::max_shapes,
                      "int: the largest number of shapes of a cell.")
        .def_property_readonly("worst", &worst_cells,
                               "A list of dicts, the least dihedral angle first: bounds, 'cell' (a "
                               "number in the whole mesh), 'centroid', 'shapes', 'generations', "
                               "'closed'.")
        .def("__repr__", [](const Certificate& found) {
            return fmt::format("<octetra.ShapeCertificate: {:.6g} to {:.6g} degrees, {}>",
                               found.bounds.min_dihedral, found.bounds.max_dihedral,
                               found.is_closed()
                                   ? std::string("at any level")
                                   : fmt::format("to generation {}", *found.holds_to_generation));
        });
    def_method(mesh, "certify_shapes", "*, limit=10000, worst=10", &certify,
               "Collective. Bounds the angles of all cells that regular refinement can make of the "
               "mesh, which must not have been refined, and returns a ShapeCertificate.\n\n"
               "limit: the set of shapes of a cell that has more members is not closed. worst: the "
               "number of cells in ShapeCertificate.worst. The arguments must be the same on all "
               "ranks.");
}

}  // namespace octetra::python
