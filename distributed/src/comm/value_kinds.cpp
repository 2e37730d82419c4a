#include "comm/value_kinds.hpp"

#include <cxxabi.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <typeinfo>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::distributed {
namespace {

std::string name_of(const std::type_info& type) {
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> name(
        abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), &std::free);
    return name == nullptr ? type.name() : name.get();
}

std::string text_of(const detail::ValueKind& kind) {
    const std::string count = kind.are_lists ? "lists" : fmt::format("{}", kind.components);
    const std::string copied =
        fmt::format("{} of {} for each {}", count, name_of(*kind.type), name_of(*kind.entity));
    if (kind.operation == nullptr) return copied;
    return fmt::format("{}, combined by {}", copied, name_of(*kind.operation));
}

}  // namespace

void agree_on_kind(const Communicator& processes, const detail::ValueKind& kind) {
    processes.check_same("kind of the values", text_of(kind));
}

void agree_on_sizes(const Communicator& processes, std::span<const int> senders,
                    const std::vector<std::vector<std::byte>>& messages,
                    const std::function<std::size_t(std::size_t n)>& expected) {
    processes.agree_on_success();
    for (std::size_t n = 0; n < messages.size(); ++n) {
        check_message_size(processes, senders[n], messages[n].size(), expected(n));
    }
    processes.agree_on_success();
}

void check_message_size(const Communicator& processes, int sender, std::size_t size,
                        std::size_t expected) {
    if (size == expected) return;
    throw InputError(fmt::format(
        "rank {}: rank {} sends {} bytes of values, and {} are expected: all ranks must "
        "pass objects of the same mesh",
        processes.rank(), sender, size, expected));
}

}  // namespace octetra::distributed
