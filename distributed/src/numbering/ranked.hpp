#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/compressed_words.hpp"

namespace octetra::distributed {

/// The two ends of an edge, lower first, or the three vertices of a face, as local indices. Local
/// indices ascend as global numbers do.
template <std::size_t N>
using VertexTuple = std::array<VertexIndex, N>;

/// A process's description of its tuples for a rendezvous process: the number of tuples for each
/// lowest vertex. The tuples themselves are included only if other processes have that vertex, too,
/// because these may have the same tuples.
///
/// In 64-bit words, for each lowest vertex: its global number; twice the count, plus 1 if it is
/// shared; and for a shared one, the other N - 1 vertices of each tuple. All are in ascending
/// order.
using Question = std::vector<std::uint64_t>;

/// Returns the question to each process, which answers for a block of lowest numbers.
template <std::size_t N>
std::vector<Question> questions_about(std::span<const VertexTuple<N>> tuples,
                                      const IndexVector<VertexIndex, GlobalVertex>& numbers,
                                      std::span<const VertexIndex> shared_vertices,
                                      std::uint64_t block, int process_count) {
    const auto number_of = [&](VertexIndex v) { return static_cast<std::uint64_t>(numbers[v]); };
    auto shared = shared_vertices.begin();
    const auto is_shared = [&](VertexIndex v) {
        const auto end = shared_vertices.end();
        if (shared != end && *shared < v) shared = std::lower_bound(shared, end, v);
        return shared != end && *shared == v;
    };
    std::vector<Question> questions(static_cast<std::size_t>(process_count));
    for (std::size_t begin = 0, end = 0; begin < tuples.size(); begin = end) {
        const VertexIndex lowest = tuples[begin][0];
        while (end < tuples.size() && tuples[end][0] == lowest) ++end;
        const bool is_included = is_shared(lowest);
        Question& words = questions[number_of(lowest) / block];
        words.push_back(number_of(lowest));
        words.push_back((end - begin) << 1U | (is_included ? 1U : 0U));
        if (!is_included) continue;
        for (const VertexTuple<N>& tuple : tuples.subspan(begin, end - begin)) {
            for (std::size_t k = 1; k < N; ++k) words.push_back(number_of(tuple[k]));
        }
    }
    return questions;
}

/// Iterates over the lowest vertices in a question.
template <std::size_t N>
class QuestionReader {
public:
    using Rest = std::array<std::uint64_t, N - 1>;

    explicit QuestionReader(const Question& words) : words_(words) {}
    [[nodiscard]] bool at_end() const { return words_.empty(); }
    [[nodiscard]] std::uint64_t lowest() const { return words_[0]; }
    [[nodiscard]] std::uint64_t count() const { return words_[1] >> 1U; }
    [[nodiscard]] bool is_shared() const { return (words_[1] & 1U) != 0; }
    /// Returns the other vertices of tuple i of a shared lowest vertex.
    [[nodiscard]] Rest rest(std::size_t i) const {
        Rest rest;
        std::ranges::copy(words_.subspan(2 + i * (N - 1), N - 1), rest.begin());
        return rest;
    }
    void next() { words_ = words_.subspan(2 + (is_shared() ? count() * (N - 1) : 0)); }

private:
    std::span<const std::uint64_t> words_;
};

/// Computes the answers to the questions of all processes: the positions of tuples in the ascending
/// order of all distinct tuples of the block. For a lowest vertex of a single process this is the
/// position of its first tuple; for a shared one, the position of each tuple.
template <std::size_t N>
class Answers {
public:
    explicit Answers(const std::vector<Question>& questions) : to_(questions.size()) {
        for (const Question& question : questions) readers_.emplace_back(question);
        for (std::size_t r = 0; r < readers_.size(); ++r) enqueue(r);
        while (!queue_.empty()) {
            take_all_with_lowest();
            if (ranks_.size() == 1) {
                answer_one(ranks_.front());
                continue;
            }
            answer_several();
            for (const std::size_t r : ranks_) {
                readers_[r].next();
                enqueue(r);
            }
        }
    }

    /// Returns the number of distinct tuples.
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] std::vector<std::vector<std::uint64_t>> take() && { return std::move(to_); }

private:
    using Rest = typename QuestionReader<N>::Rest;

    void enqueue(std::size_t r) {
        if (readers_[r].at_end()) return;
        queue_.emplace_back(readers_[r].lowest(), r);
        std::ranges::push_heap(queue_, std::greater{});
    }
    void take_all_with_lowest() {
        ranks_.clear();
        const std::uint64_t lowest = queue_.front().first;
        while (!queue_.empty() && queue_.front().first == lowest) {
            ranks_.push_back(queue_.front().second);
            std::ranges::pop_heap(queue_, std::greater{});
            queue_.pop_back();
        }
    }
    /// Answers all lowest vertices of process r that precede the next one of any other process.
    void answer_one(std::size_t r) {
        QuestionReader<N>& reader = readers_[r];
        const std::uint64_t end =
            queue_.empty() ? std::numeric_limits<std::uint64_t>::max() : queue_.front().first;
        for (; !reader.at_end() && reader.lowest() < end; reader.next()) {
            const std::uint64_t tuples = reader.count();
            const std::uint64_t answers = reader.is_shared() ? tuples : 1;
            for (std::uint64_t i = 0; i < answers; ++i) to_[r].push_back(count_ + i);
            count_ += tuples;
        }
        enqueue(r);
    }
    void answer_several() {
        different_.clear();
        for_each_rest([&](std::size_t, const Rest& rest) { different_.push_back(rest); });
        std::sort(different_.begin(), different_.end());
        different_.erase(std::unique(different_.begin(), different_.end()), different_.end());
        for_each_rest([&](std::size_t r, const Rest& rest) {
            const auto position = std::lower_bound(different_.begin(), different_.end(), rest);
            to_[r].push_back(count_ + static_cast<std::uint64_t>(position - different_.begin()));
        });
        count_ += different_.size();
    }
    void for_each_rest(auto&& visit) const {
        for (const std::size_t r : ranks_) {
            for (std::size_t i = 0; i < readers_[r].count(); ++i) visit(r, readers_[r].rest(i));
        }
    }

    std::vector<std::vector<std::uint64_t>> to_;
    std::vector<QuestionReader<N>> readers_;
    std::vector<std::pair<std::uint64_t, std::size_t>> queue_;  ///< a heap: lowest, process
    std::vector<std::size_t> ranks_;                            ///< that have the lowest vertex
    std::vector<Rest> different_;
    std::uint64_t count_ = 0;
};

/// Appends the position of each of `count` tuples to `list`, from the answers to this process's
/// questions.
template <std::size_t N>
void append_positions(auto& list, std::size_t count, const std::vector<Question>& questions,
                      const std::vector<std::vector<std::uint64_t>>& answers) {
    using Position = typename std::remove_cvref_t<decltype(list)>::value_type;
    make_room(list, list.size() + count);
    for (std::size_t r = 0; r < questions.size(); ++r) {
        auto answer = answers[r].begin();
        for (QuestionReader<N> reader(questions[r]); !reader.at_end(); reader.next()) {
            if (reader.is_shared()) {
                for (std::uint64_t i = 0; i < reader.count(); ++i)
                    list.push_back(Position{*answer++});
            } else {
                const std::uint64_t first = *answer++;
                for (std::uint64_t i = 0; i < reader.count(); ++i)
                    list.push_back(Position{first + i});
            }
        }
    }
}

/// Collective, within a transaction. Appends to `list` the positions of tuples in the ascending
/// order of all distinct tuples of all processes, counted from `total`, and adds their number to
/// `total`. This process's `tuples` ascend; their vertices have global numbers less than
/// `end_count`. `shared_vertices` are those that other processes have, too, ascending. `list` may
/// be `numbers`, since they are read before `list` is extended; after a failure it may be extended
/// in part.
///
/// Tuples are compared at a rendezvous process that is determined by their lowest vertex. Memory
/// and messages are proportional to the number of lowest vertices plus the number of tuples of
/// shared ones.
template <std::size_t N>
void append_ranked(auto& list, const Communicator& processes,
                   std::span<const VertexTuple<N>> tuples,
                   const IndexVector<VertexIndex, GlobalVertex>& numbers,
                   std::span<const VertexIndex> shared_vertices, std::uint64_t end_count,
                   std::uint64_t& total) {
    const std::uint64_t block = end_count / static_cast<std::uint64_t>(processes.size()) + 1;
    const std::vector<Question> questions =
        questions_about<N>(tuples, numbers, shared_vertices, block, processes.size());
    const auto asked = of_each(processes.all_to_all(of_each(questions, compressed)), decompressed);
    Answers<N> found(asked);
    const std::uint64_t first = total + processes.sum_before(found.count());
    total += processes.sum(found.count());
    std::vector<std::vector<std::uint64_t>> answers = std::move(found).take();
    for (auto& positions : answers) {
        for (std::uint64_t& position : positions) position += first;
    }
    const auto received = processes.all_to_all(of_each(answers, compressed));
    append_positions<N>(list, tuples.size(), questions, of_each(received, decompressed));
}

}  // namespace octetra::distributed
