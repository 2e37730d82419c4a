#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace octetra::gmsh {

/// The positions of the entries of a list in a file, as line numbers or byte offsets. Memory is
/// proportional to the number of changes of distance between entries.
class PositionRuns {
public:
    /// Adds the next entry; the one after it is expected `step` further on.
    void add(std::uint64_t place, std::uint64_t step) { add(place, step, 1); }
    /// Adds the next `count` entries, `step` apart.
    void add(std::uint64_t place, std::uint64_t step, std::uint64_t count) {
        if (count == 0) return;
        const bool continues =
            !runs_.empty() && place == expected_ && (count == 1 || step == runs_.back().step);
        if (!continues) runs_.push_back({count_, place, step});
        count_ += count;
        expected_ = place + count * runs_.back().step;
    }
    [[nodiscard]] bool empty() const { return runs_.empty(); }
    [[nodiscard]] std::uint64_t of(std::uint64_t entry) const {
        const auto after = std::ranges::upper_bound(runs_, entry, {}, &Run::first_entry);
        const Run& run = *std::prev(after);
        return run.first_place + (entry - run.first_entry) * run.step;
    }

private:
    struct Run {
        std::uint64_t first_entry;
        std::uint64_t first_place;
        std::uint64_t step;
    };
    std::vector<Run> runs_;
    std::uint64_t count_ = 0;
    std::uint64_t expected_ = 0;
};

}  // namespace octetra::gmsh
