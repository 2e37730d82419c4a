#pragma once

namespace octetra::distributed {

/// When cells move so that all processes have about as many. The same on all processes.
struct BalanceOptions {
    /// Cells move where the process that has most, or will have, has more than so many times the
    /// mean.
    double most_over_mean = 1.1;
    /// Of cells that move before a step: and only when the processes have waited, in this step and
    /// those since cells moved, for more than twice as many cells as any process has now: as many
    /// as the one that had most made beyond the mean. To move a cell takes about twice as long as
    /// to make and write one.
    bool only_if_it_pays = false;
    /// Where cells of the input with all that has become of them are too much to make processes
    /// even, cells of the mesh as it is may take their place. What they came from is forgotten
    /// then, until AdaptiveMesh::recall_history(): they are the roots, coarsening ends with them, a
    /// checkpoint has them as its input, and parents in files are among them.
    /// What is refined from there on is the same.
    bool may_forget_history = false;

    friend bool operator==(const BalanceOptions&, const BalanceOptions&) = default;
};

}  // namespace octetra::distributed
