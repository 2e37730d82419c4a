#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace octetra::quality {

/// The minimum and maximum of some values.
struct Range {
    double min = 0;
    double max = 0;

    friend bool operator==(const Range&, const Range&) = default;
};

/// Extends the range to include `value`; an empty range becomes this value.
inline void extend(std::optional<Range>& range, double value) {
    if (!range) range = Range{value, value};
    if (value < range->min) range->min = value;
    if (value > range->max) range->max = value;
}

/// Counts of values in bins of equal width over low..high. Bin i contains its lower bound, but not
/// the next one's; the last bin also contains `high`.
///
/// A value less than 1e-9 of a bin below a bound counts as on it, so that equal angles of a
/// lattice, 60 degrees for example, fall into one bin despite rounding.
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

    /// Returns the lower bound of bin i; for i = counts.size(), the upper bound of the last one.
    [[nodiscard]] double bound(std::size_t i) const {
        return low + (high - low) * static_cast<double>(i) / bin_count();
    }

    friend bool operator==(const Histogram&, const Histogram&) = default;

private:
    [[nodiscard]] double bin_count() const { return static_cast<double>(counts.size()); }

    /// Values outside the bounds are counted in the first or last bin.
    [[nodiscard]] std::size_t bin_at(double position) const {
        if (!(position > 0)) return 0;
        if (position >= bin_count()) return counts.size() - 1;
        return static_cast<std::size_t>(position);
    }
};

}  // namespace octetra::quality
