#include "coarsen/coarser_numbers.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>

namespace octetra::distributed {
namespace {

/// Encoded numbers of vertices, ascending: of removed vertices, and of vertices whose new numbers
/// are requested.
using EncodedNumbers = std::vector<std::uint64_t>;

std::uint64_t request(GlobalVertex number, bool is_removed) {
    return static_cast<std::uint64_t>(number) << 1U | (is_removed ? 1U : 0U);
}
bool is_removal(std::uint64_t request) { return (request & 1U) != 0; }

/// Collective. Returns the first vertex of this process whose global number is at least the
/// smallest removed one. Local numbers have the order of global ones.
VertexIndex first_changed(const Communicator& processes, const CanonicalNumbers& numbers,
                          VertexIndex first_removed) {
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const auto& of_vertex = numbers.of_vertex;
    const bool has_any = first_removed < of_vertex.end_index();
    const std::uint64_t here =
        has_any ? static_cast<std::uint64_t>(of_vertex[first_removed]) : none;
    const GlobalVertex least{none - processes.max(none - here)};
    return VertexIndex{
        static_cast<std::size_t>(std::ranges::lower_bound(of_vertex, least) - of_vertex.begin())};
}

/// Returns the messages to each rank, for the numbers of its block. A removed vertex is reported by
/// its owner only.
std::vector<EncodedNumbers> requests_of(const CanonicalNumbers& numbers,
                                        const Sharing<VertexIndex>& sharing,
                                        const KeptVertices& kept, VertexIndex first,
                                        int process_count) {
    const std::uint64_t block =
        numbers.vertex_count / static_cast<std::uint64_t>(process_count) + 1;
    std::vector<EncodedNumbers> requests(static_cast<std::size_t>(process_count));
    for (VertexIndex v = first; v < kept.end_index(); ++v) {
        const bool is_removed = kept[v] == 0;
        if (is_removed && !sharing.is_owned(v)) continue;
        const GlobalVertex number = numbers.of_vertex[v];
        requests[static_cast<std::uint64_t>(number) / block].push_back(request(number, is_removed));
    }
    return requests;
}

/// Returns the removed vertices of one block as reported by all processes, ascending.
std::vector<std::uint64_t> removed_in_block(const std::vector<EncodedNumbers>& received_requests) {
    std::vector<std::uint64_t> removed;
    for (const EncodedNumbers& requests : received_requests) {
        std::ranges::copy_if(requests, std::back_inserter(removed), is_removal);
    }
    std::ranges::sort(removed);
    return removed;
}

/// Returns the number of removed vertices before each requested vertex, including those before the
/// block.
std::vector<std::vector<std::uint64_t>> answers_to(
    const std::vector<EncodedNumbers>& received_requests, const std::vector<std::uint64_t>& removed,
    std::uint64_t removed_before) {
    std::vector<std::vector<std::uint64_t>> answers(received_requests.size());
    for (std::size_t r = 0; r < received_requests.size(); ++r) {
        auto next = removed.begin();
        for (const std::uint64_t request : received_requests[r]) {
            if (is_removal(request)) continue;
            next = std::lower_bound(next, removed.end(), request);
            answers[r].push_back(removed_before +
                                 static_cast<std::uint64_t>(next - removed.begin()));
        }
    }
    return answers;
}

/// Returns the requested numbers after subtraction of the answers.
std::vector<GlobalVertex> renumbered_after_removal(
    const std::vector<EncodedNumbers>& requests,
    const std::vector<std::vector<std::uint64_t>>& answers) {
    std::vector<GlobalVertex> after;
    for (std::size_t r = 0; r < requests.size(); ++r) {
        auto less = answers[r].begin();
        for (const std::uint64_t request : requests[r]) {
            if (!is_removal(request)) after.push_back(GlobalVertex{(request >> 1U) - *less++});
        }
    }
    return after;
}

}  // namespace

CoarserNumbers coarser_numbers(const Communicator& processes, const CanonicalNumbers& numbers,
                               const Sharing<VertexIndex>& sharing, const KeptVertices& kept,
                               const CoarserPart& part) {
    CoarserNumbers after{.first = first_changed(processes, numbers, part.first_removed)};
    if (processes.size() == 1) {
        const std::size_t count = part.vertices_before.size();
        for (std::size_t v = after.first.value(); v < count; ++v) {
            after.from_first.push_back(GlobalVertex{v});
        }
        after.vertex_count = count;
        return after;
    }
    const auto requests = requests_of(numbers, sharing, kept, after.first, processes.size());
    const auto received_requests = processes.all_to_all(requests);
    const std::vector<std::uint64_t> removed = removed_in_block(received_requests);
    const std::uint64_t removed_before = processes.sum_before(removed.size());
    after.vertex_count = numbers.vertex_count - processes.sum(removed.size());
    const auto answers =
        processes.all_to_all(answers_to(received_requests, removed, removed_before));
    after.from_first = renumbered_after_removal(requests, answers);
    return after;
}

void commit_numbers(const CoarserNumbers& after, const CoarserPart& part,
                    CanonicalNumbers& numbers) noexcept {
    auto& of_vertex = numbers.of_vertex;
    of_vertex.resize(part.vertices_before.size());
    std::ranges::copy(after.from_first, of_vertex.begin() + after.first.value());
    numbers.vertex_count = after.vertex_count;
    if (of_vertex.size() < of_vertex.capacity() / 2) of_vertex.shrink_to_fit();
}

}  // namespace octetra::distributed
