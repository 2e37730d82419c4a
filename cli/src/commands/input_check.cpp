#include "commands/input_check.hpp"

#include <cstdint>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/verify/verify.hpp>

#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

/// Throws InputError on all processes if the mesh is not valid.
void refuse_unless_valid(const verify::Verdict& verdict, const JudgedFiles& judged,
                         const distributed::Communicator& world) {
    if (verdict.valid()) return;
    if (world.is_first()) {
        print_verdict(verdict, judged);
        std::fflush(stdout);
    }
    throw InputError(
        fmt::format("{}: --check finds the mesh not valid; nothing was written", judged.fine));
}

}  // namespace

void check_input(const Mesh& mesh, const std::string& path,
                 const distributed::Communicator& world) {
    const distributed::Phase phase(world, "check");
    const verify::Verdict verdict =
        world.size() == 1 ? verify::verify_mesh(mesh)
                          : verify::verify_mesh(verify::distribute_slices(mesh, world), world);
    refuse_unless_valid(verdict, {.fine = path, .fine_index_base = mesh.index_base}, world);
}

void check_input(const distributed::DistributedMesh& parts, const std::string& path) {
    const distributed::Communicator& world = parts.processes;
    const distributed::Phase phase(world, "check");
    if (world.size() > 1) return check_input(slice_of(parts), path, world);
    check_input(distributed::collect_copy(parts).mesh, path, world);
}

void check_input(verify::MeshSlice mesh, const std::string& path,
                 const distributed::Communicator& world) {
    const distributed::Phase phase(world, "check");
    const std::uint32_t index_base = mesh.lists.index_base;
    const verify::Verdict verdict = verify::verify_mesh(std::move(mesh), world);
    refuse_unless_valid(verdict, {.fine = path, .fine_index_base = index_base}, world);
}

verify::MeshSlice slice_of(const distributed::DistributedMesh& parts) {
    auto whole = distributed::CanonicalMesh::of(parts);
    return verify::slice_of(whole.whole());
}

}  // namespace octetra::cli
