#pragma once

#include <cstddef>
#include <string_view>

namespace octetra::gmsh {

/// The first of some rows that something is wrong with.
struct WrongRow {
    std::size_t row = 0;
    std::string_view what;  ///< empty: nothing is wrong with any
};

}  // namespace octetra::gmsh
