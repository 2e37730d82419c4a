#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/predicted_cells.hpp>

namespace octetra::distributed {

struct ReadPartsOptions {
    ReadOptions read;
    /// Told on all processes, which may talk to each other then, what the mesh is, before it is
    /// shared out; perhaps twice. What it throws it must throw on all. May be empty.
    std::function<void(const MeshFacts&)> on_facts;
    /// What parts are to be even in, for partitions that take weights: a weight for each cell,
    /// positive and finite, or nothing on all processes that have the cells. Those call it
    /// together, and what it throws it must throw on all. May be empty: cells weigh the same.
    std::function<std::vector<float>(const CellsToWeigh&)> weigh;
};

/// Collective. Reads and checks a mesh, as read_mesh() does, and gives each process its part. By
/// rcb and block all processes read together, each an even share of the files and then its part, so
/// that none has more than these in memory; for the other methods, and for a file that they cannot
/// read so, the first process reads all of it and shares it out. Such files are those with
/// something to refuse or, as options may ask, to mend, and in the Medit format those with entities
/// that do not have a line each. The words of an error are read_mesh()'s, on all processes;
/// `ReadOptions::note` is called on the first. Throws InputError where processes pass different
/// partitions, and OutOfMemory where a process has no memory for what it is to read.
[[nodiscard]] DistributedMesh read_parts(const Communicator& processes,
                                         const std::filesystem::path& path,
                                         const Partition& partition,
                                         const ReadPartsOptions& options = {});

}  // namespace octetra::distributed
