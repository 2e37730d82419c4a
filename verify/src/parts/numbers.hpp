#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::verify {

/// The numbers in the whole mesh of the entities of a part: ascending, so that parts and the whole
/// mesh have the same order. An empty list represents consecutive numbers from `first`.
struct NumberList {
    std::vector<std::uint32_t> numbers{};
    std::uint32_t first = 0;

    [[nodiscard]] std::uint32_t of(std::uint32_t local) const {
        return numbers.empty() ? first + local : numbers[local];
    }

    /// Returns the entity of the part with this number in the whole mesh, or none().
    [[nodiscard]] VertexIndex find(std::uint32_t number) const {
        if (numbers.empty()) return VertexIndex{number - first};
        const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
        if (found == numbers.end() || *found != number) return VertexIndex::none();
        return VertexIndex{static_cast<std::size_t>(found - numbers.begin())};
    }
};

struct Numbers {
    NumberList vertices;
    NumberList cells;
    NumberList facets;
    NumberList edges;

    [[nodiscard]] VertexIndex of(VertexIndex v) const {
        return v.is_none() ? v : VertexIndex{vertices.of(v.value())};
    }
    [[nodiscard]] CellIndex of(CellIndex c) const {
        return c.is_none() ? c : CellIndex{cells.of(c.value())};
    }
};

}  // namespace octetra::verify
