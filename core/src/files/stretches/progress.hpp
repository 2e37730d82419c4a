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

/// Whether processes that read a file together can go on. Work is attempted between two places
/// where all agree; with an exchange in it, all must enter that whatever has failed before.
class Progress {
public:
    explicit Progress(const ProcessGroup& group) : group_(&group) {}

    [[nodiscard]] const ProcessGroup& group() const { return *group_; }

    /// Does the work, unless something has failed. What exactly, whoever reads the file alone will
    /// say; only that there is no memory is kept apart.
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

    /// Collective. Has nothing failed anywhere? Throws the std::bad_alloc that this process has
    /// met.
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

/// Collective. Gives all processes the values of the first one, as many as each has, bit by bit.
/// False, on all processes, if something has failed.
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

/// Collective. What each process has, bit by bit, in their order. Of no use unless all_well().
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
