#include "numbering/canonical_numbers.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace octetra::distributed {
namespace {

using Ends = std::array<std::uint64_t, 2>;

/// Collective. Who is to put pairs in order gets them: processes answer for blocks of lower ends.
/// The pairs are ascending in their lower ends.
std::vector<std::vector<Ends>> ask(const Communicator& processes, std::vector<Ends> pairs,
                                   std::uint64_t block) {
    std::vector<std::vector<Ends>> questions(static_cast<std::size_t>(processes.size()));
    auto begin = pairs.begin();
    for (std::size_t r = 0; r < questions.size(); ++r) {
        const auto end = std::partition_point(
            begin, pairs.end(), [&](const Ends& pair) { return pair[0] / block == r; });
        questions[r].assign(begin, end);
        begin = end;
    }
    pairs = {};
    return processes.all_to_all(questions);
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

/// Collective. The places of these pairs among the different pairs of all processes, in ascending
/// order; adds their number to `total`. The pairs are ascending in their lower ends, which are less
/// than `end_count`.
std::vector<std::uint64_t> ranked(const Communicator& processes, std::vector<Ends> pairs,
                                  std::uint64_t end_count, std::uint64_t& total) {
    const auto process_count = static_cast<std::uint64_t>(processes.size());
    const std::uint64_t block = end_count / process_count + 1;
    auto asked = ask(processes, std::move(pairs), block);

    const OrderedPairs known(asked);
    const std::uint64_t first = total + processes.sum_before(known.size());
    total += processes.sum(known.size());

    std::vector<std::vector<std::uint64_t>> answers(asked.size());
    for (std::size_t r = 0; r < asked.size(); ++r) {
        answers[r].reserve(asked[r].size());
        for (const Ends& pair : asked[r]) answers[r].push_back(first + known.place_of(pair));
        asked[r] = {};
    }
    // The pairs were ascending in their lower ends, so the answers come in their order.
    std::vector<std::uint64_t> places;
    for (const auto& from_one : processes.all_to_all(answers)) {
        places.insert(places.end(), from_one.begin(), from_one.end());
    }
    return places;
}

}  // namespace

CanonicalNumbers canonical_numbers(const DistributedMesh& mesh) {
    CanonicalNumbers numbers;
    numbers.of_vertex.assign(mesh.input_vertices.begin(), mesh.input_vertices.end());
    numbers.of_vertex.reserve(mesh.points.size());
    numbers.vertex_count = mesh.input_vertex_count;
    const auto number = [&](VertexIndex v) {
        return static_cast<std::uint64_t>(numbers.of_vertex[v]);
    };
    for (std::size_t level = 0; level < mesh.level_begin.size(); ++level) {
        const VertexIndex end = level + 1 < mesh.level_begin.size() ? mesh.level_begin[level + 1]
                                                                    : mesh.points.end_index();
        std::vector<Ends> pairs;
        pairs.reserve(end.value() - mesh.level_begin[level].value());
        for (VertexIndex v = mesh.level_begin[level]; v < end; ++v) {
            const auto& [a, b] = mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()];
            pairs.push_back({number(a), number(b)});
        }
        for (const std::uint64_t place :
             ranked(mesh.processes, std::move(pairs), numbers.vertex_count, numbers.vertex_count)) {
            numbers.of_vertex.push_back(GlobalVertex{place});
        }
    }
    return numbers;
}

}  // namespace octetra::distributed
