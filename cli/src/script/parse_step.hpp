#pragma once

#include <string_view>

#include "script/read_script.hpp"

namespace octetra::cli {

/// Parses a line of a script. Throws InputError, without the line number.
[[nodiscard]] ScriptStep parse_step(std::string_view line);

}  // namespace octetra::cli
