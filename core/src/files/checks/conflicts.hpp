#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <octetra/core/mesh.hpp>
#include <octetra/core/repeated_cells.hpp>

#include "files/checks/tagged_entities.hpp"

/// Error messages for entries of a file that contradict earlier ones.
namespace octetra {

/// Returns the line of an entry, counted from 0, if it is known.
using LineOf = std::function<std::optional<std::uint64_t>(std::uint64_t entry)>;

[[nodiscard]] std::string describe_repeated(const CellPair& cells, const Mesh& mesh,
                                            const LineOf& line_of);

[[nodiscard]] std::string describe_overlap(const WrongFacets& wrong, const Mesh& mesh,
                                           const LineOf& line_of);

/// Describes a facet or an edge, which the file calls `name`.
template <class I>
[[nodiscard]] std::string describe_wrong(const WrongEntry<I>& wrong, std::string_view name,
                                         const IndexVector<I, Marker>& markers, const Mesh& mesh,
                                         const LineOf& line_of);

}  // namespace octetra
