#pragma once

#include <nlohmann/json.hpp>

#include "properties/case.hpp"

namespace octetra::properties {

/// All of a case but its mesh. Numbers keep every bit.
[[nodiscard]] nlohmann::json json_of(const Case& c);

/// The way back. Throws nlohmann::json::exception where something is missing or of another type.
[[nodiscard]] Case case_of(const nlohmann::json& json);

}  // namespace octetra::properties
