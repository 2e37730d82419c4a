#include "canonical_numbers.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace octetra::distributed {
namespace {

using Ends = std::array<std::uint64_t, 2>;

/// Collective. The places of these pairs among the different pairs of all processes, in ascending
/// order; adds their number to `total`. The pairs are ascending in their lower ends, which are less
/// than `end_count`: each process answers for a block of lower ends.
std::vector<std::uint64_t> ranked(const Communicator& processes, std::vector<Ends> pairs,
                                  std::uint64_t end_count, std::uint64_t& total) {
    const auto process_count = static_cast<std::size_t>(processes.size());
    const std::uint64_t block = end_count / process_count + 1;
    std::vector<std::vector<Ends>> asked;
    {
        std::vector<std::vector<Ends>> questions(process_count);
        auto begin = pairs.begin();
        for (std::size_t r = 0; r < process_count; ++r) {
            const auto end = std::partition_point(
                begin, pairs.end(), [&](const Ends& pair) { return pair[0] / block == r; });
            questions[r].assign(begin, end);
            begin = end;
        }
        pairs = {};
        asked = processes.all_to_all(questions);
    }

    std::vector<Ends> known;
    std::size_t known_count = 0;
    for (const auto& from_one : asked) known_count += from_one.size();
    known.reserve(known_count);
    for (const auto& from_one : asked) known.insert(known.end(), from_one.begin(), from_one.end());
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    const std::uint64_t first = total + processes.sum_before(known.size());
    total += processes.sum(known.size());

    std::vector<std::vector<std::uint64_t>> answers(process_count);
    for (std::size_t r = 0; r < process_count; ++r) {
        answers[r].reserve(asked[r].size());
        for (const Ends& pair : asked[r]) {
            const auto place = std::ranges::lower_bound(known, pair);
            answers[r].push_back(first + static_cast<std::uint64_t>(place - known.begin()));
        }
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
