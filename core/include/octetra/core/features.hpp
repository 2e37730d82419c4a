#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

/// Features of entities that Medit files record for remeshers such as Mmg: corners and ridges of
/// the geometry, and entities that remeshing must keep.
namespace octetra {

enum class Feature : std::uint8_t {
    corners,
    required_vertices,
    ridges,
    required_edges,
    required_facets,
    required_cells,
};
inline constexpr std::size_t feature_count = 6;
inline constexpr std::array<Feature, feature_count> all_features{
    Feature::corners,        Feature::required_vertices, Feature::ridges,
    Feature::required_edges, Feature::required_facets,   Feature::required_cells};

/// Dimension of the entities that can have the feature: 0 vertices, 1 tagged edges, 2 tagged
/// facets, 3 cells.
[[nodiscard]] constexpr std::size_t dimension_of(Feature feature) {
    constexpr std::array<std::size_t, feature_count> dimensions{0, 0, 1, 1, 2, 3};
    return dimensions.at(static_cast<std::size_t>(feature));
}

/// Returns "corners", "required vertices" ...
[[nodiscard]] constexpr std::string_view name_of(Feature feature) {
    constexpr std::array<std::string_view, feature_count> names{
        "corners",        "required vertices", "ridges",
        "required edges", "required facets",   "required cells"};
    return names.at(static_cast<std::size_t>(feature));
}

/// An array with one element for each feature.
template <class T>
class PerFeature {
public:
    [[nodiscard]] T& operator[](Feature f) { return values_.at(static_cast<std::size_t>(f)); }
    [[nodiscard]] const T& operator[](Feature f) const {
        return values_.at(static_cast<std::size_t>(f));
    }
    [[nodiscard]] auto begin() const { return values_.begin(); }
    [[nodiscard]] auto end() const { return values_.end(); }

    friend bool operator==(const PerFeature&, const PerFeature&) = default;

private:
    std::array<T, feature_count> values_{};
};

/// The numbers, from 0, of the entities that have each feature.
using FeatureLists = PerFeature<std::vector<std::uint64_t>>;
/// The number of entities that have each feature.
using FeatureCounts = PerFeature<std::uint64_t>;

[[nodiscard]] inline bool has_any(const FeatureLists& lists) {
    return std::ranges::any_of(lists, [](const auto& list) { return !list.empty(); });
}
[[nodiscard]] inline bool has_any(const FeatureCounts& counts) {
    return std::ranges::any_of(counts, [](std::uint64_t count) { return count > 0; });
}

/// Sorts the numbers and removes duplicates.
inline void sort_unique(std::vector<std::uint64_t>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Feature lists shared by several meshes. Copying allocates no memory, so no process can fail in
/// the middle of a collective step.
using SharedFeatures = std::shared_ptr<const FeatureLists>;

}  // namespace octetra
