#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/exchange.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed::detail {

void exchange_values(const Communicator& processes, const ValueExchange& exchange) {
    std::vector<int> ranks;
    std::vector<std::vector<std::byte>> outboxes;
    LocalFailure failure;
    failure.attempt([&] {
        if (exchange.value_count != exchange.value_count_needed) {
            throw InputError(
                fmt::format("rank {}: {} values for shared entities, and {} are needed",
                            processes.rank(), exchange.value_count, exchange.value_count_needed));
        }
        for (std::size_t n = 0; n < exchange.neighbour_count; ++n) {
            ranks.push_back(exchange.rank(n));
            outboxes.emplace_back(exchange.bytes_sent(n));
            exchange.pack(n, outboxes.back().data());
        }
    });
    failure.agree(processes);
    std::vector<std::vector<std::byte>> inboxes;
    failure.attempt([&] { inboxes = processes.exchange_with(ranks, outboxes); });
    failure.agree(processes);
    for (std::size_t n = 0; n < inboxes.size(); ++n) exchange.unpack(n, inboxes[n].data());
}

}  // namespace octetra::distributed::detail
