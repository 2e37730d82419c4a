#include <octetra/core/process_group.hpp>

#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {
namespace {

using Bytes = ProcessGroup::Bytes;

enum class Outcome : unsigned char { done, bad_input, system_failed };

/// Serialises an outcome and a message.
Bytes packed(Outcome outcome, const std::string& what) {
    Bytes bytes(1 + what.size());
    bytes[0] = static_cast<std::byte>(outcome);
    std::memcpy(bytes.data() + 1, what.data(), what.size());
    return bytes;
}

std::string text_of(const Bytes& bytes, std::size_t begin) {
    return {reinterpret_cast<const char*>(bytes.data()) + begin, bytes.size() - begin};
}

Bytes outcome_of(const std::function<void()>& work) {
    try {
        work();
        return packed(Outcome::done, {});
    } catch (const InputError& error) {
        return packed(Outcome::bad_input, error.what());
    } catch (const std::bad_alloc&) {
        return packed(Outcome::system_failed, "out of memory");
    } catch (const std::exception& error) {
        return packed(Outcome::system_failed, error.what());
    }
}

Bytes bytes_of(std::uint64_t number) {
    Bytes bytes(sizeof number);
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

std::uint64_t number_of(const Bytes& bytes) {
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

/// Returns the sum of the numbers of processes 0 .. end - 1.
std::uint64_t sum_to(int end, std::uint64_t number, const ProcessGroup& group) {
    const auto all = group.of_all(bytes_of(number));
    std::uint64_t sum = 0;
    for (int r = 0; r < end; ++r) sum += number_of(all[static_cast<std::size_t>(r)]);
    return sum;
}

}  // namespace

std::vector<Bytes> ProcessGroup::of_all(Bytes bytes) const {
    return exchange(std::vector<Bytes>(static_cast<std::size_t>(size()), std::move(bytes)));
}

std::uint64_t ProcessGroup::sum(std::uint64_t number) const {
    return sum_to(size(), number, *this);
}

std::uint64_t ProcessGroup::sum_before(std::uint64_t number) const {
    return sum_to(rank(), number, *this);
}

ProcessGroup::Bytes ProcessGroup::of_first(Bytes bytes) const {
    std::vector<Bytes> to_each(static_cast<std::size_t>(size()));
    if (is_first()) to_each.assign(to_each.size(), bytes);
    return std::move(exchange(std::move(to_each)).front());
}

std::uint64_t ProcessGroup::of_first(std::uint64_t number) const {
    return number_of(of_first(bytes_of(number)));
}

void ProcessGroup::on_first(const std::function<void()>& work) const {
    const Bytes outcome = of_first(is_first() ? outcome_of(work) : Bytes{});
    switch (static_cast<Outcome>(outcome.front())) {
        case Outcome::done: return;
        case Outcome::bad_input: throw InputError(text_of(outcome, 1));
        case Outcome::system_failed: throw SystemError(text_of(outcome, 1));
    }
}

void ProcessGroup::agree(const std::string& failure) const {
    if (sum(failure.empty() ? 0 : 1) == 0) return;
    const std::vector<Bytes> all = of_all(packed(Outcome::system_failed, failure));
    for (const Bytes& one : all) {
        if (one.size() > 1) throw SystemError(text_of(one, 1));
    }
}

void ProcessGroup::check_same(std::string_view name, const std::string& value) const {
    Bytes own(value.size());
    std::memcpy(own.data(), value.data(), value.size());
    const std::vector<Bytes> all = of_all(std::move(own));
    for (std::size_t r = 1; r < all.size(); ++r) {
        check_same_as_first(static_cast<int>(r), name, text_of(all[r], 0), text_of(all[0], 0));
    }
}

void ProcessGroup::check_same_as_first(int rank, std::string_view name, std::string_view value,
                                       std::string_view of_first) {
    if (value == of_first) return;
    throw InputError(
        fmt::format("rank {}: the {} is {}, and {} on rank 0: all ranks must pass the same", rank,
                    name, value, of_first));
}

const ProcessGroup& ProcessGroup::alone() {
    static const ProcessGroup group;
    return group;
}

}  // namespace octetra
