#pragma once

#include <string>
#include <variant>

#include <octetra/core/closure.hpp>
#include <octetra/core/selection.hpp>

#include "commands/coarsening_options.hpp"
#include "commands/refinement_options.hpp"

/// Steps that can be applied to a mesh with a history.
namespace octetra::cli {

struct RefineStep {
    RefinementOptions typed;
    Selection selection;  ///< without the cell list, which needs the mesh at that step
    Scheme scheme = Scheme::eight;
    Closure closure = Closure::longest_edge;
};

struct CoarsenStep {
    CoarseningOptions typed;
    Selection selection;  ///< as above
};

struct WriteStep {
    std::string path;
};

struct RebalanceStep {};

using Step = std::variant<RefineStep, CoarsenStep, RebalanceStep, WriteStep>;

}  // namespace octetra::cli
