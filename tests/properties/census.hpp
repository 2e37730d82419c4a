#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/combinations.hpp"

/// Counts the combinations (combinations.hpp) that occur in worlds of one complex.
namespace octetra::properties {

struct Census {
    Complex complex;
    bool is_full = false;               ///< whether combinations of the third kind are counted
    std::vector<OrderClasses> classes;  ///< indexed by cell
    std::vector<std::vector<std::size_t>> symmetries;      ///< of the complex, at most about 1000
    std::array<std::unordered_set<std::uint64_t>, 3> met;  ///< encoded, for each kind
};

[[nodiscard]] Census empty_census(const Complex& complex, bool is_full);

/// Returns whether the complex with these corners has a combination that has not occurred. False if
/// two edges of a cell tie.
[[nodiscard]] bool has_new(const Census& census, const std::vector<Point>& points);

/// Records the combinations of a world without ties, and of its images under the symmetries.
void note(Census& census, const std::vector<Point>& points);

/// The number of recorded combinations of each kind.
[[nodiscard]] CombinationCounts counts(const Census& census);

}  // namespace octetra::properties
