#include "files/gmsh/writing/marker_runs.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "files/output/text_slices.hpp"
#include "files/shares/gather.hpp"

namespace octetra::gmsh {
namespace {

/// The ends of a slice: its first and last run, which may continue in other slices.
struct SliceEnds {
    std::uint64_t runs = 0;
    MarkerRun first;
    MarkerRun last;
};

/// Appends the next markers of this process, from entity `first` on.
void add_runs(std::vector<MarkerRun>& runs, std::span<const Marker> markers, std::uint64_t first) {
    for (std::size_t i = 0; i < markers.size(); ++i) {
        if (runs.empty() || runs.back().marker != markers[i]) {
            runs.push_back({first + i, 0, markers[i]});
        }
        ++runs.back().length;
    }
}

/// Merges the runs of consecutive slices, in the order of the list.
class JoinedRuns {
public:
    explicit JoinedRuns(const ProcessGroup& group) : group_(&group) {}

    /// Collective. Appends the next slices, one from each process.
    void add(const std::vector<MarkerRun>& runs) {
        std::vector<SliceEnds> ends;
        if (!runs.empty()) ends.push_back({runs.size(), runs.front(), runs.back()});
        int rank = 0;
        for (const std::vector<SliceEnds>& of_rank :
             gather_lists(*group_, std::span<const SliceEnds>(ends))) {
            const bool is_own = rank++ == group_->rank();
            for (const SliceEnds& slice : of_rank) join(slice, is_own, runs);
        }
    }

    MarkerRuns take() {
        close();
        return std::move(found_);
    }

private:
    void join(const SliceEnds& slice, bool is_own, const std::vector<MarkerRun>& runs) {
        const bool continues = open_.length > 0 && open_.marker == slice.first.marker;
        found_.count += slice.runs - (continues ? 1 : 0);
        if (continues) open_.length += slice.first.length;
        if (continues && slice.runs == 1) return;
        close();
        if (is_own) {
            found_.here.insert(found_.here.end(), std::next(runs.begin(), continues ? 1 : 0),
                               runs.end());
        }
        open_ = slice.last;
        is_open_here_ = is_own;
    }

    /// Sets the length of the last run, which no further slice continues.
    void close() {
        if (is_open_here_) found_.here.back().length = open_.length;
        is_open_here_ = false;
    }

    const ProcessGroup* group_;
    MarkerRuns found_;
    MarkerRun open_;             // the last run so far
    bool is_open_here_ = false;  // it begins in a slice of this process
};

/// Collective. Returns the distinct markers of all processes, ascending.
std::vector<Marker> distinct_markers(const ProcessGroup& group,
                                     const std::vector<MarkerRun>& runs) {
    const auto make_set = [](std::vector<Marker>& markers) {
        std::ranges::sort(markers);
        markers.erase(std::unique(markers.begin(), markers.end()), markers.end());
    };
    std::vector<Marker> markers;
    for (const MarkerRun& run : runs) markers.push_back(run.marker);
    make_set(markers);
    std::vector<Marker> all;
    for (const auto& of_rank : gather_lists(group, std::span<const Marker>(markers))) {
        all.insert(all.end(), of_rank.begin(), of_rank.end());
    }
    make_set(all);
    return all;
}

}  // namespace

MarkerRuns find_marker_runs(std::uint64_t count, const ProcessGroup& group,
                            const std::function<std::span<const Marker>(const Window&)>& markers) {
    if (count == 0) return {};
    if (!markers) {
        // The single run belongs to the process with the first entity.
        MarkerRuns one{1, {}, {0}};
        if (group.is_first()) one.here.push_back({0, count, 0});
        return one;
    }
    std::vector<MarkerRun> runs;
    for_each_piece(share_window(count, group), lines_of_a_turn(count, group),
                   [&](const Window& window) {
                       add_runs(runs, markers(window), window.begin_of(group.rank()));
                   });
    JoinedRuns joined(group);
    joined.add(runs);
    MarkerRuns found = joined.take();
    found.markers = distinct_markers(group, found.here);
    return found;
}

}  // namespace octetra::gmsh
