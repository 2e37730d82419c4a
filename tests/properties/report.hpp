#pragma once

#include <filesystem>
#include <string>

#include "properties/case_files.hpp"

namespace octetra::properties {

/// "LAW-DIGITS"; the digits are a hash of the case.
[[nodiscard]] std::string name_of(const Finding& finding);

/// "24 cells", "1 cell".
[[nodiscard]] std::string counted(std::size_t count, const std::string& what);

/// Describes the size of a case.
[[nodiscard]] std::string size_of(const Case& c);

/// The message about a finding in this `.json` file: the law, the fault, and the command that
/// replays it on the same number of ranks.
[[nodiscard]] std::string description(const Finding& finding, const std::filesystem::path& file);

/// Writes the finding to the folder under its name. Returns its description().
[[nodiscard]] std::string kept(const Finding& finding, const std::filesystem::path& folder);

}  // namespace octetra::properties
