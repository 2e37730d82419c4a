#pragma once

#include <string>
#include <vector>

#include <octetra/reference/history.hpp>

#include "properties/case.hpp"

namespace octetra::properties {

/// The mesh after a step of a history.
struct Stage {
    Mesh mesh;
    bool changed = false;
    std::string refusal;  ///< the words, if the step was refused: the mesh is as it was
};

/// The history of a case as the reference sees it. Of each step:
struct ReferenceHistory {
    std::vector<Stage> stages;
    std::vector<reference::History> before;
    std::vector<reference::CellMarks> marked;  ///< cells that were to be refined, or may go
    std::vector<RefinementMaps> maps;          ///< of the mesh after it, from its input
};

[[nodiscard]] ReferenceHistory adapted_by_reference(const Case& c);

}  // namespace octetra::properties
