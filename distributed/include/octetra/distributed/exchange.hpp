#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/sharing.hpp>
#include <octetra/distributed/value_kind.hpp>

/// Exchange of values on shared entities between processes. `values` has `components` values for
/// each entity of the kind (vertex, edge, face) on this process, by local number.
namespace octetra::distributed {

namespace detail {

/// An exchange of values with the neighbours of a Sharing, by their position n in
/// Sharing::neighbours().
struct ValueExchange {
    std::size_t neighbour_count = 0;
    std::function<int(std::size_t n)> rank;
    std::function<std::size_t(std::size_t n)> entities_sent;
    std::function<std::size_t(std::size_t n)> entities_received;
    std::function<void(std::size_t n, std::byte* message)> pack;
    std::function<void(std::size_t n, const std::byte* message)> unpack;
    std::size_t value_count = 0;
    std::size_t entity_count = 0;
    ValueKind kind;
};

/// Collective. Throws the same on all processes, before any message is unpacked.
void exchange_values(const Communicator& processes, const ValueExchange& exchange);

/// Exchanges values: `sent` and `received` select lists of SharedWith, and combine(value, incoming)
/// combines a local value with a received one.
template <class I, class T>
void exchange_shared(const Communicator& processes, const Sharing<I>& sharing,
                     std::vector<I> SharedWith<I>::*sent, std::vector<I> SharedWith<I>::*received,
                     std::size_t entity_count, std::span<T> values, const ValueKind& kind,
                     auto combine) {
    static_assert(std::is_trivially_copyable_v<T>);
    // The functions capture a single reference, so that std::function does not allocate: a process
    // that failed to would throw and leave the others waiting.
    const struct {
        const std::vector<SharedWith<I>>& neighbours;
        std::vector<I> SharedWith<I>::*sent;
        std::vector<I> SharedWith<I>::*received;
        std::span<T> values;
        std::size_t components;
        decltype(combine) combine_value;
    } all{sharing.neighbours(), sent, received, values, kind.components, combine};
    exchange_values(
        processes,
        {.neighbour_count = all.neighbours.size(),
         .rank = [&all](std::size_t n) { return all.neighbours[n].rank; },
         .entities_sent = [&all](std::size_t n) { return (all.neighbours[n].*all.sent).size(); },
         .entities_received =
             [&all](std::size_t n) { return (all.neighbours[n].*all.received).size(); },
         .pack =
             [&all](std::size_t n, std::byte* message) {
                 const std::size_t entry_size = all.components * sizeof(T);
                 for (const I i : all.neighbours[n].*all.sent) {
                     std::memcpy(message, all.values.data() + i.value() * all.components,
                                 entry_size);
                     message += entry_size;
                 }
             },
         .unpack =
             [&all](std::size_t n, const std::byte* message) {
                 for (const I i : all.neighbours[n].*all.received) {
                     for (std::size_t k = 0; k < all.components; ++k, message += sizeof(T)) {
                         T incoming;
                         std::memcpy(&incoming, message, sizeof incoming);
                         all.combine_value(all.values[i.value() * all.components + k], incoming);
                     }
                 }
             },
         .value_count = values.size(),
         .entity_count = entity_count,
         .kind = kind});
}

}  // namespace detail

/// Collective. Copies the owner's values of each entity to all other sharers.
///
/// Throws InputError on all processes if the `values` of one do not have `components` values for
/// each of its `entity_count` entities, or if two processes pass different kinds of values: another
/// T, another number of components, other entities. No values have changed then.
template <class I, class T>
void update_copies(const Communicator& processes, const Sharing<I>& sharing,
                   std::size_t entity_count, std::span<T> values, std::size_t components = 1) {
    detail::exchange_shared(processes, sharing, &SharedWith<I>::owned, &SharedWith<I>::received,
                            entity_count, values, detail::kind_of<T, I>(components),
                            [](T& value, const T& incoming) { value = incoming; });
}

/// Collective. Replaces the owner's value of each entity by operation(value, copy) for the value of
/// every copy, in the order of ranks; the copies are unchanged. With an operation that is
/// commutative and associative, such as a minimum, the result does not depend on the number of
/// processes. Throws as update_copies() does, also if processes pass operations of different types.
/// Operations of one type are not compared: their state, such as captured variables, must be the
/// same on all processes.
template <class I, class T, class Operation>
void combine_at_owner(const Communicator& processes, const Sharing<I>& sharing,
                      std::size_t entity_count, std::span<T> values, Operation operation,
                      std::size_t components = 1) {
    detail::ValueKind kind = detail::kind_of<T, I>(components);
    kind.operation = &typeid(Operation);
    detail::exchange_shared(
        processes, sharing, &SharedWith<I>::received, &SharedWith<I>::owned, entity_count, values,
        kind, [&](T& value, const T& incoming) { value = operation(value, incoming); });
}

/// Collective. Combines the values of all copies of each entity and assigns the result to all
/// copies, as assembly needs. With std::logical_or<> a flag (bool, std::uint8_t) that is set on one
/// sharer is set on all. Throws as update_copies() does.
template <class I, class T, class Operation>
void combine_everywhere(const Communicator& processes, const Sharing<I>& sharing,
                        std::size_t entity_count, std::span<T> values, Operation operation,
                        std::size_t components = 1) {
    combine_at_owner(processes, sharing, entity_count, values, operation, components);
    update_copies(processes, sharing, entity_count, values, components);
}

// Overloads for vectors, for which the type of a span is not deduced.
template <class I, class T>
void update_copies(const Communicator& processes, const Sharing<I>& sharing,
                   std::size_t entity_count, std::vector<T>& values, std::size_t components = 1) {
    update_copies(processes, sharing, entity_count, std::span(values), components);
}
template <class I, class T, class Operation>
void combine_at_owner(const Communicator& processes, const Sharing<I>& sharing,
                      std::size_t entity_count, std::vector<T>& values, Operation operation,
                      std::size_t components = 1) {
    combine_at_owner(processes, sharing, entity_count, std::span(values), operation, components);
}
template <class I, class T, class Operation>
void combine_everywhere(const Communicator& processes, const Sharing<I>& sharing,
                        std::size_t entity_count, std::vector<T>& values, Operation operation,
                        std::size_t components = 1) {
    combine_everywhere(processes, sharing, entity_count, std::span(values), operation, components);
}

}  // namespace octetra::distributed
