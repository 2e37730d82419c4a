#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

/// The ancestry of the cells of a process, as reported by the Adaptations of its steps, to be
/// checked for consistency.
namespace octetra::properties {

struct Ancestry {
    std::uint64_t root = 0;  ///< cell of the input
    /// For each ancestor of the cell, and last for the cell, the number of halvings from the root:
    /// ascending, from 0. With Closure::regular, the ancestors are the regular cells.
    std::vector<int> halvings{0};

    friend bool operator==(const Ancestry&, const Ancestry&) = default;
};

/// For each cell of a process, by local index.
using Ancestries = std::vector<Ancestry>;

/// The ancestries of a mesh to which no step has been applied; `input` lists the cells in the order
/// of the input.
[[nodiscard]] Ancestries initial_ancestries(const distributed::AdaptiveMesh& mesh,
                                            const std::vector<CellVertices>& input);

[[nodiscard]] Ancestries refined(const Ancestries& ancestries, const distributed::Adaptation& step,
                                 Closure closure);

/// Sets `fault`, if it is empty, where the step contradicts `may_coarsen`: an unmarked cell is
/// gone, a cell was coarsened by more than one generation, or cells are not descendants of the cell
/// they became.
[[nodiscard]] Ancestries coarsened(const Ancestries& ancestries,
                                   const distributed::Adaptation& step,
                                   std::span<const std::uint8_t> may_coarsen, std::string* fault);

/// Collective. The ancestries of the cells after migration.
[[nodiscard]] Ancestries moved(const Ancestries& ancestries, const distributed::Migration& move);

/// Fields to be saved with the mesh.
[[nodiscard]] std::vector<distributed::Field> fields_of(const Ancestries& ancestries);
/// The inverse of fields_of(), from the first two fields.
[[nodiscard]] Ancestries ancestries_of(const std::vector<distributed::Field>& fields);

}  // namespace octetra::properties
