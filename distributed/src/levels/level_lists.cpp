#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/levels.hpp>

#include "history/families.hpp"
#include "levels/level_data.hpp"

namespace octetra::distributed {
namespace {

/// A list (of cells, tagged facets or edges) after some steps, in canonical order.
template <class I, std::size_t N>
struct ListAfterSteps {
    IndexVector<I, std::array<VertexIndex, N>> list;
    std::vector<std::uint32_t> first{0};  ///< as in AncestorMap
    /// For each entity of the list after more steps, the entity that contains it, and the number of
    /// bisections that separate it from that entity.
    std::vector<std::uint32_t> coarse_of;
    std::vector<std::uint8_t> halvings;
};

/// Reverses all steps after the first `step_count` ones in one pass over the list that they made.
template <class I, std::size_t N>
class StepReversal {
public:
    using Vertices = std::array<VertexIndex, N>;

    StepReversal(const VertexLevels& steps, std::size_t step_count)
        : steps_(&steps), step_count_(step_count), families_(steps) {}

    [[nodiscard]] ListAfterSteps<I, N> run(const IndexVector<I, Vertices>& list) {
        result_.coarse_of.reserve(list.size());
        result_.halvings.reserve(list.size());
        const auto on_parent = [&](std::uint32_t level, const Vertices& parent,
                                   std::span<const Member> members) {
            if (level > step_count_) merge(level, parent, members);
            return members[0].note;
        };
        const auto on_root = [&](auto&&...) { result_.first.push_back(end()); };
        for (const Vertices& vertices : list) {
            // The entities of one family are contiguous, so each belongs to the next one appended.
            const First here{static_cast<std::uint32_t>(result_.coarse_of.size())};
            result_.coarse_of.push_back(end());
            result_.halvings.push_back(0);
            append_if_present(vertices);
            families_.add(vertices, here, on_parent, on_root);
        }
        return std::move(result_);
    }

private:
    /// The first descendant in the given list.
    struct First {
        std::uint32_t index = 0;
    };
    using Member = typename Families<N, First>::Member;

    [[nodiscard]] std::uint32_t end() const { return result_.list.end_index().value(); }
    void append_if_present(const Vertices& vertices) {
        if (steps_->newest(vertices) <= step_count_) result_.list.push_back(vertices);
    }
    void merge(std::uint32_t level, const Vertices& parent, std::span<const Member> members) {
        const VertexIndex first_new = steps_->begin(level);
        for (std::size_t k = 0; k < members.size(); ++k) {
            const auto bisections = static_cast<std::uint8_t>(std::ranges::count_if(
                members[k].vertices, [&](VertexIndex v) { return v >= first_new; }));
            const std::size_t last =
                k + 1 < members.size() ? members[k + 1].note.index : result_.halvings.size();
            for (std::size_t i = members[k].note.index; i < last; ++i) {
                result_.halvings[i] = static_cast<std::uint8_t>(result_.halvings[i] + bisections);
            }
        }
        append_if_present(parent);
    }

    const VertexLevels* steps_;
    std::size_t step_count_;
    Families<N, First> families_;
    ListAfterSteps<I, N> result_;
};

template <class I, std::size_t N>
ListAfterSteps<I, N> after_steps(const IndexVector<I, std::array<VertexIndex, N>>& list,
                                 const VertexLevels& steps, std::size_t step_count) {
    return StepReversal<I, N>(steps, step_count).run(list);
}

/// Returns the marker of each entity; entities first[r] .. first[r + 1] - 1 descend from root r.
std::vector<Marker> markers_of(std::span<const Marker> of_roots,
                               std::span<const std::uint32_t> first) {
    std::vector<Marker> markers;
    if (of_roots.empty()) return markers;
    markers.reserve(first.back());
    for (std::size_t r = 0; r < of_roots.size(); ++r) {
        markers.insert(markers.end(), first[r + 1] - first[r], of_roots[r]);
    }
    return markers;
}

/// Converts values in canonical order to the order of the numbers `before`, if there are any.
template <class Values, class I>
void to_order_before(Values& values, const std::vector<I>& before) {
    if (before.empty() || values.empty()) return;
    const Values ordered = values;
    for (std::size_t k = 0; k < before.size(); ++k) {
        values.data()[before[k].value()] = ordered.data()[k];
    }
}

}  // namespace

LevelLists Levels::lists(std::size_t level) const {
    const DistributedMesh& finest = data_->finest;
    const std::size_t step = data_->at(level).step;
    LevelLists lists;
    const auto take = [&](const auto& list, const AncestorMap& ancestors, auto& to,
                          std::vector<Marker>& markers) {
        auto coarser = after_steps(list, data_->steps(), step);
        markers = markers_of(ancestors.markers, coarser.first);
        to = std::move(coarser.list);
    };
    take(finest.cells, finest.cell_ancestors, lists.cells, lists.regions);
    take(finest.facets, finest.facet_ancestors, lists.facets, lists.facet_markers);
    take(finest.edges, finest.edge_ancestors, lists.edges, lists.edge_markers);
    if (level + 1 == count()) {
        to_order_before(lists.cells, data_->cells_before);
        to_order_before(lists.regions, data_->cells_before);
        to_order_before(lists.facets, data_->facets_before);
        to_order_before(lists.facet_markers, data_->facets_before);
        to_order_before(lists.edges, data_->edges_before);
        to_order_before(lists.edge_markers, data_->edges_before);
    }
    return lists;
}

LevelParents Levels::parents(std::size_t level) const {
    if (level == 0) throw InputError("level 0: the cells of the coarsest level have no parents");
    const VertexLevels steps = data_->steps();
    const auto here = after_steps(data_->finest.cells, steps, data_->at(level).step);
    auto coarser = after_steps(here.list, steps, data_->at(level - 1).step);
    LevelParents result;
    for (const std::uint32_t parent : coarser.coarse_of) result.parents.emplace_back(parent);
    result.halvings = std::move(coarser.halvings);
    if (level + 1 == count()) {
        to_order_before(result.parents, data_->cells_before);
        to_order_before(result.halvings, data_->cells_before);
    }
    return result;
}

}  // namespace octetra::distributed
