#pragma once

#include <nlohmann/json.hpp>

#include "properties/case.hpp"

namespace octetra::properties {

/// The whole case except its mesh. Numbers are written with full precision.
[[nodiscard]] nlohmann::json json_of(const Case& c);

/// The inverse of json_of(). Throws nlohmann::json::exception if an entry is missing or has another
/// type.
[[nodiscard]] Case case_of(const nlohmann::json& json);

}  // namespace octetra::properties
