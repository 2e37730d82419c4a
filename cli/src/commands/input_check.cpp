#include "commands/input_check.hpp"

#include <cstdio>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/verify/verify.hpp>

#include "verdict/print_verdict.hpp"

namespace octetra::cli {

void check_input(const Mesh& mesh, const std::string& path,
                 const distributed::Communicator& world) {
    const distributed::Phase phase(world, "check");
    const verify::Verdict verdict =
        world.size() == 1 ? verify::verify_mesh(mesh)
                          : verify::verify_mesh(verify::share_out(mesh, world), world);
    if (verdict.valid()) return;
    if (world.is_first()) {
        print_verdict(verdict, {.fine = path, .fine_index_base = mesh.index_base});
        std::fflush(stdout);
    }
    throw InputError(
        fmt::format("{}: --check finds the mesh not valid; nothing was written", path));
}

}  // namespace octetra::cli
