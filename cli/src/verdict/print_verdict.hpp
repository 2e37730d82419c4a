#pragma once

#include <string>

#include <octetra/verify/compare.hpp>
#include <octetra/verify/verify.hpp>

namespace octetra::cli {

/// The files verified: names for messages, and their index bases.
struct JudgedFiles {
    std::string fine;    ///< path
    std::string coarse;  ///< path; empty if a single mesh was verified
    std::uint32_t fine_index_base = 0;
    std::uint32_t coarse_index_base = 0;
    /// The mesh was verified as a coarsening of that in `coarse`, the input of which is the coarse
    /// mesh.
    bool is_coarsened = false;
};

/// Prints a summary to stdout: checks, violations (the first ones of each kind), facts, the answer.
void print_verdict(const verify::Verdict& verdict, const JudgedFiles& judged);

/// Returns the complete verdict as JSON, in the schema described in docs/verify.md.
[[nodiscard]] std::string format_json(const verify::Verdict& verdict, const JudgedFiles& judged);

/// Prints the first differences and the answer to stdout.
void print_comparison(const verify::Comparison& comparison, const std::string& a,
                      const std::string& b);

}  // namespace octetra::cli
