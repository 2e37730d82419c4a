#pragma once

#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/case.hpp"

/// Holds small worlds against the law that both engines do the same, and the verifier finds it
/// right. On the first rank, within lead(). A fault is shrunk, kept, and fails the test.
namespace octetra::properties {

/// Of how many worlds one is tried; under sanitizers fewer.
constexpr std::size_t stride = OCTETRA_SMALL_WORLDS_STRIDE;

void expect_equality(const Case& c);

/// Worlds of as many cells each: for each scheme and each choice of cells, which is a set of bits,
/// all worlds at once. Neighbours in a world are on different ranks.
void expect_equality_of_all(const std::string& kind, const std::vector<Mesh>& worlds,
                            const std::vector<unsigned>& choices);

/// All sets of so many cells but the empty one.
[[nodiscard]] std::vector<unsigned> all_choices(std::size_t cells);

}  // namespace octetra::properties
