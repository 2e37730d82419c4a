#include "numbering/canonical_numbers.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "level/huge_pages.hpp"

namespace octetra::distributed {
namespace {

using Ends = std::array<std::uint64_t, 2>;

/// Pairs by who is to put them in order: processes answer for blocks of lower ends. The pairs are
/// ascending in these.
std::vector<std::vector<Ends>> by_process(const Communicator& processes,
                                          const std::vector<Ends>& pairs, std::uint64_t block) {
    std::vector<std::vector<Ends>> questions(static_cast<std::size_t>(processes.size()));
    auto begin = pairs.begin();
    for (std::size_t r = 0; r < questions.size(); ++r) {
        const auto end = std::partition_point(
            begin, pairs.end(), [&](const Ends& pair) { return pair[0] / block == r; });
        questions[r].assign(begin, end);
        begin = end;
    }
    return questions;
}

/// The different pairs among those asked for, in ascending order. Put there by counting, as few
/// pairs have lower ends close to each other; there are no more bins than pairs, however far lower
/// ends are apart.
class OrderedPairs {
public:
    explicit OrderedPairs(const std::vector<std::vector<Ends>>& asked) {
        find_bins(asked);
        for_each(asked, [&](const Ends& pair) { ++begin_[bin_of(pair)]; });
        std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
        // Filled from behind, after which every beginning is where it belongs.
        for_each(asked, [&](const Ends& pair) { pairs_[--begin_[bin_of(pair)]] = pair; });
        std::uint64_t count = 0;
        for (std::size_t bin = 0; bin + 1 < begin_.size(); ++bin) {
            const std::uint64_t begin = begin_[bin];
            const std::uint64_t end = begin_[bin + 1];
            std::sort(pairs_.data() + begin, pairs_.data() + end);
            begin_[bin] = count;
            for (std::uint64_t k = begin; k < end; ++k) {
                if (count > begin_[bin] && pairs_[count - 1] == pairs_[k]) continue;
                pairs_[count++] = pairs_[k];
            }
        }
        begin_.back() = count;
        pairs_.resize(count);
    }

    [[nodiscard]] std::uint64_t size() const { return pairs_.size(); }

    /// The place of a pair that is there.
    [[nodiscard]] std::uint64_t place_of(const Ends& pair) const {
        const std::size_t bin = bin_of(pair);
        const auto* const found =
            std::lower_bound(pairs_.data() + begin_[bin], pairs_.data() + begin_[bin + 1], pair);
        return static_cast<std::uint64_t>(found - pairs_.data());
    }

private:
    static void for_each(const std::vector<std::vector<Ends>>& asked, auto&& visit) {
        for (const auto& from_one : asked) std::ranges::for_each(from_one, visit);
    }
    void find_bins(const std::vector<std::vector<Ends>>& asked) {
        std::uint64_t count = 0;
        std::uint64_t last = 0;
        least_ = std::numeric_limits<std::uint64_t>::max();
        for (const auto& from_one : asked) {
            if (from_one.empty()) continue;
            count += from_one.size();
            least_ = std::min(least_, from_one.front()[0]);
            last = std::max(last, from_one.back()[0]);
        }
        pairs_.resize(count);
        if (count == 0) return begin_.assign(1, 0);
        while ((last - least_) >> shift_ >= count) ++shift_;
        begin_.assign(((last - least_) >> shift_) + 2, 0);
    }
    [[nodiscard]] std::size_t bin_of(const Ends& pair) const {
        return (pair[0] - least_) >> shift_;
    }

    std::uint64_t least_ = 0;  ///< lower end
    unsigned shift_ = 0;
    std::vector<std::uint64_t> begin_;  ///< by bin
    std::vector<Ends> pairs_;
};

/// Collective. The places of pairs among the different pairs of all processes, in ascending order;
/// adds their number to `total`. `pairs` makes this process's, which are ascending in their lower
/// ends, and these less than `end_count`. Where a process fails there is no result on any.
std::vector<std::uint64_t> ranked(const Communicator& processes, auto&& pairs,
                                  std::uint64_t end_count, std::uint64_t& total,
                                  LocalFailure& failure) {
    const auto somewhere_failed = [&] {
        return failure.max_unless_failed(processes, 0) == LocalFailure::somewhere;
    };
    const auto process_count = static_cast<std::uint64_t>(processes.size());
    const std::uint64_t block = end_count / process_count + 1;
    std::vector<std::vector<Ends>> asked;
    failure.attempt([&] { asked = by_process(processes, pairs(), block); });
    if (somewhere_failed()) return {};

    std::optional<OrderedPairs> known;
    failure.attempt([&] {
        asked = processes.all_to_all(asked);
        known.emplace(asked);
    });
    const std::uint64_t count = known ? known->size() : 0;
    const std::uint64_t first = total + processes.sum_before(count);
    total += processes.sum(count);

    std::vector<std::vector<std::uint64_t>> answers;
    failure.attempt([&] {
        answers.resize(asked.size());
        for (std::size_t r = 0; r < asked.size(); ++r) {
            answers[r].reserve(asked[r].size());
            for (const Ends& pair : asked[r]) answers[r].push_back(first + known->place_of(pair));
            asked[r] = {};
        }
    });
    if (somewhere_failed()) return {};
    // The pairs were ascending in their lower ends, so the answers come in their order.
    std::vector<std::uint64_t> places;
    failure.attempt([&] {
        for (const auto& from_one : processes.all_to_all(answers)) {
            places.insert(places.end(), from_one.begin(), from_one.end());
        }
    });
    return places;
}

}  // namespace

void CanonicalNumbers::number_midpoints(const DistributedMesh& mesh, VertexIndex end,
                                        LocalFailure& failure) {
    const VertexIndex begin = of_vertex.end_index();
    if (mesh.processes.size() == 1) {  // vertices are in canonical order
        failure.attempt([&] {
            make_room(of_vertex, end.value());
            for (VertexIndex v = begin; v < end; ++v) of_vertex.push_back(GlobalVertex{v.value()});
            vertex_count = of_vertex.size();
        });
        return;
    }
    const auto number = [&](VertexIndex v) { return static_cast<std::uint64_t>(of_vertex[v]); };
    const auto pairs = [&] {
        std::vector<Ends> of_ends;
        of_ends.reserve(end.value() - begin.value());
        for (VertexIndex v = begin; v < end; ++v) {
            const auto& [a, b] = mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()];
            of_ends.push_back({number(a), number(b)});
        }
        return of_ends;
    };
    const auto places = ranked(mesh.processes, pairs, vertex_count, vertex_count, failure);
    failure.attempt([&] {
        make_room(of_vertex, end.value());
        for (const std::uint64_t place : places) of_vertex.push_back(GlobalVertex{place});
    });
}

void CanonicalNumbers::forget_from(VertexIndex end, std::uint64_t count) noexcept {
    if (end < of_vertex.end_index()) of_vertex.resize(end.value());
    vertex_count = count;
}

CanonicalNumbers input_numbers(const DistributedMesh& mesh) {
    CanonicalNumbers numbers;
    numbers.of_vertex.assign(mesh.input_vertices.begin(), mesh.input_vertices.end());
    numbers.vertex_count = mesh.input_vertex_count;
    return numbers;
}

CanonicalNumbers canonical_numbers(const DistributedMesh& mesh) {
    LocalFailure failure;
    CanonicalNumbers numbers;
    failure.attempt([&] {
        numbers = input_numbers(mesh);
        numbers.of_vertex.reserve(mesh.points.size());
    });
    // All processes have as many levels.
    for (std::size_t level = 0; level < mesh.level_begin.size(); ++level) {
        const VertexIndex end = level + 1 < mesh.level_begin.size() ? mesh.level_begin[level + 1]
                                                                    : mesh.points.end_index();
        numbers.number_midpoints(mesh, end, failure);
    }
    failure.agree(mesh.processes);
    return numbers;
}

}  // namespace octetra::distributed
