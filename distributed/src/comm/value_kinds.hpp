#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/value_kind.hpp>

namespace octetra::distributed {

/// Collective, within a transaction. Throws InputError unless all processes pass values of the same
/// kind.
void agree_on_kind(const Communicator& processes, const detail::ValueKind& kind);

/// Collective, within a transaction. Throws InputError if a message received from `senders` does
/// not have the expected size.
void agree_on_sizes(const Communicator& processes, std::span<const int> senders,
                    const std::vector<std::vector<std::byte>>& messages,
                    const std::function<std::size_t(std::size_t n)>& expected);

/// Throws InputError unless process `sender` has sent `expected` bytes.
void check_message_size(const Communicator& processes, int sender, std::size_t size,
                        std::size_t expected);

}  // namespace octetra::distributed
