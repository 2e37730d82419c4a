#include <octetra/distributed/adaptive_mesh.hpp>

#include <optional>

#include "adapt/mesh_state.hpp"
#include "fields/read_fields.hpp"
#include "level/incremental/adjacency.hpp"
#include "output/write_mesh.hpp"

namespace octetra::distributed {

std::vector<Field> AdaptiveMesh::read_fields(
    const std::filesystem::path& path, const std::function<void(const std::string&)>& note) const {
    std::optional<CanonicalOrder> order;
    processes().transaction([&] { order.emplace(state_->mesh); });
    return distributed::read_fields(state_->mesh, order->cells_before(), state_->numbers, path,
                                    note);
}

std::string AdaptiveMesh::write(const std::filesystem::path& path, std::span<const Field> fields,
                                const WriteOptions& options) const {
    return processes().transaction([&] {
        return write_mesh(state_->mesh, state_->numbers, state_->sharing, fields, path, options);
    });
}

void AdaptiveMesh::append_to(MeshSeries& series, double time, std::span<const Field> fields) const {
    processes().transaction(
        [&] { append_mesh(state_->mesh, state_->numbers, state_->sharing, fields, series, time); });
}

}  // namespace octetra::distributed
