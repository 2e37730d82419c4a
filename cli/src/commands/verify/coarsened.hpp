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

/// Judges the mesh `after`, which is called so. Not collective: this process reads the checkpoint.
/// Throws InputError.
[[nodiscard]] verify::Verdict judge_coarsened(const Coarsened& asked, const Mesh& after,
                                              const std::string& name,
                                              const verify::VerifyOptions& options,
                                              JudgedFiles& judged);

}  // namespace octetra::cli
