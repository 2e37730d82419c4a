#pragma once

#include <cmath>

namespace octetra::quality {

/// A sum that keeps what each addition rounds away and gives it back at the end (Neumaier 1974):
/// the error does not grow with the number of terms. Needs arithmetic that is not reassociated.
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
