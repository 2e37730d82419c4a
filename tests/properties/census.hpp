#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/combinations.hpp"

/// Counts which combinations (combinations.hpp) worlds of one complex have.
namespace octetra::properties {

struct Census {
    Complex complex;
    bool is_full = false;               ///< Are combinations of the third kind counted?
    std::vector<OrderClasses> classes;  ///< of each cell
    std::vector<std::vector<std::size_t>> symmetries;      ///< of the complex, up to about 1000
    std::array<std::unordered_set<std::uint64_t>, 3> met;  ///< of each kind, as numbers
};

[[nodiscard]] Census empty_census(const Complex& complex, bool is_full);

/// Does the complex with these corners have a combination that was not met? No if edges of a cell
/// tie.
[[nodiscard]] bool has_new(const Census& census, const std::vector<Point>& points);

/// Notes what a world without ties has, and what those have that differ from it by a symmetry.
void note(Census& census, const std::vector<Point>& points);

/// How many were met of each kind.
[[nodiscard]] CombinationCounts counts(const Census& census);

}  // namespace octetra::properties
