#pragma once

#include <string>

#include "properties/case_files.hpp"

namespace octetra::properties {

/// Writes a finding to found_folder(), under a name that its content decides. What to print: the
/// law, the fault and a line that replays it on as many ranks.
[[nodiscard]] std::string kept(const Finding& finding);

/// The smallest case that simplifications lead to and that still breaks the law. For cases that
/// rapidcheck has not drawn, and so does not shrink.
[[nodiscard]] Finding shrunk(Finding finding);

}  // namespace octetra::properties
