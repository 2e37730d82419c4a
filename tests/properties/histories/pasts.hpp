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

struct Past {
    std::uint64_t root = 0;  ///< cell of the input
    /// For each ancestor of the cell, and last for the cell, the number of halvings from the root:
    /// ascending, from 0.
    std::vector<int> halvings{0};

    friend bool operator==(const Past&, const Past&) = default;
};

/// For each cell of a process, by local index.
using Pasts = std::vector<Past>;

/// The pasts of a mesh to which no step has been applied; `input` lists the cells in the order of
/// the input.
[[nodiscard]] Pasts first_pasts(const distributed::AdaptiveMesh& mesh,
                                const std::vector<CellVertices>& input);

[[nodiscard]] Pasts refined(const Pasts& pasts, const distributed::Adaptation& step);

/// Sets `fault`, if it is empty, where the step contradicts `may_go`: an unmarked cell is gone, a
/// cell was coarsened by more than one generation, or cells are not descendants of the cell they
/// became.
[[nodiscard]] Pasts coarsened(const Pasts& pasts, const distributed::Adaptation& step,
                              std::span<const std::uint8_t> may_go, std::string* fault);

/// Collective. The pasts of the cells after migration.
[[nodiscard]] Pasts moved(const Pasts& pasts, const distributed::Migration& move);

/// Fields to be saved with the mesh.
[[nodiscard]] std::vector<distributed::Field> fields_of(const Pasts& pasts);
/// The inverse of fields_of(), from the first two fields.
[[nodiscard]] Pasts pasts_of(const std::vector<distributed::Field>& fields);

}  // namespace octetra::properties
