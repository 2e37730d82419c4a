#pragma once

namespace octetra::cli {

/// Thrown on all processes by a subcommand that completed with a negative answer: the program ends
/// with status 1.
struct NegativeAnswer {};

}  // namespace octetra::cli
