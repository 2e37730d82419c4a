#pragma once

#include <functional>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "script/read_script.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {

struct ScriptRun {
    MeshFacts input;         ///< of the mesh before the first step
    bool has_steps = false;  ///< has it steps behind it already?
    distributed::StepOptions options;
    std::optional<distributed::BalanceOptions> balance;  ///< do cells move before a level?
    bool may_forget_history = false;  ///< to move cells, until a step or a file needs it
    bool recalls_history = false;     ///< after the last step, if it was forgotten
    std::function<void(const distributed::Adaptation&)> on_step = {};  ///< of each level
    std::function<void(const distributed::Migration&)> on_move = {};   ///< of cells between ranks
    std::function<void()> on_changed = {};  ///< after each step of refinement or coarsening
    /// Those of the mesh as it is whenever a step writes it; these two see to that.
    const std::vector<distributed::Field>* fields = nullptr;
    bool quiet = false;
};

/// Collective. Runs the steps one after the other, and says of each what it did. What goes wrong
/// with one is thrown with its line in front; the files of those before it stay.
void run_script(distributed::AdaptiveMesh& mesh, const Script& script, const ScriptRun& run,
                Stopwatch& watch);

}  // namespace octetra::cli
