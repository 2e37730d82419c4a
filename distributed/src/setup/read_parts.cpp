#include <octetra/distributed/read_parts.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/core/mesh_share.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "setup/distribute_share.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Returns whether the caller accepts a mesh with these facts. Its exception is not
/// thrown here: read_on_first() calls on_facts() again once the file is known to be correct.
bool caller_accepts(const MeshFacts& facts, const ReadPartsOptions& options) {
    if (!options.on_facts) return true;
    try {
        options.on_facts(facts);
    } catch (const InputError&) {
        return false;
    }
    return true;
}

/// Collective. Reads the file with all processes. Returns nothing on all processes if the first one
/// must read it alone.
std::optional<DistributedMesh> read_by_shares(const Communicator& processes,
                                              const std::filesystem::path& path,
                                              PartitionMethod method,
                                              const ReadPartsOptions& options) {
    std::optional<MeshShare> share;
    {
        const Phase phase(processes, "read");
        share = read_mesh_share(path, processes);
        if (!share || !caller_accepts(share->facts, options)) return std::nullopt;
    }
    const std::vector<std::string> notes = std::move(share->notes);
    const Phase distributing(processes, "distribute");
    return processes.transaction([&] {
        auto mesh = distribute_share(processes, std::move(*share), method, options.weigh);
        const Phase phase(processes, "read");
        for (const std::string& note : notes) {
            if (mesh && processes.is_first()) options.read.note(note);
        }
        return mesh;
    });
}

/// Collective. Returns the facts of the first process's mesh on all processes; only group names are
/// complete on the first process alone.
MeshFacts facts_of_first(const Communicator& processes, const Mesh& mesh) {
    MeshFacts facts = WholeMesh(mesh).facts();
    struct Numbers {
        std::array<std::uint64_t, 6> counts;
        std::uint32_t index_base;
        std::array<bool, 4> has;
    };
    const auto [counts, index_base, has] =
        processes.of_rank(0, Numbers{{facts.vertices, facts.cells, facts.facets, facts.edges,
                                      facts.attributes_per_point, facts.first_midpoint},
                                     facts.index_base,
                                     {facts.has_point_markers, facts.has_regions,
                                      facts.has_facet_markers, facts.has_edge_markers}});
    facts.vertices = counts[0];
    facts.cells = counts[1];
    facts.facets = counts[2];
    facts.edges = counts[3];
    facts.attributes_per_point = counts[4];
    facts.first_midpoint = counts[5];
    facts.index_base = index_base;
    facts.has_point_markers = has[0];
    facts.has_regions = has[1];
    facts.has_facet_markers = has[2];
    facts.has_edge_markers = has[3];
    return facts;
}

/// Collective. The first process reads the mesh and distributes it.
DistributedMesh read_on_first(const Communicator& processes, const std::filesystem::path& path,
                              const Partition& partition, const ReadPartsOptions& options) {
    Mesh mesh;
    in_phase(processes, "read", [&] {
        if (processes.is_first()) mesh = read_mesh(path, options.read);
        if (!options.on_facts) return;
        options.on_facts(facts_of_first(processes, mesh));
    });
    std::vector<int> cell_to_rank;
    in_phase(processes, "partition", [&] {
        // A part file that does not match the mesh is an error on one rank, too.
        const bool is_needed = processes.size() > 1 || partition.method == PartitionMethod::file;
        if (!processes.is_first() || !is_needed) return;
        const bool is_weighed = options.weigh && takes_weights(partition);
        cell_to_rank = partition_cells(
            mesh, processes.size(), partition,
            is_weighed ? options.weigh(cells_to_weigh(mesh)) : std::vector<float>{});
    });
    return distribute(processes, std::move(mesh), cell_to_rank);
}

}  // namespace

DistributedMesh read_parts(const Communicator& processes, const std::filesystem::path& path,
                           const Partition& partition, const ReadPartsOptions& options) {
    const StandardArithmetic standard;
    in_phase(processes, "read", [&] { processes.check_same("partition", text_of(partition)); });
    if (processes.size() > 1 && supports_shares(partition.method) && !options.read.only_syntax) {
        auto mesh = read_by_shares(processes, path, partition.method, options);
        if (mesh) return std::move(*mesh);
    }
    const Phase phase(processes, "distribute");
    return processes.transaction(
        [&] { return read_on_first(processes, path, partition, options); });
}

}  // namespace octetra::distributed
