#pragma once

#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/case.hpp"

/// Checks on small worlds that both engines agree and that the verifier accepts the result. On the
/// first rank, within run_on_first_rank(). A fault is shrunk and kept, and fails the test.
namespace octetra::properties {

/// Every n-th world is tested; greater under sanitizers.
constexpr std::size_t stride = OCTETRA_SMALL_WORLDS_STRIDE;

void expect_equality(const Case& c);

/// Worlds with the same number of cells: for each scheme and each choice of cells, a set of bits,
/// tests all worlds at once. Neighbours in a world are on different ranks.
void expect_equality_of_all(const std::string& kind, const std::vector<Mesh>& worlds,
                            const std::vector<unsigned>& choices);

/// All nonempty sets of this number of cells.
[[nodiscard]] std::vector<unsigned> all_choices(std::size_t cells);

}  // namespace octetra::properties
