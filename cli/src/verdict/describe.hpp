#pragma once

#include <string>

#include "verdict/print_verdict.hpp"

namespace octetra::cli {

/// "coarse cell 17", "face (3 5 9)" ..., by the numbers of the files.
[[nodiscard]] std::string describe(const verify::Entity& entity, const JudgedFiles& judged);

/// What the file that it is numbered by calls the first vertex, cell ...
[[nodiscard]] std::uint64_t first_number(const verify::Entity& entity, const JudgedFiles& judged);

/// The word for its kind, as it stands in reports.
[[nodiscard]] std::string_view kind_of(const verify::Entity& entity);

[[nodiscard]] std::string_view word_of(verify::Status status);

}  // namespace octetra::cli
