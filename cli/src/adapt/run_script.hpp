#pragma once

#include <functional>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "adapt/size_files.hpp"
#include "script/read_script.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {

struct ScriptRun {
    MeshFacts input;         ///< facts of the mesh before the first step
    bool has_steps = false;  ///< whether it already has a history
    distributed::StepOptions options;
    std::optional<distributed::BalanceOptions> balance;  ///< if set, cells may move before a level
    bool may_forget_history = false;  ///< in order to move cells, until the history is needed
    bool recalls_history = false;     ///< restore the history after the last step
    std::function<void(const distributed::Adaptation&)> on_step = {};  ///< after each level
    std::function<void(const distributed::Migration&)> on_move = {};   ///< after each migration
    std::function<void()> on_changed = {};  ///< called after each refinement or coarsening step
    /// The fields of the current mesh whenever a step uses or writes them; on_step and on_move must
    /// keep them so.
    const CarriedFields* fields = nullptr;
    bool quiet = false;
};

/// Collective. Runs the steps in sequence, and reports each. An error is thrown with the line of
/// its step prepended; files written by earlier steps are kept.
void run_script(distributed::AdaptiveMesh& mesh, const Script& script, const ScriptRun& run,
                Stopwatch& watch);

}  // namespace octetra::cli
