#pragma once

#include <octetra/reference/history.hpp>

#include "distributed/world.hpp"

namespace octetra::test {

/// The steps of the reference, made by the first process alone; other processes have only the
/// input.
class ReferenceSteps {
public:
    explicit ReferenceSteps(const Mesh& input) : history_{input, {}} { update(); }

    void refine(const Selection& selection, Scheme scheme = Scheme::eight) {
        if (!world().is_first()) return;
        history_ = reference::refined(history_, marked_cells(present_, selection), scheme);
        update();
    }
    void refine_regularly(const Selection& selection) {
        if (!world().is_first()) return;
        history_ = reference::refined_regularly(history_, marked_cells(present_, selection));
        update();
    }
    void coarsen(const Selection& selection, Closure closure = Closure::longest_edge) {
        if (!world().is_first()) return;
        history_ = reference::coarsened(history_, marked_cells(present_, selection), closure);
        update();
    }

    [[nodiscard]] const Mesh& mesh() const { return present_.mesh; }
    [[nodiscard]] const reference::History& history() const { return history_; }

private:
    void update() { present_ = reference::replay(history_).back(); }

    reference::History history_;
    reference::Refinement present_;
};

}  // namespace octetra::test
