#include <span>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/exchange.hpp>

#include "comm/value_kinds.hpp"

namespace octetra::distributed::detail {

namespace {

/// Collective. Returns the messages of the neighbours; all have the expected sizes.
std::vector<std::vector<std::byte>> exchange_messages(const Communicator& processes,
                                                      const ValueExchange& exchange) {
    const std::size_t entry_size = exchange.kind.entry_size();
    const std::size_t needed = exchange.entity_count * exchange.kind.components;
    if (exchange.value_count != needed) {
        throw InputError(fmt::format("rank {}: {} values for shared entities, and {} are needed",
                                     processes.rank(), exchange.value_count, needed));
    }
    std::vector<int> ranks;
    std::vector<std::vector<std::byte>> outboxes;
    for (std::size_t n = 0; n < exchange.neighbour_count; ++n) {
        ranks.push_back(exchange.rank(n));
        outboxes.emplace_back(exchange.entities_sent(n) * entry_size);
        exchange.pack(n, outboxes.back().data());
    }
    agree_on_kind(processes, exchange.kind);
    auto inboxes = processes.exchange_after_agreement(std::span<const int>(ranks), outboxes);
    processes.agree_on_success();
    for (std::size_t n = 0; n < inboxes.size(); ++n) {
        check_message_size(processes, ranks[n], inboxes[n].size(),
                           exchange.entities_received(n) * entry_size);
    }
    return inboxes;
}

}  // namespace

void exchange_values(const Communicator& processes, const ValueExchange& exchange) {
    const auto inboxes =
        processes.transaction([&] { return exchange_messages(processes, exchange); });
    for (std::size_t n = 0; n < inboxes.size(); ++n) exchange.unpack(n, inboxes[n].data());
}

}  // namespace octetra::distributed::detail
