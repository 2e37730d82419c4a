#pragma once

#include <string>

#include <octetra/core/selection.hpp>
#include <octetra/verify/verify_coarsening.hpp>

#include "commands/coarsening_options.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {

/// What octetra verify --coarsened-from asks of a mesh.
struct Coarsened {
    std::string before;  ///< the checkpoint; empty: nothing is asked
    CoarseningOptions typed;
    Selection selection;  ///< but for the cell list, which the checkpoint is needed for
};

/// Judges the mesh file `after`. Not collective: this process reads both files. Throws InputError.
[[nodiscard]] verify::Verdict judge_coarsened(const Coarsened& asked, const std::string& after,
                                              const verify::VerifyOptions& options,
                                              JudgedFiles& judged);

}  // namespace octetra::cli
