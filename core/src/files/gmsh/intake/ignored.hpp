#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include <octetra/core/process_group.hpp>

#include "files/gmsh/element_types.hpp"

namespace octetra::gmsh {

/// Counts of the parts of a file that are ignored.
struct IgnoredContent {
    std::array<std::uint64_t, shape_count> of_shape{};  ///< elements of unsupported shapes
    std::uint64_t interfaces = 0;                       ///< elements between partitions
    std::uint64_t degenerate_lines = 0;                 ///< lines with a repeated node
    std::uint64_t names = 0;
    std::uint64_t in_another_group = 0;     ///< elements repeated for another group
    std::uint64_t of_missing_entities = 0;  ///< elements whose groups are not known

    void add(Shape shape, std::uint64_t count) {
        of_shape[static_cast<std::size_t>(shape)] += count;
    }
    /// Collective. Adds up the counts of elements of all processes; names are equal on all.
    void add_up(const ProcessGroup& group);
};

/// Returns the error message for a file without cells, depending on the elements that it has; empty
/// if it has cells.
[[nodiscard]] std::string error_without_cells(std::uint64_t cells, std::uint64_t facets,
                                              const IgnoredContent& ignored);

/// Calls note() with sentences on these counts for the file `path`.
void note_ignored(const IgnoredContent& ignored, const std::string& path,
                  const std::function<void(const std::string&)>& note);

/// Calls note() with a sentence on entities that are in several groups, if there are any.
void note_entities_in_several_groups(std::uint64_t in_several, const std::string& path,
                                     const std::function<void(const std::string&)>& note);

}  // namespace octetra::gmsh
