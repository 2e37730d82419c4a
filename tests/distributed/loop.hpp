#pragma once

#include <memory>
#include <utility>

#include "adapt/mesh_state.hpp"

namespace octetra::test {

using namespace distributed;

/// Refines and coarsens like AdaptiveMesh, with a given Tuning.
class Loop {
public:
    explicit Loop(DistributedMesh input) : state_(AdaptiveMesh::State::make(std::move(input))) {}

    /// Collective. Makes one step.
    Adaptation refine(const Selection& selection, const StepOptions& options,
                      const Tuning& tuning) {
        return state_->refine([&] { return mark_cells(mesh(), selection, false); }, options,
                              tuning);
    }
    /// Collective.
    Adaptation coarsen(const Selection& selection, const Tuning& tuning) {
        return coarsen_state(
            *state_, [&] { return mark_cells(mesh(), selection, false); }, tuning);
    }
    [[nodiscard]] const AdaptiveMesh::State& state() const { return *state_; }
    [[nodiscard]] DistributedMesh& mesh() { return state_->mesh; }
    [[nodiscard]] const DistributedMesh& mesh() const { return state_->mesh; }

private:
    std::unique_ptr<AdaptiveMesh::State> state_;
};

}  // namespace octetra::test
