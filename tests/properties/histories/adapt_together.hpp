#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "properties/histories/carried_values.hpp"
#include "properties/histories/reference_history.hpp"

namespace octetra::properties {

/// The history of a case as made by all ranks, as far as the first rank knows it.
struct Adapted {
    std::vector<Stage> stages;        ///< after each step
    std::vector<WholeValues> values;  ///< after each step
    std::string checkpoint;           ///< contents of the last checkpoint that a step saved
    /// Describes numbers of a rank that differ from those of the whole mesh.
    std::string fault_of_numbers;
    /// Describes sharers that a rank reported wrongly.
    std::string fault_of_sharers;
    /// Describes cells that an Adaptation coarsened against the rules.
    std::string fault_of_ancestries;
};

/// Collective. `c` is the same on all ranks except for the mesh and `cell_to_rank`, which only the
/// first rank has; files are written to the folder.
[[nodiscard]] Adapted adapt_together(const Case& c, const std::filesystem::path& folder);

}  // namespace octetra::properties
