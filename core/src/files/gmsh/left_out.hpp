#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "files/gmsh/element_types.hpp"

namespace octetra::gmsh {

/// How much of a file is not kept.
struct LeftOut {
    std::array<std::uint64_t, shape_count> of_shape{};  ///< elements that a mesh has not
    std::uint64_t interfaces = 0;                       ///< elements between partitions
    std::uint64_t degenerate_lines = 0;                 ///< lines of one node twice
    std::uint64_t names = 0;
    std::uint64_t in_another_group = 0;     ///< elements that are listed again
    std::uint64_t of_missing_entities = 0;  ///< elements whose groups are not known

    void add(Shape shape, std::uint64_t count) {
        of_shape[static_cast<std::size_t>(shape)] += count;
    }
};

/// The reason to refuse a file without cells, which depends on the elements it has; empty if it has
/// cells.
[[nodiscard]] std::string wrong_without_cells(std::uint64_t cells, std::uint64_t facets,
                                              const LeftOut& left_out);

/// Tells of it in sentences about the file `path`.
void tell(const LeftOut& left_out, const std::string& path,
          const std::function<void(const std::string&)>& note);

/// What is told of entities that are in several groups, if there are any.
void tell_of_entities(std::uint64_t in_several, const std::string& path,
                      const std::function<void(const std::string&)>& note);

}  // namespace octetra::gmsh
