#include <cstring>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/exchange.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed::detail {

void exchange_values(const Communicator& processes,
                     const std::function<std::vector<ValueLists>()>& lists, std::byte* values,
                     std::size_t value_count, std::size_t value_size, std::size_t components,
                     std::size_t entity_count, Receive receive, void* context) {
    const std::size_t entry_size = value_size * components;
    std::vector<ValueLists> with;
    std::vector<int> ranks;
    std::vector<std::vector<std::byte>> outboxes;
    LocalFailure failure;
    failure.attempt([&] {
        if (value_count != entity_count * components) {
            throw InputError(fmt::format("{} values for {} entities, where {} for each are needed",
                                         value_count, entity_count, components));
        }
        with = lists();
        for (const ValueLists& list : with) {
            ranks.push_back(list.rank);
            auto& outbox = outboxes.emplace_back(list.sent.size() * entry_size);
            for (std::size_t k = 0; k < list.sent.size(); ++k) {
                std::memcpy(outbox.data() + k * entry_size, values + list.sent[k] * entry_size,
                            entry_size);
            }
        }
    });
    failure.agree(processes);
    std::vector<std::vector<std::byte>> inboxes;
    failure.attempt([&] { inboxes = processes.exchange_with(ranks, outboxes); });
    failure.agree(processes);
    for (std::size_t n = 0; n < with.size(); ++n) {
        for (std::size_t k = 0; k < with[n].received.size(); ++k) {
            receive(values + with[n].received[k] * entry_size, inboxes[n].data() + k * entry_size,
                    components, context);
        }
    }
}

}  // namespace octetra::distributed::detail
