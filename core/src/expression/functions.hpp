#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

namespace octetra::expression {

/// A function of numbers that an expression may call.
struct Function {
    std::string_view name;
    std::size_t least;  ///< number of arguments
    std::size_t most;
};

inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
inline constexpr std::array<Function, 17> functions{{{"abs", 1, 1},
                                                     {"acos", 1, 1},
                                                     {"asin", 1, 1},
                                                     {"atan", 1, 1},
                                                     {"atan2", 2, 2},
                                                     {"ceil", 1, 1},
                                                     {"cos", 1, 1},
                                                     {"exp", 1, 1},
                                                     {"floor", 1, 1},
                                                     {"hypot", 2, 2},
                                                     {"log", 1, 1},
                                                     {"log10", 1, 1},
                                                     {"max", 2, any_number},
                                                     {"min", 2, any_number},
                                                     {"sin", 1, 1},
                                                     {"sqrt", 1, 1},
                                                     {"tan", 1, 1}}};

}  // namespace octetra::expression
