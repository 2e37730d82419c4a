#pragma once

#include <filesystem>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/partition.hpp>

namespace octetra::distributed {

/// Collective. Reads and checks a mesh, as read_mesh() does, and gives each process its part. By
/// rcb and block all processes read together, each an even share of the files and then its part, so
/// that none has more than these in memory; for the other methods, and for a file that they cannot
/// read so, the first process reads all of it and shares it out. Such files are those with
/// something to refuse or, as options may ask, to mend, and in the Medit format those with entities
/// that do not have a line each. The words of an error are read_mesh()'s, on all processes;
/// `options.note` is called on the first. Throws OutOfMemory where a process has no memory for what
/// it is to read.
[[nodiscard]] DistributedMesh read_parts(const Communicator& processes,
                                         const std::filesystem::path& path,
                                         const Partition& partition,
                                         const ReadOptions& options = {});

}  // namespace octetra::distributed
