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
class Progress {
public:
    explicit Progress(const ProcessGroup& group) : group_(&group) {}

    [[nodiscard]] const ProcessGroup& group() const { return *group_; }

    /// Calls `work`, unless something has failed. The error is not kept, because the process that
    /// reads the file alone afterwards reports it; only std::bad_alloc is kept.
    void attempt(auto&& work) noexcept {
        if (!is_well_) return;
        try {
            work();
        } catch (const std::bad_alloc&) {
            is_well_ = false;
            no_memory_ = std::current_exception();
        } catch (...) {
            is_well_ = false;
        }
    }

    /// Collective. Returns whether no process has failed. Rethrows the std::bad_alloc of this
    /// process.
    [[nodiscard]] bool all_well() const {
        const bool well = group_->sum(is_well_ ? 0 : 1) == 0;
        if (no_memory_) std::rethrow_exception(no_memory_);
        return well;
    }

private:
    const ProcessGroup* group_;
    bool is_well_ = true;
    std::exception_ptr no_memory_;
};

/// Collective. Broadcasts the values of the first process, bit by bit; the number of values must be
/// equal on all. Returns false on all processes if one has failed.
template <class T>
[[nodiscard]] bool take_from_first(Progress& progress, std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    ProcessGroup::Bytes bytes;
    progress.attempt([&] {
        bytes.resize(values.size_bytes());
        std::memcpy(bytes.data(), values.data(), bytes.size());
    });
    if (!progress.all_well()) return false;
    bytes = progress.group().of_first(std::move(bytes));
    std::memcpy(values.data(), bytes.data(), values.size_bytes());
    return true;
}
template <class T>
[[nodiscard]] bool take_from_first(Progress& progress, T& value) {
    return take_from_first(progress, std::span(&value, 1));
}

/// Collective. Returns the values of all processes, in the order of ranks. Valid only if
/// all_well().
template <class T>
[[nodiscard]] std::vector<T> of_each(Progress& progress, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    ProcessGroup::Bytes own;
    progress.attempt([&] {
        own.resize(sizeof value);
        std::memcpy(own.data(), &value, sizeof value);
    });
    std::vector<T> values;
    if (!progress.all_well()) return values;
    progress.attempt([&] {
        for (const ProcessGroup::Bytes& bytes : progress.group().of_all(std::move(own))) {
            std::memcpy(&values.emplace_back(), bytes.data(), sizeof value);
        }
    });
    return values;
}

}  // namespace octetra
