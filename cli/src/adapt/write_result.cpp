#include "adapt/write_result.hpp"

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/profile.hpp>

namespace octetra::cli {

std::string write_result(const distributed::AdaptiveMesh& mesh,
                         std::span<const distributed::Field> fields, const std::string& path) {
    const distributed::Phase phase(mesh.processes(), "write");
    if (is_checkpoint(path)) {
        mesh.save(path, fields);
        return {};
    }
    return mesh.write(path, fields);
}

}  // namespace octetra::cli
