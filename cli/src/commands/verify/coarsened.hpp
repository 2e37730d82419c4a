#pragma once

#include <string>

#include <octetra/core/selection.hpp>
#include <octetra/verify/verify_coarsening.hpp>

#include "commands/coarsening_options.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {

/// The options of octetra verify --coarsened-from.
struct Coarsened {
    std::string before;  ///< the checkpoint; empty if not requested
    CoarseningOptions typed;
    Selection selection;  ///< without the cell list, which needs the checkpoint
};

/// Verifies the mesh `after`, called `name` in messages. Not collective: this process reads the
/// checkpoint. Throws InputError.
[[nodiscard]] verify::Verdict judge_coarsened(const Coarsened& asked, const Mesh& after,
                                              const std::string& name,
                                              const verify::VerifyOptions& options,
                                              JudgedFiles& judged);

}  // namespace octetra::cli
