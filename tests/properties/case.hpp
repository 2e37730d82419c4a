#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/refine.hpp>

namespace octetra::properties {

/// One refinement that laws are held against: everything that it depends on, and nothing else.
struct Case {
    std::string kind;  ///< how the mesh was made, for people
    Mesh mesh;         ///< valid, as the verifier sees it
    Selection selection;
    Scheme scheme = Scheme::eight;
    int levels = 1;
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
    /// One for each cell. Ranks that a run does not have stand for those left over by division.
    std::vector<int> cell_to_rank;
    std::uint64_t seed =
        0;  ///< of what a law draws by itself (a numbering, a translation), and of the ranks' ways
};

}  // namespace octetra::properties
