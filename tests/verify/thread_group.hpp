#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <octetra/core/process_group.hpp>

namespace octetra::test {

/// A reusable barrier for this number of threads. (std::barrier of libstdc++ 12 sometimes fails to
/// wake the waiting threads.)
class Barrier {
public:
    explicit Barrier(int size) : size_(size) {}

    void wait() {
        std::unique_lock lock(mutex_);
        const std::uint64_t turn = turn_;
        if (++arrived_ == size_) {
            arrived_ = 0;
            ++turn_;
            all_are_here_.notify_all();
            return;
        }
        all_are_here_.wait(lock, [&] { return turn_ != turn; });
    }

private:
    std::mutex mutex_;
    std::condition_variable all_are_here_;
    int size_;
    int arrived_ = 0;
    std::uint64_t turn_ = 0;
};

/// A ProcessGroup of threads in place of processes.
class ThreadGroup final : public ProcessGroup {
public:
    struct Board {
        explicit Board(int size)
            : barrier(size),
              outboxes(static_cast<std::size_t>(size)),
              failures(static_cast<std::size_t>(size)) {}
        Barrier barrier;
        std::vector<std::vector<Bytes>> outboxes;  ///< of each thread, to each
        std::vector<std::exception_ptr> failures;  ///< of each thread, in a transaction
    };

    ThreadGroup(Board& board, int rank) : board_(&board), rank_(rank) {}

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return static_cast<int>(board_->outboxes.size()); }

    [[nodiscard]] bool is_in_transaction() const override { return is_in_transaction_; }

    [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> to_each) const override {
        if (is_in_transaction_ && !failure_) failure_ = agreed(nullptr);
        if (failure_) throw OthersFailed();
        const auto own = static_cast<std::size_t>(rank_);
        board_->outboxes[own] = std::move(to_each);
        board_->barrier.wait();
        std::vector<Bytes> received;
        for (auto& outboxes : board_->outboxes) received.push_back(std::move(outboxes.at(own)));
        board_->barrier.wait();
        return received;
    }

private:
    struct OthersFailed {};

    void run_transaction(const std::function<void()>& work) const override {
        if (is_in_transaction_) return work();
        is_in_transaction_ = true;
        std::exception_ptr own;
        try {
            work();
        } catch (const OthersFailed&) {
        } catch (...) {
            own = std::current_exception();
        }
        if (!failure_) failure_ = agreed(own);
        is_in_transaction_ = false;
        if (const auto failure = std::exchange(failure_, nullptr)) std::rethrow_exception(failure);
    }
    /// Collective. Returns the failure of the lowest thread that has failed, or null.
    std::exception_ptr agreed(const std::exception_ptr& own) const {
        board_->failures[static_cast<std::size_t>(rank_)] = own;
        board_->barrier.wait();
        const auto failed = std::ranges::find_if(board_->failures, [](auto& f) { return bool(f); });
        const std::exception_ptr first = failed == board_->failures.end() ? nullptr : *failed;
        board_->barrier.wait();
        return first;
    }

    Board* board_;
    int rank_;
    mutable bool is_in_transaction_ = false;
    mutable std::exception_ptr failure_;  ///< of the transaction, once known
};

/// Runs work(group) on this number of threads.
inline void run_together(int size, const std::function<void(const ProcessGroup&)>& work) {
    ThreadGroup::Board board(size);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size; ++rank) {
        threads.emplace_back([&board, &work, rank] { work(ThreadGroup(board, rank)); });
    }
    for (std::thread& thread : threads) thread.join();
}

}  // namespace octetra::test
