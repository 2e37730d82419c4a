#pragma once

#include <cstdint>
#include <string_view>

/// Refusals of bad parameters: each throws InputError with a sentence that says what is allowed.
namespace octetra::generator {

/// A length should be from 1e-30 to 1e30: neither its cube nor a product of five underflows then.
void check_length(double length, std::string_view name);

/// A count should be from `least` to `most`.
void check_count(std::uint64_t count, std::uint64_t least, std::uint64_t most,
                 std::string_view name);

/// 32 bits should number this many entities. (A double, since it may be too much for 64 bits; it is
/// exact where that matters.)
void check_numberable(double count, std::string_view what);

/// A solid of this volume should not take too many cells whose edges have this length.
void check_cell_estimate(double volume, double edge_length);

}  // namespace octetra::generator
