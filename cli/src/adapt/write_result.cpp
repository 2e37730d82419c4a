#include "adapt/write_result.hpp"

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/profile.hpp>

namespace octetra::cli {

std::string write_result(const distributed::AdaptiveMesh& mesh, const std::string& path) {
    const distributed::Phase phase(mesh.processes(), "write");
    if (!is_checkpoint(path)) return mesh.write(path);
    mesh.save(path);
    return {};
}

}  // namespace octetra::cli
