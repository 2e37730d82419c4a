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
    ReadOptions read;  ///< as for read_mesh()
    /// Called on all processes with the properties of the mesh before it is distributed, possibly
    /// twice. May use collective functions; an exception must be thrown on all processes. May be
    /// empty.
    std::function<void(const MeshFacts&)> on_facts;
    /// Returns the weights by which partitions that take weights balance the parts: one for each
    /// cell, positive and finite; or an empty vector on all processes that have the cells. It is
    /// called collectively by these processes, and an exception must be thrown on all of them. May
    /// be empty: all cells have the same weight.
    std::function<std::vector<float>(const CellsToWeigh&)> weigh;
};

/// Collective. Reads and checks a mesh, as read_mesh() does, and returns the part of this process.
/// With the methods rcb and block all processes read an even share of the files each, and then
/// exchange cells, so that no process holds more than its share and its part. With other methods,
/// and for a file that cannot be read in parallel, the first process reads the whole mesh and
/// distributes it. Such files are those that read_mesh() rejects or, if `options` request it,
/// repairs, and Medit files whose entities are not on separate lines. Error messages are those of
/// read_mesh(), on all processes; `ReadOptions::note` is called on the first process. Throws
/// InputError if processes pass different partitions, and OutOfMemory if a process runs out of
/// memory.
[[nodiscard]] DistributedMesh read_parts(const Communicator& processes,
                                         const std::filesystem::path& path,
                                         const Partition& partition,
                                         const ReadPartsOptions& options = {});

}  // namespace octetra::distributed
