#include "level/rounding_failure.hpp"

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::distributed {

void RoundingFailure::agree(const DistributedMesh& mesh, int level) const {
    // Computes the minimum by means of a maximum.
    const std::uint64_t first = none - mesh.processes.max(none - code_);
    if (first == none) return;
    throw InputError(fmt::format(
        "cell {}, level {}: bisection would make a child that is {}, because its midpoints "
        "cannot be rounded to double precision well enough; the cell is too small for its "
        "coordinates, or these are too large to be added",
        first / 2 + mesh.index_base, level, first % 2 == 1 ? "inverted" : "flat"));
}

}  // namespace octetra::distributed
