#pragma once

#include <filesystem>
#include <string>

#include "properties/case_files.hpp"

namespace octetra::properties {

/// "LAW-DIGITS": the digits follow from the case.
[[nodiscard]] std::string name_of(const Finding& finding);

/// "24 cells", "1 cell".
[[nodiscard]] std::string counted(std::size_t count, const std::string& what);

/// How large a case is, in words.
[[nodiscard]] std::string size_of(const Case& c);

/// What to print of a finding in this `.json` file: the law, the fault and a line that replays it
/// on as many ranks.
[[nodiscard]] std::string description(const Finding& finding, const std::filesystem::path& file);

/// Writes it to the folder under that name, and says what to print.
[[nodiscard]] std::string kept(const Finding& finding, const std::filesystem::path& folder);

}  // namespace octetra::properties
