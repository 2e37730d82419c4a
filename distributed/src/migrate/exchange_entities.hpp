#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <octetra/distributed/migration.hpp>

namespace octetra::distributed {

using MessageBytes = std::vector<std::byte>;

/// Collective. Sends pack(message) to each partner, including this process, and passes the received
/// messages, by partner, to take().
void exchange_entities(const Communicator& processes, const std::vector<int>& partners,
                       const Migration::Entities& entities, auto&& pack, auto&& take) {
    std::vector<int> others;
    std::vector<MessageBytes> outboxes;
    MessageBytes own;
    for (std::size_t p = 0; p < partners.size(); ++p) {
        MessageBytes bytes = pack(entities.messages[p].sent);
        if (partners[p] == processes.rank()) {
            own = std::move(bytes);
        } else {
            others.push_back(partners[p]);
            outboxes.push_back(std::move(bytes));
        }
    }
    std::vector<MessageBytes> inboxes = processes.exchange_with(others, outboxes);
    outboxes.clear();
    const auto index = std::ranges::lower_bound(others, processes.rank()) - others.begin();
    inboxes.insert(inboxes.begin() + index, std::move(own));
    take(inboxes);
}

}  // namespace octetra::distributed
