#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

/// Where the cells of a process have come from, as the Adaptations of its steps tell: to hold them
/// against one another.
namespace octetra::properties {

struct Past {
    std::uint64_t root = 0;  ///< cell of the input
    /// How often the root was halved for the cells that were cut to make this one, and last for
    /// itself: ascending, from 0.
    std::vector<int> halvings{0};

    friend bool operator==(const Past&, const Past&) = default;
};

/// Of each cell of a process, by local number.
using Pasts = std::vector<Past>;

/// Of a mesh that nothing was done to, whose cells in the order of the input are `input`.
[[nodiscard]] Pasts first_pasts(const distributed::AdaptiveMesh& mesh,
                                const std::vector<CellVertices>& input);

[[nodiscard]] Pasts refined(const Pasts& pasts, const distributed::Adaptation& step);

/// `fault`, if it is empty, gets what the step should not have done to cells that `may_go` marks or
/// does not: one that is not marked is gone, one is back by more than one generation, or cells are
/// not the pieces of what they have become.
[[nodiscard]] Pasts coarsened(const Pasts& pasts, const distributed::Adaptation& step,
                              std::span<const std::uint8_t> may_go, std::string* fault);

/// Collective. Of the cells as they are after they have moved.
[[nodiscard]] Pasts moved(const Pasts& pasts, const distributed::Migration& move);

/// To save with the mesh.
[[nodiscard]] std::vector<distributed::Field> fields_of(const Pasts& pasts);
/// The first two.
[[nodiscard]] Pasts pasts_of(const std::vector<distributed::Field>& fields);

}  // namespace octetra::properties
