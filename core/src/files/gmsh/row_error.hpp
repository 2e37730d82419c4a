#pragma once

#include <cstddef>
#include <string_view>

namespace octetra::gmsh {

/// The first erroneous row of a batch.
struct RowError {
    std::size_t row = 0;
    std::string_view what;  ///< empty if no row is erroneous
};

}  // namespace octetra::gmsh
