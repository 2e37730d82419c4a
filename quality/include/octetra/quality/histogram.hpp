#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace octetra::quality {

/// The smallest and the largest of some values.
struct Range {
    double min = 0;
    double max = 0;

    friend bool operator==(const Range&, const Range&) = default;
};

/// Makes the range reach `value`; an absent range becomes that value alone.
inline void extend(std::optional<Range>& range, double value) {
    if (!range) range = Range{value, value};
    if (value < range->min) range->min = value;
    if (value > range->max) range->max = value;
}

/// Counts of values in bins of equal width over low..high. Bin i begins at its lower bound and ends
/// before the next one's; the last bin holds `high` as well.
///
/// A value less than a thousand-millionth of a bin below a bound counts as on it: the angles of a
/// lattice, 60 degrees say, then all fall into one bin, however they were rounded.
struct Histogram {
    double low = 0;
    double high = 1;
    std::vector<std::size_t> counts;

    Histogram(double low_bound, double high_bound, std::size_t bins)
        : low(low_bound), high(high_bound), counts(bins, 0) {}

    void add(double value) {
        constexpr double tolerance = 1e-9;
        const double position = bin_count() * (value - low) / (high - low) + tolerance;
        ++counts[bin_at(position)];
    }

    /// Where bin i begins; for i = counts.size(), where the last one ends.
    [[nodiscard]] double bound(std::size_t i) const {
        return low + (high - low) * static_cast<double>(i) / bin_count();
    }

    friend bool operator==(const Histogram&, const Histogram&) = default;

private:
    [[nodiscard]] double bin_count() const { return static_cast<double>(counts.size()); }

    /// Values outside of the bounds go to the first and the last bin.
    [[nodiscard]] std::size_t bin_at(double position) const {
        if (!(position > 0)) return 0;
        if (position >= bin_count()) return counts.size() - 1;
        return static_cast<std::size_t>(position);
    }
};

}  // namespace octetra::quality
