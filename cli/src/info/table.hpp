#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <octetra/quality/histogram.hpp>

#include "grouped.hpp"

namespace octetra::cli {

/// Formats a number with six significant digits.
[[nodiscard]] inline std::string shown(double number) {
    return fmt::format("{:.6g}", number + 0.0);  // -0 becomes 0
}

[[nodiscard]] inline std::string shown(std::size_t count) { return grouped(count); }

/// Builds the text: headings, and rows of right-aligned columns below them.
class Table {
public:
    template <class... Titles>
    void heading(std::string_view title, const Titles&... titles) {
        if (!text_.empty()) text_ += '\n';
        line(title, std::string_view(titles)...);
    }

    template <class... Cells>
    void row(std::string_view name, const Cells&... cells) {
        line(fmt::format("  {}", name), std::string_view(cells)...);
    }

    /// Appends a histogram with bars; the longest bar represents the largest count.
    void histogram(std::string_view title, const quality::Histogram& histogram) {
        heading(title, "count", "share");
        const auto& counts = histogram.counts;
        const std::size_t total = std::reduce(counts.begin(), counts.end());
        const std::size_t largest = std::ranges::max(counts);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const std::string bin =
                fmt::format("{:>4} .. {:<4}", histogram.bound(i), histogram.bound(i + 1));
            row(bin, shown(counts[i]), share(counts[i], total));
            text_.pop_back();
            text_ += counts[i] == 0 ? "\n" : fmt::format("  {}\n", bar(counts[i], largest));
        }
    }

    [[nodiscard]] std::string take() && { return std::move(text_); }

private:
    static constexpr std::size_t name_width = 30;
    static constexpr std::size_t column_width = 15;
    static constexpr std::size_t bar_width = 16;  // the rest of 80 columns

    template <class... Cells>
    void line(std::string_view name, const Cells&... cells) {
        fmt::format_to(std::back_inserter(text_), "{:<{}}", name, name_width);
        (fmt::format_to(std::back_inserter(text_), "{:>{}}", cells, column_width), ...);
        text_.erase(text_.find_last_not_of(' ') + 1);
        text_ += '\n';
    }

    static std::string share(std::size_t count, std::size_t total) {
        if (total == 0) return "-";
        return fmt::format("{:.2f} %",
                           100 * static_cast<double>(count) / static_cast<double>(total));
    }

    /// Never empty, so that small counts are distinguishable from none.
    static std::string bar(std::size_t count, std::size_t largest) {
        const double part = static_cast<double>(count) / static_cast<double>(largest);
        const auto length =
            static_cast<std::size_t>(std::lround(part * static_cast<double>(bar_width)));
        return std::string(std::max(length, std::size_t{1}), '#');
    }

    std::string text_;
};

}  // namespace octetra::cli
