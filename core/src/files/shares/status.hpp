#pragma once

#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/process_group.hpp>

namespace octetra {

/// The common status of processes that read a file together. Work is attempted between two
/// agreements; an exchange in it must be entered by all processes, even by those that have failed.
/// Within a transaction, failures are those of the transaction: attempt() passes them on.
class CollectiveStatus {
public:
    explicit CollectiveStatus(const ProcessGroup& group) : group_(&group) {}

    [[nodiscard]] const ProcessGroup& group() const { return *group_; }

    /// Calls `work`, unless something has failed. The error is not kept, because the process that
    /// reads the file alone afterwards reports it; only std::bad_alloc is kept.
    void attempt(auto&& work) {
        if (group_->is_in_transaction()) return work();
        if (!has_succeeded_) return;
        try {
            work();
        } catch (const std::bad_alloc&) {
            has_succeeded_ = false;
            no_memory_ = std::current_exception();
        } catch (const std::exception&) {  // the end of a transaction is none of these
            has_succeeded_ = false;
        }
    }

    /// Collective. Returns whether no process has failed. Rethrows the std::bad_alloc of this
    /// process.
    [[nodiscard]] bool all_succeeded() const {
        if (group_->is_in_transaction()) return true;
        const bool succeeded = group_->sum(has_succeeded_ ? 0 : 1) == 0;
        if (no_memory_) std::rethrow_exception(no_memory_);
        return succeeded;
    }

private:
    const ProcessGroup* group_;
    bool has_succeeded_ = true;
    std::exception_ptr no_memory_;
};

/// Collective. Broadcasts the values of the first process, bit by bit; the number of values must be
/// equal on all. Returns false on all processes if one has failed.
template <class T>
[[nodiscard]] bool broadcast_from_first(CollectiveStatus& status, std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    ProcessGroup::Bytes bytes;
    status.attempt([&] {
        bytes.resize(values.size_bytes());
        std::memcpy(bytes.data(), values.data(), bytes.size());
    });
    if (!status.all_succeeded()) return false;
    bytes = status.group().of_first(std::move(bytes));
    std::memcpy(values.data(), bytes.data(), values.size_bytes());
    return true;
}
template <class T>
[[nodiscard]] bool broadcast_from_first(CollectiveStatus& status, T& value) {
    return broadcast_from_first(status, std::span(&value, 1));
}

/// Collective. Returns the values of all processes, in the order of ranks. Valid only if
/// all_succeeded().
template <class T>
[[nodiscard]] std::vector<T> of_each(CollectiveStatus& status, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    ProcessGroup::Bytes own;
    status.attempt([&] {
        own.resize(sizeof value);
        std::memcpy(own.data(), &value, sizeof value);
    });
    std::vector<T> values;
    if (!status.all_succeeded()) return values;
    status.attempt([&] {
        for (const ProcessGroup::Bytes& bytes : status.group().of_all(std::move(own))) {
            std::memcpy(&values.emplace_back(), bytes.data(), sizeof value);
        }
    });
    return values;
}

}  // namespace octetra
