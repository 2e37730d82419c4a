#pragma once

#include <vector>

#include "lookup/box_tree.hpp"

namespace octetra::verify {

/// The views of all processes, as boxes, which may be empty; determines which process needs an
/// entity.
class Views {
public:
    explicit Views(const std::vector<Bounds>& views) : tree_(not_empty(views)) {
        for (std::size_t r = 0; r < views.size(); ++r) {
            if (!is_empty(views[r])) ranks_.push_back(r);
        }
    }

    /// Calls visit(rank) for each process whose view meets the box.
    void for_each_meeting(const Bounds& box, auto&& visit) const {
        tree_.for_each_meeting(box, [&](std::uint32_t i) { visit(ranks_[i]); });
    }

private:
    static bool is_empty(const Bounds& box) { return box.low[0] > box.high[0]; }
    static std::vector<Bounds> not_empty(std::vector<Bounds> views) {
        std::erase_if(views, is_empty);
        return views;
    }

    BoxTree tree_;
    std::vector<std::size_t> ranks_;
};

}  // namespace octetra::verify
