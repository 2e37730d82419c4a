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

/// A group of processes that work together. This class is a group of one process; derived classes
/// represent larger groups. Core and the verifier are thus independent of the communication
/// library.
///
/// All functions except rank(), size() and is_first() are collective: every process of the group
/// calls them, in the same order. A derived class must override rank(), size() and exchange();
/// sums, of_all() and of_first() are implemented by means of exchange() and can be overridden by
/// faster versions.
class ProcessGroup {
public:
    using Bytes = std::vector<std::byte>;

    ProcessGroup() = default;
    virtual ~ProcessGroup() = default;

    [[nodiscard]] virtual int rank() const { return 0; }
    [[nodiscard]] virtual int size() const { return 1; }
    [[nodiscard]] bool is_first() const { return rank() == 0; }

    /// Sends to_each[r] to process r, for each of the size() processes; element [r] of the result
    /// was received from process r.
    [[nodiscard]] virtual std::vector<Bytes> exchange(std::vector<Bytes> to_each) const {
        return to_each;
    }

    /// Returns the contributions of all processes, by rank. Intended for few bytes, since every
    /// process receives those of all.
    [[nodiscard]] virtual std::vector<Bytes> of_all(Bytes bytes) const;

    /// The sum over all processes, and over those of lower rank. Floating-point arguments are
    /// deleted because they would be truncated silently.
    [[nodiscard]] virtual std::uint64_t sum(std::uint64_t number) const;
    [[nodiscard]] virtual std::uint64_t sum_before(std::uint64_t number) const;
    void sum(std::floating_point auto number) const = delete;
    void sum_before(std::floating_point auto number) const = delete;

    /// Returns the argument of the first process.
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

    [[nodiscard]] virtual bool is_in_transaction() const { return false; }

    /// Runs `work` on the first process while the others wait. An exception there is thrown on all
    /// processes: an InputError as such, any other as a SystemError.
    void on_first(const std::function<void()>& work) const;

    /// Throws a SystemError on all processes if any of them passes a failure ("" means none); the
    /// message is that of the lowest rank with a failure.
    void agree(const std::string& failure) const;

    /// Throws InputError on all processes, with the same message, unless all pass the same `value`
    /// for the argument called `name`.
    virtual void check_same(std::string_view name, const std::string& value) const;
    /// Implements overrides of check_same(). Not collective: throws InputError unless `value`,
    /// passed by process `rank`, equals that of the first process.
    static void check_same_as_first(int rank, std::string_view name, std::string_view value,
                                    std::string_view of_first);

    /// The group of this process alone.
    [[nodiscard]] static const ProcessGroup& alone();

private:
    virtual void run_transaction(const std::function<void()>& work) const { work(); }

protected:  // copied only by derived classes that are value types
    ProcessGroup(const ProcessGroup&) = default;
    ProcessGroup& operator=(const ProcessGroup&) = default;
    ProcessGroup(ProcessGroup&&) = default;
    ProcessGroup& operator=(ProcessGroup&&) = default;
};

}  // namespace octetra
