#pragma once

#include <cstdint>
#include <string_view>

/// Checks of parameters: each throws InputError with a sentence that states the valid range.
namespace octetra::generator {

/// Checks that a length is from 1e-30 to 1e30, so that neither its cube nor a product of five
/// underflows.
void check_length(double length, std::string_view name);

/// Checks that a count is from `least` to `most`.
void check_count(std::uint64_t count, std::uint64_t least, std::uint64_t most,
                 std::string_view name);

/// Checks that this many entities can be numbered with 32 bits. (A double, because the number may
/// exceed 64 bits; it is exact in the relevant range.)
void check_numberable(double count, std::string_view what);

/// Checks that a solid of this volume does not need too many cells with edges of this length.
void check_cell_estimate(double volume, double edge_length);

}  // namespace octetra::generator
