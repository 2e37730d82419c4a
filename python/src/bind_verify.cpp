#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/stl.h>

#include <octetra/core/error.hpp>
#include <octetra/verify/verify.hpp>

#include "bind.hpp"

namespace octetra::python {
namespace {

namespace ov = verify;

/// Collective. The mesh as it is, alone or as a refinement of the one in a file.
ov::Verdict judge(Mesh& mesh, const py::object& coarse, bool fast, const py::object& min_dihedral) {
    // None on all ranks, or a path on all.
    const py::object words = coarse.is_none() ? py::object(py::str()) : coarse;
    const std::filesystem::path input = common_path(mesh.processes(), words);
    ov::VerifyOptions options{.fast = fast};
    convert_on_each(mesh.processes(), [&] {
        if (input.empty() && !coarse.is_none()) throw InputError("coarse: the path is empty");
        options.min_dihedral = min_dihedral.cast<std::optional<double>>();
        if (options.min_dihedral && !(*options.min_dihedral >= 0 && *options.min_dihedral <= 180)) {
            throw InputError(fmt::format("min_dihedral takes a number from 0 to 180, not '{}'",
                                         *options.min_dihedral));
        }
    });
    return mesh.ask([&](const od::AdaptiveMesh& now) {
        od::CanonicalMesh canonical = now.canonical();
        ov::MeshSlice fine = ov::slice_of(canonical.whole());
        const od::Communicator& processes = now.processes();
        if (input.empty()) return ov::verify_mesh(std::move(fine), processes, options);
        return ov::verify_refinement(ov::read_slice(input, {}, processes), std::move(fine),
                                     processes, options);
    });
}

std::string_view status(const ov::Check& check) {
    if (check.status == ov::Status::passed) return "passed";
    return check.status == ov::Status::failed ? "failed" : "skipped";
}

py::dict checks(const ov::Verdict& verdict) {
    py::dict all;
    for (const ov::Check& check : verdict.checks) all[py::str(check.name)] = status(check);
    return all;
}

/// How many violations there are of each code that there are any of.
py::dict counts(const ov::Verdict& verdict) {
    py::dict all;
    for (std::size_t code = 0; code < ov::code_count; ++code) {
        const std::string_view name = ov::name(static_cast<ov::Code>(code));
        if (verdict.counts[code] > 0) all[py::str(name)] = verdict.counts[code];
    }
    return all;
}

}  // namespace

void bind_verify(py::module_& module, MeshClass& mesh) {
    py::class_<ov::Verdict>(module, "Verdict",
                            "What the verifier found, by exact arithmetic; true if the mesh is "
                            "valid. The same on all ranks.")
        .def_property_readonly("valid", &ov::Verdict::valid, "Is nothing wrong?")
        .def("__bool__", &ov::Verdict::valid)
        .def_property_readonly("checks", &checks,
                               "{name of a check: 'passed', 'failed' or 'skipped'}.")
        .def_property_readonly("counts", &counts, "{code of a violation: how many}, if any.")
        .def("__repr__", [](const ov::Verdict& verdict) {
            return verdict.valid()
                       ? std::string("<octetra.Verdict: valid>")
                       : "<octetra.Verdict: " + py::str(counts(verdict)).cast<std::string>() + ">";
        });
    mesh.def("verify", &judge, py::arg("coarse") = py::none(), py::kw_only(),
             py::arg("fast") = false, py::arg("min_dihedral") = py::none(),
             "Collective. Judges the mesh as it is; with coarse, the path of a mesh file, as a "
             "refinement of that mesh by midpoints. fast leaves out what takes a search in space. "
             "No dihedral angle may be less than min_dihedral, in degrees.");
}

}  // namespace octetra::python
