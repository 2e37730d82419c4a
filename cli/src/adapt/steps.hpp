#pragma once

#include <optional>
#include <string>
#include <variant>

#include <octetra/core/closure.hpp>
#include <octetra/core/expression.hpp>
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

struct FitStep {
    RefinementOptions typed;  ///< of its selection, only --size
    Expression size;
    Scheme scheme = Scheme::eight;
    Closure closure = Closure::longest_edge;
};

struct WriteStep {
    std::string path;
};

struct RebalanceStep {};

using Step = std::variant<RefineStep, CoarsenStep, FitStep, RebalanceStep, WriteStep>;

/// Returns the closure by which a step refines, or nothing if it does not refine.
[[nodiscard]] inline std::optional<Closure> closure_of(const Step& step) {
    if (const auto* refine = std::get_if<RefineStep>(&step)) return refine->closure;
    if (const auto* fit = std::get_if<FitStep>(&step)) return fit->closure;
    return std::nullopt;
}

}  // namespace octetra::cli
