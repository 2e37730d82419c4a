#include "parameters.hpp"

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/index.hpp>

#include "regular_cell.hpp"

namespace octetra::generator {

void check_length(double length, std::string_view name) {
    constexpr double shortest = 1e-30;
    constexpr double longest = 1e30;
    if (length >= shortest && length <= longest) return;
    throw InputError(fmt::format("{} should be a length from {:g} to {:g}, not {}", name, shortest,
                                 longest, length));
}

void check_count(std::uint64_t count, std::uint64_t least, std::uint64_t most,
                 std::string_view name) {
    if (count >= least && count <= most) return;
    throw InputError(fmt::format("{} should be from {} to {}, not {}", name, least, most, count));
}

void check_numberable(double count, std::string_view what) {
    if (count < VertexIndex::limit) return;
    throw InputError(fmt::format("this mesh would have {:.0f} {}; at most {} can be numbered",
                                 count, what, VertexIndex::limit - 1));
}

void check_cell_estimate(double volume, double edge_length) {
    constexpr double most = 1e8;
    const double estimate = volume / regular_cell_volume(edge_length);
    if (estimate <= most) return;
    throw InputError(fmt::format(
        "this solid would take about {:.2g} cells; lengths that differ less make fewer, "
        "and at most {:.0g} are allowed",
        estimate, most));
}

}  // namespace octetra::generator
