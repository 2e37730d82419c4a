#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// A value that an entity of the whole mesh must not have.
struct Fault {
    std::uint64_t number = 0;  ///< of the entity in canonical order
    double value = 0;
};

/// Collective. Returns that of the invalid values of all processes whose entity has the lowest
/// number, the same on all; nothing if is_valid(value) is true for all. `numbers()` returns the
/// numbers of the entities of this process; it is collective, and called if there is a fault.
[[nodiscard]] std::optional<Fault> lowest_fault(const Communicator& processes,
                                                std::span<const double> values, auto&& is_valid,
                                                auto&& numbers) {
    std::vector<std::size_t> faulty;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!is_valid(values[i])) faulty.push_back(i);
    }
    if (processes.max(faulty.size()) == 0) return std::nullopt;
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const std::vector<std::uint64_t> number_of = numbers();
    Fault here{none, 0};
    for (const std::size_t i : faulty) {
        if (number_of[i] < here.number) here = {number_of[i], values[i]};
    }
    const std::uint64_t lowest = none - processes.max(none - here.number);
    const auto rank = static_cast<std::uint64_t>(processes.rank());
    const auto owner = static_cast<int>(processes.max(lowest == here.number ? rank : 0));
    return Fault{lowest, processes.of_rank(owner, here.value)};
}

}  // namespace octetra::distributed
