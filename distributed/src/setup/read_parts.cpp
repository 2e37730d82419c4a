#include <octetra/distributed/read_parts.hpp>

#include <optional>
#include <utility>

#include <octetra/core/mesh_stretch.hpp>
#include <octetra/distributed/profile.hpp>

#include "comm/local_failure.hpp"
#include "setup/distribute_stretch.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Nothing, on all processes, if one must read all of it.
std::optional<DistributedMesh> read_together(const Communicator& processes,
                                             const std::filesystem::path& path,
                                             PartitionMethod method, const ReadOptions& options) {
    LocalFailure failure;
    std::optional<MeshStretch> stretch;
    {
        const Phase phase(processes, "read");
        failure.attempt([&] { stretch = read_stretch(path, processes); });
        failure.agree(processes);
    }
    if (!stretch) return std::nullopt;
    const std::vector<std::string> notes = std::move(stretch->notes);
    auto mesh = distribute_stretch(processes, std::move(*stretch), method);
    if (!mesh) return std::nullopt;
    failure.attempt([&] {
        for (const std::string& note : notes) {
            if (processes.is_first()) options.note(note);
        }
    });
    failure.agree(processes);
    return mesh;
}

}  // namespace

DistributedMesh read_parts(const Communicator& processes, const std::filesystem::path& path,
                           const Partition& partition, const ReadOptions& options) {
    if (processes.size() > 1 && works_by_stretches(partition.method) && !options.only_syntax) {
        auto mesh = read_together(processes, path, partition.method, options);
        if (mesh) return std::move(*mesh);
    }
    Mesh mesh;
    std::vector<int> cell_to_rank;
    in_phase(processes, "read",
             [&] { processes.on_first([&] { mesh = read_mesh(path, options); }); });
    in_phase(processes, "partition", [&] {
        processes.on_first([&] {
            // A part file that does not fit is a mistake on one rank, too.
            if (processes.size() == 1 && partition.method != PartitionMethod::file) return;
            cell_to_rank = partition_cells(mesh, processes.size(), partition);
        });
    });
    return distribute(processes, std::move(mesh), cell_to_rank);
}

}  // namespace octetra::distributed
