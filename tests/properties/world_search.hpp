#pragma once

#include <cstddef>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/combinations.hpp"

/// Finds corners of a complex so that its cells have all combinations of classes of orders, by a
/// random walk: the corners of a previous world are moved at random, by a large or small amount,
/// and a world with a new combination is kept and moved in turn. Draws are the same on all
/// platforms.
namespace octetra::properties {

/// Returns the corners of worlds, each of which has a combination that previous ones do not have.
/// They are whole numbers below 2^20, valid, and without ties within a cell. Ends when `goal` is
/// reached for each kind, or after `patience` successive moves without a new combination.
/// Combinations of the third kind are sought unless their goal is 0.
[[nodiscard]] std::vector<std::vector<Point>> find_worlds(const Complex& complex,
                                                          const CombinationCounts& goal,
                                                          std::size_t patience);

/// Returns whether this is a valid mesh. Also false for some valid meshes whose cells are separated
/// only by planes through four corners or more.
[[nodiscard]] bool is_valid(const std::vector<Point>& points, const Complex& complex);

}  // namespace octetra::properties
