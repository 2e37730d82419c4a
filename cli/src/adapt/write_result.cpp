#include "adapt/write_result.hpp"

#include <utility>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/carried_fields.hpp"

namespace octetra::cli {

std::vector<std::string> write_result(const distributed::AdaptiveMesh& mesh,
                                      const std::vector<distributed::Field>& fields,
                                      const std::string& path) {
    const distributed::Phase phase(mesh.processes(), "write");
    if (is_checkpoint(path)) {
        mesh.save(path, fields);
        return {};
    }
    std::vector<std::string> lost;
    if (std::string by_format = mesh.write(path); !by_format.empty()) {
        lost.push_back(std::move(by_format));
    }
    std::vector<std::string> names;
    for (const distributed::Field& field : fields) names.push_back(field.name);
    if (!names.empty()) {
        lost.push_back(lost_fields(names, path));
    }
    return lost;
}

}  // namespace octetra::cli
