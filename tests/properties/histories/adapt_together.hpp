#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/histories/carried_values.hpp"
#include "properties/histories/reference_history.hpp"

namespace octetra::properties {

/// The history of a case as all ranks have made it: what the first one knows of it.
struct Adapted {
    std::vector<Stage> stages;        ///< of each step
    std::vector<WholeValues> values;  ///< after each step
    std::string checkpoint;           ///< the bytes of the last one that a step saved
    /// Where numbers that a rank told were not those of the whole mesh.
    std::string fault_of_numbers;
    /// Where ranks were wrong about what they share.
    std::string fault_of_sharers;
    /// Where an Adaptation told of cells that went back though they should not have.
    std::string fault_of_pasts;
};

/// Collective. `c` is the same on all ranks but for the mesh and `cell_to_rank`, which the first
/// one alone has; files go into the folder.
[[nodiscard]] Adapted adapt_together(const Case& c, const std::filesystem::path& folder);

}  // namespace octetra::properties
