#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <octetra/core/index.hpp>

namespace octetra::verify {

/// What entities of a part are called in the whole mesh: ascending, so that parts and wholes agree
/// about what comes first. An empty list stands for consecutive numbers from `first`.
struct NumberList {
    std::vector<std::uint32_t> numbers{};
    std::uint32_t first = 0;

    [[nodiscard]] std::uint32_t of(std::uint32_t local) const {
        return numbers.empty() ? first + local : numbers[local];
    }

    /// The entity of the part that has this number in the whole mesh; none() if it has none.
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
