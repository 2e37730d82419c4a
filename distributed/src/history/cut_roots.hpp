#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/cut_runs.hpp>

#include "assemble/cut_bytes.hpp"

/// Converts between two forms of a history. Steps are lists over the cells; messages between
/// processes and blocks of a file group them by root instead.
namespace octetra::distributed {

/// Splits steps by root. `Runs` has at_end() and next(), as CutReader has.
template <class Runs>
class RootSplitter {
public:
    explicit RootSplitter(std::vector<Runs> steps) {
        for (Runs& step : steps) cursors_.push_back({std::move(step), {}});
    }

    /// Appends the next root's bytes; returns the number of its descendants after the last step.
    std::uint64_t append_next(std::vector<std::uint8_t>& bytes) {
        std::uint64_t cells = 1;
        const std::size_t begin = bytes.size();
        bool is_cut = false;
        for (Cursor& step : cursors_) {
            root_.clear();
            std::uint64_t made = 0;
            bool is_cut_now = false;
            step.take(cells, [&](Cut cut, std::uint64_t count) {
                root_.append(cut, count);
                made += count * child_count_of(cut);
                is_cut_now = is_cut_now || cut != 0;
            });
            root_.finish();
            const auto runs = is_cut_now ? root_.bytes() : std::span<const std::uint8_t>{};
            append_number(runs.size(), bytes);
            bytes.insert(bytes.end(), runs.begin(), runs.end());
            is_cut = is_cut || is_cut_now;
            cells = made;
        }
        if (!is_cut) bytes.resize(begin);
        return cells;
    }
    /// Skips `count` roots that were never cut.
    void skip_whole(std::uint64_t count) {
        for (Cursor& step : cursors_) step.take(count, [](Cut, std::uint64_t) {});
    }

private:
    struct Cursor {
        Runs runs;
        CutRun rest;

        void take(std::uint64_t cells, auto&& visit) {
            while (cells > 0) {
                if (rest.count == 0) rest = runs.next();
                const std::uint64_t taken = rest.count < cells ? rest.count : cells;
                visit(rest.cut, taken);
                rest.count -= taken;
                cells -= taken;
            }
        }
    };
    std::vector<Cursor> cursors_;
    CutRuns root_;
};

/// Joins the bytes of roots to steps, the inverse of RootSplitter.
class RootJoiner {
public:
    explicit RootJoiner(std::size_t step_count) : steps_(step_count) {}

    void append_whole(std::uint64_t roots) { whole_ += roots; }
    /// Appends a root that was cut; returns the number of its descendants after the last step.
    std::uint64_t append(RootBytes root) {
        flush();
        std::uint64_t cells = 1;
        for (CutRuns& step : steps_) {
            std::uint64_t size = 0;
            (void)take_number(root, size);
            if (size == 0) {
                step.append(0, cells);
                continue;
            }
            std::uint64_t made = 0;
            for (CutReader reader(root.first(size)); !reader.at_end();) {
                const CutRun run = reader.next();
                step.append(run.cut, run.count);
                made += run.count * child_count_of(run.cut);
            }
            root = root.subspan(size);
            cells = made;
        }
        return cells;
    }
    [[nodiscard]] std::vector<CutRuns> finish() && {
        flush();
        for (CutRuns& step : steps_) step.finish();
        return std::move(steps_);
    }

private:
    void flush() {
        if (whole_ == 0) return;
        for (CutRuns& step : steps_) step.append(0, whole_);
        whole_ = 0;
    }

    std::vector<CutRuns> steps_;
    std::uint64_t whole_ = 0;
};

/// Splits steps over all cells of a part by its roots. The descendants of root r after the last
/// step are first[r] .. first[r + 1] - 1, as in an AncestorMap.
[[nodiscard]] inline CutRoots cut_roots_of(std::span<const CutRuns> steps,
                                           std::span<const std::uint32_t> first) {
    std::vector<CutReader> readers;
    readers.reserve(steps.size());
    for (const CutRuns& step : steps) readers.emplace_back(step.bytes());
    RootSplitter<CutReader> splitter(std::move(readers));
    CutRoots cuts;
    std::uint64_t whole = 0;
    for (std::size_t r = 0; r + 1 < first.size(); ++r) {
        if (first[r + 1] - first[r] == 1) {
            ++whole;
            continue;
        }
        splitter.skip_whole(std::exchange(whole, 0));
        const std::size_t before = cuts.bytes.size();
        (void)splitter.append_next(cuts.bytes);
        cuts.roots.push_back({static_cast<std::uint32_t>(r),
                              static_cast<std::uint32_t>(cuts.bytes.size() - before)});
    }
    return cuts;
}

}  // namespace octetra::distributed
