#pragma once

#include <cmath>

namespace octetra::quality {

/// A sum with compensation of the rounding errors of each addition (Neumaier 1974): the error does
/// not grow with the number of terms. Requires that additions are not reassociated.
class CompensatedSum {
public:
    void add(double term) {
        const double next = sum_ + term;
        const bool sum_is_larger = std::abs(sum_) >= std::abs(term);
        lost_ += sum_is_larger ? (sum_ - next) + term : (term - next) + sum_;
        sum_ = next;
    }

    [[nodiscard]] double value() const { return sum_ + lost_; }

private:
    double sum_ = 0;
    double lost_ = 0;
};

}  // namespace octetra::quality
