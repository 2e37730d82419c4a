#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace octetra::cli {

/// The `count` finite numbers of "1,2.5,-3". `option` and `form` are for the InputError that
/// anything else gets, as in `--sphere X,Y,Z,R`.
[[nodiscard]] std::vector<double> parse_reals(const std::string& text, std::size_t count,
                                              std::string_view option, std::string_view form);

}  // namespace octetra::cli
