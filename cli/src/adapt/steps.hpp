#pragma once

#include <string>
#include <variant>

#include <octetra/core/selection.hpp>

#include "commands/coarsening_options.hpp"
#include "commands/refinement_options.hpp"

/// What can be done to a mesh that knows its history.
namespace octetra::cli {

struct RefineStep {
    RefinementOptions typed;
    Selection selection;  ///< but for the cell list, which the mesh as it then is is needed for
    Scheme scheme = Scheme::eight;
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
