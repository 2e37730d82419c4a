#include "regular/children.hpp"

#include <algorithm>

#include "level/incremental/adjacency.hpp"

namespace octetra::distributed {

Children::Children(const DistributedMesh& mesh, const EntityTransfer& level)
    : mesh_(&mesh), keeps_numbers_(level.keeps_numbers()) {
    if (!keeps_numbers_) {
        first_.assign(level.count_before() + 1, 0);
        level.for_each_new([&](std::size_t number, std::size_t before, unsigned) {
            first_[before + 1] = static_cast<std::uint32_t>(number + 1);
        });
        return;
    }
    level.for_each_new([&](std::size_t, std::size_t before, unsigned) {
        if (counts_.empty() || counts_.back().first != CellIndex{before}) {
            counts_.emplace_back(before, 0U);
        }
        ++counts_.back().second;
    });
    std::ranges::sort(counts_);
}

std::size_t Children::count_of(CellIndex before) const {
    if (!keeps_numbers_) {
        return std::size_t{first_[before.value() + std::size_t{1}]} - first_[before.value()];
    }
    const auto found =
        std::ranges::lower_bound(counts_, before, {}, &std::pair<CellIndex, std::uint32_t>::first);
    return found != counts_.end() && found->first == before ? found->second : 1;
}

void Children::append_of(CellIndex before, CellRun& run) const {
    CellIndex child = same(before);
    for (std::size_t k = count_of(before); k > 0; --k) {
        run.append(child);
        child = next_cell(*mesh_, child);
    }
}

}  // namespace octetra::distributed
