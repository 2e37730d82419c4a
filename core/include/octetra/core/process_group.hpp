#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octetra {

/// The processes that work on something together: this class is one process alone, a derived one
/// speaks for more. How they talk to each other is nothing that core or the verifier need know.
///
/// All functions but rank(), size() and is_first() are collective: every process of the group calls
/// them, in the same order. A derived class has to say who there is and to exchange(); the sums,
/// of_all() and of_first() are made of that, and are there to be overridden by who does it better.
class ProcessGroup {
public:
    using Bytes = std::vector<std::byte>;

    ProcessGroup() = default;
    virtual ~ProcessGroup() = default;

    [[nodiscard]] virtual int rank() const { return 0; }
    [[nodiscard]] virtual int size() const { return 1; }
    [[nodiscard]] bool is_first() const { return rank() == 0; }

    /// to_each[r], of which there are size(), goes to process r; the result's [r] came from there.
    [[nodiscard]] virtual std::vector<Bytes> exchange(std::vector<Bytes> to_each) const {
        return to_each;
    }

    /// What each process has, by rank: few bytes, as every process gets those of all.
    [[nodiscard]] virtual std::vector<Bytes> of_all(Bytes bytes) const;

    /// The sum over all processes, and over those of lower rank. Of whole numbers alone: others
    /// would be cut off without a word.
    [[nodiscard]] virtual std::uint64_t sum(std::uint64_t number) const;
    [[nodiscard]] virtual std::uint64_t sum_before(std::uint64_t number) const;
    void sum(std::floating_point auto number) const = delete;
    void sum_before(std::floating_point auto number) const = delete;

    /// What the first process has.
    [[nodiscard]] virtual Bytes of_first(Bytes bytes) const;
    [[nodiscard]] std::uint64_t of_first(std::uint64_t number) const;
    void of_first(std::floating_point auto number) const = delete;

    /// Runs `work`, which may call collective functions and may throw on any process, and returns
    /// what it returns. An exception on one process ends the work on all: the others leave it at
    /// their next collective function. Then all throw the exception of the lowest process that
    /// failed first: InputError as it is, std::bad_alloc with the number of the process, all else
    /// as SystemError. `work` must leave objects that outlive it as they were when it throws, and
    /// must not catch exceptions of collective functions. A transaction within another is part of
    /// that one.
    template <class Work>
    std::invoke_result_t<Work&> transaction(Work&& work) const {
        using Result = std::invoke_result_t<Work&>;
        if constexpr (std::is_void_v<Result>) {
            run_transaction(std::ref(work));
        } else {
            std::optional<Result> result;
            run_transaction([&] { result.emplace(work()); });
            return std::move(*result);
        }
    }

    /// Runs `work` on the first process, while the others wait. What it throws there is thrown on
    /// all: an InputError as such, all else as SystemError.
    void on_first(const std::function<void()>& work) const;

    /// Throws a SystemError on all processes if one of them has met a failure, "" being none: that
    /// of the lowest rank which has.
    void agree(const std::string& failure) const;

    /// Throws InputError on all processes, in the same words, unless all pass the same `value` of
    /// the argument called `name`.
    virtual void check_same(std::string_view name, const std::string& value) const;
    /// For those who implement it. Not collective: throws InputError unless `value`, which process
    /// `rank` passes, is that of the first process.
    static void check_same_as_first(int rank, std::string_view name, std::string_view value,
                                    std::string_view of_first);

    /// For what one process does on its own.
    [[nodiscard]] static const ProcessGroup& alone();

private:
    virtual void run_transaction(const std::function<void()>& work) const { work(); }

protected:  // copies are made by derived classes, for those that are values
    ProcessGroup(const ProcessGroup&) = default;
    ProcessGroup& operator=(const ProcessGroup&) = default;
    ProcessGroup(ProcessGroup&&) = default;
    ProcessGroup& operator=(ProcessGroup&&) = default;
};

}  // namespace octetra
