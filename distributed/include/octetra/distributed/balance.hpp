#pragma once

namespace octetra::distributed {

/// When cells move so that all processes have about as many. The same on all processes.
struct BalanceOptions {
    /// Cells move where the process that has most, or will have, has more than so many times the
    /// mean.
    double most_over_mean = 1.1;
    /// Of cells that move before a step: and only where that spares the process that would have
    /// most more than twice as many new cells as any process has now, as to move one takes about
    /// twice as long as to make and write one.
    bool only_if_it_pays = false;

    friend bool operator==(const BalanceOptions&, const BalanceOptions&) = default;
};

}  // namespace octetra::distributed
