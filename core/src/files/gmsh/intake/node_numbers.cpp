#include "files/gmsh/intake/node_numbers.hpp"

#include <algorithm>

namespace octetra::gmsh {

void NodeNumbers::add_other(std::uint64_t tag) {
    is_consecutive_ = false;
    if (others_.empty()) {
        for (std::uint64_t k = 0; k < count_; ++k) others_.emplace_back(first_ + k, VertexIndex{k});
    }
    others_.emplace_back(tag, VertexIndex{count_});
}

std::optional<NodeNumbers::Repeated> NodeNumbers::complete() {
    if (is_consecutive_) return std::nullopt;
    const auto [least, last] = std::ranges::minmax(others_, {}, &TaggedVertex::first);
    first_ = least.first;
    constexpr std::uint64_t gaps = 4;  // so many table entries per node are no larger than a list
    if (last.first - first_ < gaps * count_) return make_table(last.first);
    std::ranges::sort(others_);
    const auto twice = std::ranges::adjacent_find(others_, {}, &TaggedVertex::first);
    if (twice == others_.end()) return std::nullopt;
    return Repeated{std::next(twice)->second.value(), twice->first};
}

std::optional<NodeNumbers::Repeated> NodeNumbers::make_table(std::uint64_t last) {
    table_.assign(last - first_ + 1, VertexIndex::none());
    for (const auto& [tag, vertex] : others_) {
        VertexIndex& place = table_[tag - first_];
        if (!place.is_none()) return Repeated{vertex.value(), tag};
        place = vertex;
    }
    std::vector<TaggedVertex>().swap(others_);
    return std::nullopt;
}

VertexIndex NodeNumbers::search(std::uint64_t tag) const {
    const auto found = std::ranges::lower_bound(others_, tag, {}, &TaggedVertex::first);
    return found != others_.end() && found->first == tag ? found->second : VertexIndex::none();
}

}  // namespace octetra::gmsh
