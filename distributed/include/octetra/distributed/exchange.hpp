#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/sharing.hpp>

/// Values on shared entities, brought from process to process. `values` has `components` values for
/// each of this process's entities of the kind (vertices, say), by local number.
namespace octetra::distributed {

namespace detail {

/// What goes to and comes from one other process.
struct ValueLists {
    int rank = 0;
    std::vector<std::uint32_t> sent;  ///< entities
    std::vector<std::uint32_t> received;
};

/// Entities that this process owns and has in common with others, and those that others own.
template <class I>
[[nodiscard]] std::vector<ValueLists> owned_and_others(const Sharing<I>& sharing) {
    std::vector<ValueLists> lists;
    for (const auto& [rank, entities] : sharing.neighbours()) {
        ValueLists& list = lists.emplace_back();
        list.rank = rank;
        for (const I i : entities) {
            const int owner = sharing.owner(i);
            if (owner == sharing.rank()) list.sent.push_back(i.value());
            if (owner == rank) list.received.push_back(i.value());
        }
    }
    return lists;
}

/// Puts an entity's value that has come into the place of its value here.
using Receive = void (*)(void* value, const void* come, std::size_t components, void* context);

/// Collective among neighbours. `values` holds entries of `entry_size` bytes for `entity_count`
/// entities; throws alike on all processes.
void exchange_values(const Communicator& processes,
                     const std::function<std::vector<ValueLists>()>& lists, std::byte* values,
                     std::size_t value_count, std::size_t value_size, std::size_t components,
                     std::size_t entity_count, Receive receive, void* context);

}  // namespace detail

/// Collective. Every copy of an entity's values gets those of its owner.
///
/// Throws InputError on all processes if `values` of one has not `components` values for each of
/// its `entity_count` entities; nothing has been changed then.
template <class I, class T>
void update_copies(const Communicator& processes, const Sharing<I>& sharing,
                   std::size_t entity_count, std::span<T> values, std::size_t components = 1) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto replace = [](void* value, const void* come, std::size_t count, void*) {
        std::copy_n(static_cast<const T*>(come), count, static_cast<T*>(value));
    };
    detail::exchange_values(
        processes, [&] { return detail::owned_and_others(sharing); },
        reinterpret_cast<std::byte*>(values.data()), values.size(), sizeof(T), components,
        entity_count, replace, nullptr);
}

/// Collective. The owner of each entity gets operation(its value, a copy's) for every copy, in the
/// order of the ranks; copies keep theirs. An operation that does not mind order, such as a
/// minimum, has the same result on any number of processes. Throws as update_copies().
template <class I, class T, class Operation>
void combine_at_owner(const Communicator& processes, const Sharing<I>& sharing,
                      std::size_t entity_count, std::span<T> values, Operation operation,
                      std::size_t components = 1) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto combine = [](void* value, const void* come, std::size_t count, void* context) {
        Operation& with = *static_cast<Operation*>(context);
        for (std::size_t k = 0; k < count; ++k) {
            T& own = static_cast<T*>(value)[k];
            own = with(own, static_cast<const T*>(come)[k]);
        }
    };
    const auto others_and_owned = [&] {
        auto lists = detail::owned_and_others(sharing);
        for (auto& list : lists) list.sent.swap(list.received);
        return lists;
    };
    detail::exchange_values(processes, others_and_owned,
                            reinterpret_cast<std::byte*>(values.data()), values.size(), sizeof(T),
                            components, entity_count, combine, &operation);
}

/// Collective. Combines the values of all copies of each entity, and gives all copies the result:
/// what assembly needs. Throws as update_copies().
template <class I, class T, class Operation>
void combine_everywhere(const Communicator& processes, const Sharing<I>& sharing,
                        std::size_t entity_count, std::span<T> values, Operation operation,
                        std::size_t components = 1) {
    combine_at_owner(processes, sharing, entity_count, values, operation, components);
    update_copies(processes, sharing, entity_count, values, components);
}

}  // namespace octetra::distributed
