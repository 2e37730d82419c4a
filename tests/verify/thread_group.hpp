#pragma once

#include <barrier>
#include <functional>
#include <thread>
#include <vector>

#include <octetra/core/process_group.hpp>

namespace octetra::test {

/// Threads in place of processes, for what knows of others by ProcessGroup alone.
class ThreadGroup final : public ProcessGroup {
public:
    struct Board {
        explicit Board(int size) : meeting(size), outboxes(static_cast<std::size_t>(size)) {}
        std::barrier<> meeting;
        std::vector<std::vector<Bytes>> outboxes;  ///< of each thread, to each
    };

    ThreadGroup(Board& board, int rank) : board_(&board), rank_(rank) {}

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return static_cast<int>(board_->outboxes.size()); }

    [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> to_each) const override {
        const auto own = static_cast<std::size_t>(rank_);
        board_->outboxes[own] = std::move(to_each);
        board_->meeting.arrive_and_wait();
        std::vector<Bytes> received;
        for (auto& outboxes : board_->outboxes) received.push_back(std::move(outboxes.at(own)));
        board_->meeting.arrive_and_wait();
        return received;
    }

private:
    Board* board_;
    int rank_;
};

/// Runs work(group) on so many threads.
inline void run_together(int size, const std::function<void(const ProcessGroup&)>& work) {
    ThreadGroup::Board board(size);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size; ++rank) {
        threads.emplace_back([&board, &work, rank] { work(ThreadGroup(board, rank)); });
    }
    for (std::thread& thread : threads) thread.join();
}

}  // namespace octetra::test
