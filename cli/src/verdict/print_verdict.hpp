#pragma once

#include <string>

#include <octetra/verify/compare.hpp>
#include <octetra/verify/verify.hpp>

namespace octetra::cli {

/// What was judged: names for people, and how files number the entities.
struct JudgedFiles {
    std::string fine;    ///< path
    std::string coarse;  ///< path; empty if a mesh was judged by itself
    std::uint32_t fine_index_base = 0;
    std::uint32_t coarse_index_base = 0;
    /// The mesh is to be what coarsening leaves of that in `coarse`, whose input is the coarse one.
    bool is_coarsened = false;
};

/// A summary on stdout: checks, what is wrong (the first few of each kind), facts, the answer.
void print_verdict(const verify::Verdict& verdict, const JudgedFiles& judged);

/// The whole as JSON, in the schema that docs/verify.md describes.
[[nodiscard]] std::string format_json(const verify::Verdict& verdict, const JudgedFiles& judged);

/// The first differences and the answer, on stdout.
void print_comparison(const verify::Comparison& comparison, const std::string& a,
                      const std::string& b);

}  // namespace octetra::cli
