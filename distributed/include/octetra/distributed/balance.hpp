#pragma once

namespace octetra::distributed {

/// Conditions for migrating cells so that all processes have nearly the same number. Must be the
/// same on all processes.
struct BalanceOptions {
    /// Cells migrate if the largest number of cells of a process, before or after the coming step,
    /// exceeds this multiple of the mean.
    double most_over_mean = 1.1;
    /// For migration before a step: cells migrate only if the cells that other processes have
    /// waited for, (maximum - mean) summed over this step and the uneven steps since the last
    /// migration, exceed twice the largest current number of cells of a process. To migrate a cell
    /// takes about twice as long as to make and write it.
    bool only_if_it_pays = false;
    /// If roots with all their descendants are too large to balance the processes, current cells
    /// may become the roots. The mesh then forgets its history until
    /// AdaptiveMesh::recall_history(): coarsening stops at the new roots, a checkpoint stores them
    /// as its input, and files number parents among them. The results of further refinement are the
    /// same. Has no effect on a mesh that was refined with Closure::regular.
    bool may_forget_history = false;

    friend bool operator==(const BalanceOptions&, const BalanceOptions&) = default;
};

}  // namespace octetra::distributed
