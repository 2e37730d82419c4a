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
    std::string refusal;  ///< the message, if the step was refused; the mesh is then unchanged
};

/// The history of a case as made by the reference. Each vector is indexed by step.
struct ReferenceHistory {
    std::vector<Stage> stages;
    std::vector<reference::History> before;
    std::vector<reference::CellMarks> marked;  ///< cells to be refined, or to be removed
    std::vector<RefinementMaps> maps;          ///< from the input to the mesh after the step
};

[[nodiscard]] ReferenceHistory adapted_by_reference(const Case& c);

}  // namespace octetra::properties
