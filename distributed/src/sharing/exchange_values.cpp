#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/exchange.hpp>

#include "comm/local_failure.hpp"
#include "comm/value_kinds.hpp"

namespace octetra::distributed::detail {

void exchange_values(const Communicator& processes, const ValueExchange& exchange) {
    const std::size_t entry_size = exchange.kind.entry_size();
    std::vector<int> ranks;
    std::vector<std::vector<std::byte>> outboxes;
    LocalFailure failure;
    failure.attempt([&] {
        const std::size_t needed = exchange.entity_count * exchange.kind.components;
        if (exchange.value_count != needed) {
            throw InputError(
                fmt::format("rank {}: {} values for shared entities, and {} are needed",
                            processes.rank(), exchange.value_count, needed));
        }
        for (std::size_t n = 0; n < exchange.neighbour_count; ++n) {
            ranks.push_back(exchange.rank(n));
            outboxes.emplace_back(exchange.entities_sent(n) * entry_size);
            exchange.pack(n, outboxes.back().data());
        }
    });
    agree_on_kind(processes, failure, exchange.kind);
    std::vector<std::vector<std::byte>> inboxes;
    failure.attempt([&] { inboxes = processes.exchange_with(ranks, outboxes); });
    agree_on_sizes(processes, failure, ranks, inboxes,
                   [&](std::size_t n) { return exchange.entities_received(n) * entry_size; });
    for (std::size_t n = 0; n < inboxes.size(); ++n) exchange.unpack(n, inboxes[n].data());
}

}  // namespace octetra::distributed::detail
