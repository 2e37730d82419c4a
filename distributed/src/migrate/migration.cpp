#include <octetra/distributed/migration.hpp>

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "comm/value_kinds.hpp"
#include "migrate/exchange_entities.hpp"

namespace octetra::distributed {
namespace {

void check(const Communicator& processes, std::size_t count, std::size_t needed) {
    if (count == needed) return;
    throw InputError(
        fmt::format("rank {}: {} values do not match the mesh before the migration, which needs {}",
                    processes.rank(), count, needed));
}

void check(const Communicator& processes, std::span<const std::uint64_t> begin, std::size_t values,
           std::size_t needed) {
    if (begin.size() != needed + 1) {
        throw InputError(
            fmt::format("rank {}: {} offsets of lists do not match the mesh before the migration, "
                        "which needs {}; the last one is the number of values",
                        processes.rank(), begin.size(), needed + 1));
    }
    if (begin.front() != 0 || !std::ranges::is_sorted(begin)) {
        throw InputError(fmt::format("rank {}: offsets of lists must begin with 0 and ascend",
                                     processes.rank()));
    }
    check(processes, values, begin.back());
}

void copy(std::byte* to, const std::byte* from, std::size_t size) {
    if (size > 0) std::memcpy(to, from, size);
}

/// Replaces the lengths of lists by their offsets, and appends the end of the last list.
void sum_up(std::vector<std::uint64_t>& lengths) {
    std::uint64_t end = 0;
    for (std::uint64_t& length : lengths) end += std::exchange(length, end);
    lengths.push_back(end);
}

}  // namespace

void Migration::check_values(const Entities& entities, std::size_t count,
                             const detail::ValueKind& kind) const {
    if (!has_counts_) return;
    processes_.transaction([&] {
        check(processes_, count, entities.count_before * kind.components);
        agree_on_kind(processes_, kind);
    });
}

void Migration::check_lists(const Entities& entities, std::span<const std::uint64_t> begin,
                            std::size_t count, const detail::ValueKind& kind) const {
    if (!has_counts_) return;
    processes_.transaction([&] {
        check(processes_, begin, count, entities.count_before);
        agree_on_kind(processes_, kind);
    });
}

void Migration::move_values(const Entities& entities, std::span<const std::byte> values,
                            const detail::ValueKind& kind, const Allocate& allocate) const {
    const std::size_t size = kind.entry_size();
    const auto pack = [&](const std::vector<std::uint32_t>& sent) {
        MessageBytes message(sent.size() * size);
        for (std::size_t k = 0; k < sent.size(); ++k) {
            copy(message.data() + k * size, values.data() + sent[k] * size, size);
        }
        return message;
    };
    const auto take = [&](const std::vector<MessageBytes>& messages) {
        std::byte* const after = allocate(entities.count_after);
        for (std::size_t p = 0; p < messages.size(); ++p) {
            const auto& received = entities.messages[p].received;
            check_message_size(processes_, partners_[p], messages[p].size(),
                               received.size() * size);
            for (std::size_t k = 0; k < received.size(); ++k) {
                if (received[k] == repeated) continue;
                copy(after + received[k] * size, messages[p].data() + k * size, size);
            }
        }
    };
    processes_.transaction([&] {
        check(processes_, values.size() / kind.size, entities.count_before * kind.components);
        agree_on_kind(processes_, kind);
        exchange_entities(processes_, partners_, entities, pack, take);
    });
}

void Migration::move_lists(const Entities& entities, std::span<const std::uint64_t> begin,
                           std::span<const std::byte> values, const detail::ValueKind& kind,
                           std::vector<std::uint64_t>& begin_after,
                           const Allocate& allocate) const {
    const std::size_t size = kind.size;
    // The message has the lengths of all lists, followed by the lists.
    const auto pack = [&](const std::vector<std::uint32_t>& sent) {
        std::size_t length = sent.size() * sizeof(std::uint64_t);
        for (const std::uint32_t i : sent) length += (begin[i + 1] - begin[i]) * size;
        MessageBytes message(length);
        std::byte* lengths = message.data();
        std::byte* lists = message.data() + sent.size() * sizeof(std::uint64_t);
        for (const std::uint32_t i : sent) {
            const std::uint64_t count = begin[i + 1] - begin[i];
            copy(lengths, reinterpret_cast<const std::byte*>(&count), sizeof count);
            lengths += sizeof count;
            copy(lists, values.data() + begin[i] * size, count * size);
            lists += count * size;
        }
        return message;
    };
    const auto length_at = [](const MessageBytes& message, std::size_t k) {
        std::uint64_t count = 0;
        copy(reinterpret_cast<std::byte*>(&count), message.data() + k * sizeof count, sizeof count);
        return count;
    };
    const auto expected_size = [&](const MessageBytes& message, std::size_t list_count) {
        std::size_t bytes = list_count * sizeof(std::uint64_t);
        if (message.size() < bytes) return bytes;
        for (std::size_t k = 0; k < list_count; ++k) bytes += length_at(message, k) * size;
        return bytes;
    };
    const auto take = [&](const std::vector<MessageBytes>& messages) {
        begin_after.assign(entities.count_after, 0);
        for (std::size_t p = 0; p < messages.size(); ++p) {
            const auto& received = entities.messages[p].received;
            check_message_size(processes_, partners_[p], messages[p].size(),
                               expected_size(messages[p], received.size()));
            for (std::size_t k = 0; k < received.size(); ++k) {
                if (received[k] != repeated) begin_after[received[k]] = length_at(messages[p], k);
            }
        }
        sum_up(begin_after);
        std::byte* const after = allocate(begin_after.back());
        for (std::size_t p = 0; p < messages.size(); ++p) {
            const auto& received = entities.messages[p].received;
            const std::byte* lists = messages[p].data() + received.size() * sizeof(std::uint64_t);
            for (std::size_t k = 0; k < received.size(); ++k) {
                const std::uint64_t bytes = length_at(messages[p], k) * size;
                if (received[k] != repeated) {
                    copy(after + begin_after[received[k]] * size, lists, bytes);
                }
                lists += bytes;
            }
        }
    };
    processes_.transaction([&] {
        check(processes_, begin, values.size() / size, entities.count_before);
        agree_on_kind(processes_, kind);
        exchange_entities(processes_, partners_, entities, pack, take);
    });
}

}  // namespace octetra::distributed
