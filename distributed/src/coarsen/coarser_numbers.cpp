#include "coarsen/coarser_numbers.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>

namespace octetra::distributed {
namespace {

/// Encoded numbers of vertices, ascending: of removed vertices, and of vertices whose new numbers
/// are requested.
using Questions = std::vector<std::uint64_t>;

std::uint64_t question(GlobalVertex number, bool goes) {
    return static_cast<std::uint64_t>(number) << 1U | (goes ? 1U : 0U);
}
bool tells_of_gone(std::uint64_t question) { return (question & 1U) != 0; }

/// Collective. Returns the first vertex of this process whose global number is at least the
/// smallest removed one. Local numbers have the order of global ones.
VertexIndex first_changed(const Communicator& processes, const CanonicalNumbers& numbers,
                          VertexIndex first_gone) {
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const auto& of_vertex = numbers.of_vertex;
    const bool has_any = first_gone < of_vertex.end_index();
    const std::uint64_t here = has_any ? static_cast<std::uint64_t>(of_vertex[first_gone]) : none;
    const GlobalVertex least{none - processes.max(none - here)};
    return VertexIndex{
        static_cast<std::size_t>(std::ranges::lower_bound(of_vertex, least) - of_vertex.begin())};
}

/// Returns the messages to each rank, for the numbers of its block. A removed vertex is reported by
/// its owner only.
std::vector<Questions> questions_of(const CanonicalNumbers& numbers,
                                    const Sharing<VertexIndex>& sharing, const KeptVertices& kept,
                                    VertexIndex first, int process_count) {
    const std::uint64_t block =
        numbers.vertex_count / static_cast<std::uint64_t>(process_count) + 1;
    std::vector<Questions> questions(static_cast<std::size_t>(process_count));
    for (VertexIndex v = first; v < kept.end_index(); ++v) {
        const bool goes = kept[v] == 0;
        if (goes && !sharing.is_owned(v)) continue;
        const GlobalVertex number = numbers.of_vertex[v];
        questions[static_cast<std::uint64_t>(number) / block].push_back(question(number, goes));
    }
    return questions;
}

/// Returns the removed vertices of one block as reported by all processes, ascending.
std::vector<std::uint64_t> gone_of_block(const std::vector<Questions>& asked) {
    std::vector<std::uint64_t> gone;
    for (const Questions& questions : asked) {
        std::ranges::copy_if(questions, std::back_inserter(gone), tells_of_gone);
    }
    std::ranges::sort(gone);
    return gone;
}

/// Returns the number of removed vertices before each requested vertex, including those before the
/// block.
std::vector<std::vector<std::uint64_t>> answers_to(const std::vector<Questions>& asked,
                                                   const std::vector<std::uint64_t>& gone,
                                                   std::uint64_t gone_before) {
    std::vector<std::vector<std::uint64_t>> answers(asked.size());
    for (std::size_t r = 0; r < asked.size(); ++r) {
        auto next = gone.begin();
        for (const std::uint64_t question : asked[r]) {
            if (tells_of_gone(question)) continue;
            next = std::lower_bound(next, gone.end(), question);
            answers[r].push_back(gone_before + static_cast<std::uint64_t>(next - gone.begin()));
        }
    }
    return answers;
}

/// Returns the requested numbers after subtraction of the answers. A process that has failed sends
/// no answers.
std::vector<GlobalVertex> lessened(const std::vector<Questions>& questions,
                                   const std::vector<std::vector<std::uint64_t>>& answers) {
    std::vector<GlobalVertex> after;
    for (std::size_t r = 0; r < questions.size(); ++r) {
        if (answers[r].empty()) continue;
        auto less = answers[r].begin();
        for (const std::uint64_t question : questions[r]) {
            if (!tells_of_gone(question)) after.push_back(GlobalVertex{(question >> 1U) - *less++});
        }
    }
    return after;
}

}  // namespace

CoarserNumbers coarser_numbers(const Communicator& processes, const CanonicalNumbers& numbers,
                               const Sharing<VertexIndex>& sharing, const KeptVertices& kept,
                               const CoarserPart& part, LocalFailure& failure) {
    CoarserNumbers after{.first = first_changed(processes, numbers, part.first_gone)};
    if (processes.size() == 1) {
        failure.attempt([&] {
            const std::size_t count = part.vertices_before.size();
            for (std::size_t v = after.first.value(); v < count; ++v) {
                after.from_first.push_back(GlobalVertex{v});
            }
            after.vertex_count = count;
        });
        return after;
    }
    const auto somewhere_failed = [&] {
        return failure.max_unless_failed(processes, 0) == LocalFailure::somewhere;
    };
    std::vector<Questions> questions;
    failure.attempt(
        [&] { questions = questions_of(numbers, sharing, kept, after.first, processes.size()); });
    if (somewhere_failed()) return after;
    std::vector<Questions> asked;
    std::vector<std::uint64_t> gone;
    failure.attempt([&] {
        asked = processes.all_to_all(questions);
        gone = gone_of_block(asked);
    });
    const std::uint64_t gone_before = processes.sum_before(gone.size());
    after.vertex_count = numbers.vertex_count - processes.sum(gone.size());
    std::vector<std::vector<std::uint64_t>> answers;
    failure.attempt([&] { answers = answers_to(asked, gone, gone_before); });
    if (somewhere_failed()) return after;
    failure.attempt([&] { after.from_first = lessened(questions, processes.all_to_all(answers)); });
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
