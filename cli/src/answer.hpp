#pragma once

namespace octetra::cli {

/// Thrown, on all processes, by a subcommand that has done its work and whose answer is no:
/// the program ends with status 1.
struct AnswerIsNo {};

}  // namespace octetra::cli
