#pragma once

#include <string_view>

#include "script/read_script.hpp"

namespace octetra::cli {

/// The step that a line of a script says. Throws InputError, without the line's number.
[[nodiscard]] ScriptStep parse_step(std::string_view line);

}  // namespace octetra::cli
