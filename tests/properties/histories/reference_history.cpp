#include "properties/histories/reference_history.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <octetra/core/error.hpp>

#include "properties/histories/rewriting.hpp"

namespace octetra::properties {
namespace {

using reference::CellMarks;
using reference::History;
using reference::Refinement;

/// The marks of a refinement.
struct MarkedBefore {
    CellMarks cells;
    Scheme scheme = Scheme::eight;
    std::size_t points_before = 0;
};

/// Throws InputError if the mesh would exceed the maximum size; the message begins like that of an
/// engine with this limit.
void check_size(const Refinement& present, const CellMarks& marked, Scheme scheme,
                std::size_t step) {
    Selection selection;
    for (CellIndex c{0}; c < marked.end_index(); ++c) {
        if (marked[c] != 0) selection.cells.push_back(GlobalCell{c.value()});
    }
    try {
        (void)reference::refine(present.mesh, selection, scheme, 1, max_history_cells);
    } catch (const InputError& error) {
        const std::string words = error.what();
        const std::string_view level = "level 1";
        if (!words.starts_with(level)) return;  // rounding, which replay() reports as well
        throw InputError("level " + std::to_string(step) + words.substr(level.size()));
    }
}

/// Refines with Closure::regular. Throws InputError as check_size() does.
History regularly_refined(const History& history, const CellMarks& marked) {
    History next = reference::refined_regularly(history, marked);
    if (reference::replay(next).back().mesh.cells.size() > max_history_cells) {
        throw InputError("the step would make more than");
    }
    return next;
}

class AdaptedMesh {
public:
    explicit AdaptedMesh(const Case& c)
        : closure_(c.closure), history_{c.mesh, {}}, present_(reference::replay(history_).back()) {}

    void make(const Step& step, ReferenceHistory& all) {
        all.before.push_back(history_);
        all.marked.push_back(marked_by(step));
        Stage stage;
        try {
            const History next = after(step, all.marked.back());
            present_ = reference::replay(next).back();
            stage.changed = next.steps != history_.steps && step.action != Action::rewrite;
            history_ = next;
        } catch (const InputError& error) {
            stage.refusal = error.what();
            last_.reset();
            taken_back_.reset();
        }
        stage.mesh = present_.mesh;
        all.maps.push_back(present_.maps);
        all.stages.push_back(std::move(stage));
    }

private:
    CellMarks marked_by(const Step& step) {
        CellMarks marked(present_.mesh.cells.size(), 0);
        if (step.action == Action::refine || step.action == Action::coarsen) {
            return reference::marked_cells(present_, step.selection);
        }
        if (step.action == Action::again && taken_back_) marked = taken_back_->cells;
        if (step.action == Action::take_back && last_) {
            for (CellIndex c{0}; c < marked.end_index(); ++c) {
                // Each child of a cell that was cut has a midpoint.
                marked[c] = std::ranges::any_of(present_.mesh.cells[c], [&](VertexIndex v) {
                    return v.value() >= last_->points_before;
                });
            }
        }
        return marked;
    }

    History after(const Step& step, const CellMarks& marked) {
        if (marked.size() != present_.mesh.cells.size()) {
            throw InputError("the reference: taking a step back left another number of cells");
        }
        const auto last = std::exchange(last_, {});
        const auto taken_back = std::exchange(taken_back_, {});
        switch (step.action) {
            case Action::reload:
            case Action::rebalance:
            case Action::scatter: return history_;
            case Action::rewrite: return {rewritten(present_.mesh, format_named(step.format)), {}};
            case Action::coarsen: return reference::coarsened(history_, marked, closure_);
            case Action::take_back:
                taken_back_ = last;
                return reference::coarsened(history_, marked);
            default: break;
        }
        const Scheme scheme = step.action == Action::refine ? step.scheme
                              : taken_back                  ? taken_back->scheme
                                                            : Scheme::eight;
        if (closure_ == Closure::regular) return regularly_refined(history_, marked);
        check_size(present_, marked, scheme, history_.steps.size() + 1);
        last_ = {marked, scheme, present_.mesh.points.size()};
        return reference::refined(history_, marked, scheme);
    }

    Closure closure_;
    History history_;
    Refinement present_;
    std::optional<MarkedBefore> last_;        ///< if the previous step refined
    std::optional<MarkedBefore> taken_back_;  ///< if the previous step took that back
};

}  // namespace

ReferenceHistory adapted_by_reference(const Case& c) {
    ReferenceHistory all;
    AdaptedMesh adapted(c);
    for (const Step& step : c.steps) adapted.make(step, all);
    return all;
}

}  // namespace octetra::properties
