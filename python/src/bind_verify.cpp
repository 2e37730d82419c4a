#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <octetra/core/error.hpp>
#include <octetra/verify/verify.hpp>

#include "arguments.hpp"
#include "bind.hpp"

namespace octetra::python {
namespace {

namespace ov = verify;

/// An angle in degrees, or none for None.
std::optional<double> angle_from(const char* name, const py::handle& given) {
    if (given.is_none()) return std::nullopt;
    const double angle = number_from(name, given);
    if (angle >= 0 && angle <= 180) return angle;
    refuse(name, "a number from 0 to 180, or None", given);
}

/// Collective. Verifies the mesh, alone or as a refinement of the one in a file.
ov::Verdict judge(Mesh& mesh, const Arguments& arguments) {
    ov::VerifyOptions options;
    // The path is empty for None, which all ranks pass or none.
    const std::filesystem::path input = common_path(mesh.processes(), [&] {
        const auto [coarse, fast, min_dihedral, closure] = arguments.values<4>();
        options.fast = boolean_from("fast", fast);
        options.min_dihedral = angle_from("min_dihedral", min_dihedral);
        options.closure = closure_from("closure", closure);
        if (coarse.is_none()) {
            if (options.closure == Closure::longest_edge) return std::filesystem::path();
            throw InputError("closure='regular' requires coarse, the mesh that was refined");
        }
        const std::filesystem::path path = path_from("coarse", coarse);
        if (path.empty()) throw InputError("coarse: the path is empty");
        return path;
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

/// The number of violations for each code with violations.
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
                            "The result of Mesh.verify(), by exact arithmetic; true if the mesh is "
                            "valid. The same on all ranks.")
        .def_property_readonly("valid", &ov::Verdict::valid, "bool: whether no check has failed.")
        .def("__bool__", &ov::Verdict::valid)
        .def_property_readonly("checks", &checks,
                               "{name of a check: 'passed', 'failed' or 'skipped'}.")
        .def_property_readonly("counts", &counts,
                               "{code of a violation: number of violations}, empty if valid.")
        .def("__repr__", [](const ov::Verdict& verdict) {
            return verdict.valid()
                       ? std::string("<octetra.Verdict: valid>")
                       : "<octetra.Verdict: " + py::str(counts(verdict)).cast<std::string>() + ">";
        });
    def_method(
        mesh, "verify", "coarse=None, *, fast=False, min_dihedral=None, closure='longest-edge'",
        &judge,
        "Collective. Verifies the mesh, and returns a Verdict.\n\n"
        "coarse: the path of a mesh file; the mesh is then also verified as a refinement of "
        "that mesh by midpoints. fast: skips the checks that search in space. min_dihedral: "
        "the least dihedral angle that is accepted, in degrees. closure: 'regular' also checks "
        "that the mesh results from refinement of coarse with the regular closure. The "
        "arguments must be the same on all ranks.");
}

}  // namespace octetra::python
