#pragma once

#include <string>

#include "verdict/print_verdict.hpp"

namespace octetra::cli {

/// Returns "coarse cell 17", "face (3 5 9)" ..., with the numbers of the files.
[[nodiscard]] std::string describe(const verify::Entity& entity, const JudgedFiles& judged);

/// Returns the number of the first vertex, cell ... in the file whose numbers identify the entity.
[[nodiscard]] std::uint64_t first_number(const verify::Entity& entity, const JudgedFiles& judged);

/// Returns the word for its kind in reports.
[[nodiscard]] std::string_view kind_of(const verify::Entity& entity);

[[nodiscard]] std::string_view word_of(verify::Status status);

}  // namespace octetra::cli
