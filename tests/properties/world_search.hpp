#pragma once

#include <cstddef>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/combinations.hpp"

/// Finds corners for a complex so that its cells have all combinations of classes of orders, by
/// wandering: the corners of a world found before are moved at random, by much or by little, and a
/// world that has anything new is kept, and moved in its turn. The same draws everywhere.
namespace octetra::properties {

/// The corners of worlds, each of which has a combination that those before do not have: by whole
/// numbers below 2^20, valid, and without ties within a cell. Ends when so many combinations of
/// each kind were met, or when so many moves in a row brought nothing new. Those of the third kind
/// are looked for unless none is asked for.
[[nodiscard]] std::vector<std::vector<Point>> find_worlds(const Complex& complex,
                                                          const CombinationCounts& goal,
                                                          std::size_t patience);

/// Is this a valid mesh? False also of some whose cells are told apart by no plane but one through
/// four corners or more.
[[nodiscard]] bool is_valid(const std::vector<Point>& points, const Complex& complex);

}  // namespace octetra::properties
