#include "canonical_numbers.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace octetra::distributed {
namespace {

using Ends = std::array<std::uint64_t, 2>;

/// Collective. Who is to put pairs in order gets them: processes answer for blocks of lower ends.
/// The pairs are ascending in their lower ends.
std::vector<std::vector<Ends>> ask(const Communicator& processes, std::span<const Ends> pairs,
                                   std::uint64_t block) {
    std::vector<std::vector<Ends>> questions(static_cast<std::size_t>(processes.size()));
    auto begin = pairs.begin();
    for (std::size_t r = 0; r < questions.size(); ++r) {
        const auto end = std::partition_point(
            begin, pairs.end(), [&](const Ends& pair) { return pair[0] / block == r; });
        questions[r].assign(begin, end);
        begin = end;
    }
    return processes.all_to_all(questions);
}

/// The different pairs among those asked for whose lower ends are in one block, in ascending order.
/// Put there by counting, as few pairs have the same lower end.
class OrderedPairs {
public:
    OrderedPairs(const std::vector<std::vector<Ends>>& asked, std::uint64_t first_low,
                 std::uint64_t block)
        : first_low_(first_low), begin_(block + 1, 0) {
        for (const auto& from_one : asked) {
            for (const Ends& pair : from_one) ++begin_[pair[0] - first_low_];
        }
        std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
        highs_.resize(begin_.back());
        // Filled from behind, after which every beginning is where it belongs.
        for (const auto& from_one : asked) {
            for (const Ends& pair : from_one) highs_[--begin_[pair[0] - first_low_]] = pair[1];
        }
        std::uint64_t count = 0;
        for (std::uint64_t low = 0; low < block; ++low) {
            const std::uint64_t begin = begin_[low];
            const std::uint64_t end = begin_[low + 1];
            std::sort(highs_.data() + begin, highs_.data() + end);
            begin_[low] = count;
            for (std::uint64_t k = begin; k < end; ++k) {
                if (count > begin_[low] && highs_[count - 1] == highs_[k]) continue;
                highs_[count++] = highs_[k];
            }
        }
        begin_.back() = count;
        highs_.resize(count);
    }

    [[nodiscard]] std::uint64_t size() const { return highs_.size(); }

    /// The place of a pair that is there.
    [[nodiscard]] std::uint64_t place_of(const Ends& pair) const {
        const std::uint64_t low = pair[0] - first_low_;
        const auto* const found =
            std::lower_bound(highs_.data() + begin_[low], highs_.data() + begin_[low + 1], pair[1]);
        return static_cast<std::uint64_t>(found - highs_.data());
    }

private:
    std::uint64_t first_low_;
    std::vector<std::uint64_t> begin_;  ///< by the lower end
    std::vector<std::uint64_t> highs_;
};

/// Collective. The places of these pairs among the different pairs of all processes, in ascending
/// order; adds their number to `total`. The pairs are ascending in their lower ends, which are less
/// than `end_count`.
std::vector<std::uint64_t> ranked(const Communicator& processes, std::vector<Ends> pairs,
                                  std::uint64_t end_count, std::uint64_t& total) {
    const auto process_count = static_cast<std::uint64_t>(processes.size());
    const std::uint64_t block = end_count / process_count + 1;
    auto asked = ask(processes, pairs, block);
    pairs = {};

    const OrderedPairs known(asked, block * static_cast<std::uint64_t>(processes.rank()), block);
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
