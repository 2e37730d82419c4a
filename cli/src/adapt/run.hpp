#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "adapt/adaptation.hpp"
#include "stopwatch.hpp"

/// The steps that all commands which refine or coarsen a mesh have in common, with any engine; see
/// judge.hpp for --verify. Only the first process prints.
namespace octetra::cli {

struct Run {
    const AdaptationOptions* options;
    distributed::Communicator world;  ///< the processes that execute it
    Stopwatch* watch;
};

/// The numbers of entities of a mesh; of the first process.
struct MeshSize {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
};
[[nodiscard]] inline MeshSize size_of(const MeshFacts& facts) {
    return {facts.vertices, facts.cells};
}

/// Reports an action on the mesh, its current size and the time taken.
void report(const Run& run, std::string_view doing, const MeshSize& size);

/// Collective. Reports that MESH was read. With --check, verifies it, as `octetra verify` does: if
/// it is not valid, prints the reason to stdout and throws InputError on all processes. `slice`
/// returns the slices of MESH; it is collective, and called only if they are needed.
void report_input(const Run& run, const MeshSize& size,
                  const std::function<verify::MeshSlice()>& slice);

/// Reports that OUT was written. `lost` names the data that its format cannot hold, or is empty.
void report_written(const Run& run, const std::string& lost, const MeshSize& size);

}  // namespace octetra::cli
