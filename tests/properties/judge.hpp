#pragma once

#include <string>

#include "properties/case.hpp"
#include "properties/laws.hpp"

namespace octetra::properties {

/// On the first rank, within lead(): what the law says of the case; an exception is a fault, too.
/// The case is on disk meanwhile, as LAW-running. If anything dies or waits for ever, which ends
/// the program after two minutes, it stays there.
[[nodiscard]] std::string judge(const Law& law, const Case& c);

}  // namespace octetra::properties
