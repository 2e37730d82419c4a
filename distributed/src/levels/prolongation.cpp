#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/index_map.hpp>
#include <octetra/distributed/levels.hpp>

#include "levels/level_data.hpp"

namespace octetra::distributed {
namespace {

struct Entry {
    std::uint64_t column;
    double value;
};

/// The rows of the vertices of a level of which the previous level has the first `coarse_count`.
/// Ends of an edge precede its midpoint, so a row is half the sum of two rows before it.
class MidpointRows {
public:
    MidpointRows(const VertexLevels& steps, std::span<const std::uint64_t> column_of,
                 std::size_t fine_count)
        : column_of_(column_of) {
        for (VertexIndex v{column_of.size()}; v < VertexIndex{fine_count}; ++v) {
            add_mean(steps.ends(v));
        }
    }
    /// Appends the row of a vertex.
    void append(VertexIndex v, SparseRows& rows) const {
        for_each_entry(v, [&](const Entry& entry) {
            rows.columns.push_back(entry.column);
            rows.values.push_back(entry.value);
        });
        rows.row_begin.push_back(rows.columns.size());
    }

private:
    void for_each_entry(VertexIndex v, auto&& visit) const {
        if (v.value() < column_of_.size()) return visit(Entry{column_of_[v.value()], 1});
        const std::size_t row = v.value() - column_of_.size();
        for (std::size_t i = begin_[row]; i < begin_[row + 1]; ++i) visit(entries_[i]);
    }
    void add_mean(const EdgeVertices& ends) {
        row_.clear();
        for (const VertexIndex end : ends) {
            for_each_entry(end, [&](const Entry& entry) {
                row_.push_back({entry.column, entry.value / 2});
            });
        }
        std::ranges::sort(row_, {}, &Entry::column);
        for (const Entry& entry : row_) {
            if (entries_.size() > begin_.back() && entries_.back().column == entry.column) {
                entries_.back().value += entry.value;
            } else {
                entries_.push_back(entry);
            }
        }
        begin_.push_back(entries_.size());
    }

    std::span<const std::uint64_t> column_of_;
    std::vector<std::size_t> begin_{0};
    std::vector<Entry> entries_;
    std::vector<Entry> row_;
};

/// Throws InputError unless there are `components` values for each of `count` vertices.
void check_size(std::span<const double> values, std::size_t count, std::size_t components) {
    if (values.size() == count * components) return;
    throw InputError(
        fmt::format("the level has {} vertices on this rank: {} values with {} "
                    "components were expected, not {}",
                    count, count, components, values.size()));
}

/// Throws InputError if there is no next level.
void check_has_next(std::size_t level, std::size_t count) {
    if (level + 1 < count) return;
    throw InputError(fmt::format("level {} has no next level: the levels of the mesh are 0 to {}",
                                 level, count - 1));
}

}  // namespace

SparseRows Levels::prolongation(std::size_t level) const {
    return processes().transaction([&] {
        processes().check_same("level", fmt::format("{}", level));
        check_has_next(level, count());
        const Data::Level& coarse = data_->at(level);
        const Data::Level& fine = data_->at(level + 1);
        const auto columns = make_index_map(processes(), coarse.sharing, coarse.vertices);
        const MidpointRows midpoints(data_->steps(), columns.numbers, fine.vertices);
        std::vector<std::uint8_t> is_owned(fine.vertices, 1);
        for (const SharedWith<VertexIndex>& with : fine.sharing.neighbours()) {
            for (const VertexIndex v : with.received) is_owned[v.value()] = 0;
        }
        SparseRows rows;
        rows.row_begin.reserve(fine.vertices + 1);
        for (VertexIndex v{0}; v < VertexIndex{fine.vertices}; ++v) {
            if (is_owned[v.value()] != 0) midpoints.append(v, rows);
        }
        return rows;
    });
}

std::vector<double> Levels::prolong(std::size_t level, std::span<const double> values,
                                    std::size_t components) const {
    check_has_next(level, count());
    const std::size_t coarse = data_->at(level).vertices;
    const std::size_t fine = data_->at(level + 1).vertices;
    check_size(values, coarse, components);
    const VertexLevels steps = data_->steps();
    std::vector<double> result(fine * components);
    std::ranges::copy(values, result.begin());
    for (VertexIndex v{coarse}; v < VertexIndex{fine}; ++v) {
        const auto [a, b] = steps.ends(v);
        for (std::size_t k = 0; k < components; ++k) {
            result[v.value() * components + k] =
                mean(result[a.value() * components + k], result[b.value() * components + k]);
        }
    }
    return result;
}

std::vector<double> Levels::restrict_residual(std::size_t level, std::span<const double> values,
                                              std::size_t components) const {
    return processes().transaction([&] {
        processes().check_same("level and components", fmt::format("{}, {}", level, components));
        if (level == 0) throw InputError("level 0 has no previous level");
        const Data::Level& fine = data_->at(level);
        const Data::Level& coarse = data_->at(level - 1);
        check_size(values, fine.vertices, components);
        const VertexLevels steps = data_->steps();
        std::vector<double> sums(values.begin(), values.end());
        for (const SharedWith<VertexIndex>& with : fine.sharing.neighbours()) {
            for (const VertexIndex v : with.received) {
                std::fill_n(sums.begin() + static_cast<std::ptrdiff_t>(v.value() * components),
                            components, 0.0);
            }
        }
        for (std::size_t v = fine.vertices; v-- > coarse.vertices;) {
            for (const VertexIndex end : steps.ends(VertexIndex{v})) {
                for (std::size_t k = 0; k < components; ++k) {
                    sums[end.value() * components + k] += sums[v * components + k] / 2;
                }
            }
        }
        sums.resize(coarse.vertices * components);
        combine_everywhere(processes(), coarse.sharing, coarse.vertices, sums, std::plus<>{},
                           components);
        return sums;
    });
}

}  // namespace octetra::distributed
