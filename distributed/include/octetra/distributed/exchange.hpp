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

/// Values on shared entities, brought from process to process. `values` has `components` values for
/// each of this process's entities of the kind (vertices, say), by local number.
namespace octetra::distributed {

namespace detail {

/// What processes exchange, neighbour by neighbour, n counting those of a Sharing.
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

/// Collective. Throws alike on all processes, before anything is unpacked.
void exchange_values(const Communicator& processes, const ValueExchange& exchange);

/// `sent` and `received` are the lists of SharedWith; take(value, come) gets what has come.
template <class I, class T>
void exchange_shared(const Communicator& processes, const Sharing<I>& sharing,
                     std::vector<I> SharedWith<I>::*sent, std::vector<I> SharedWith<I>::*received,
                     std::size_t entity_count, std::span<T> values, const ValueKind& kind,
                     auto take) {
    static_assert(std::is_trivially_copyable_v<T>);
    // The functions refer to this alone: then they take no memory, for want of which one process
    // would throw and leave the others waiting.
    const struct {
        const std::vector<SharedWith<I>>& neighbours;
        std::vector<I> SharedWith<I>::*sent;
        std::vector<I> SharedWith<I>::*received;
        std::span<T> values;
        std::size_t components;
        decltype(take) take_value;
    } all{sharing.neighbours(), sent, received, values, kind.components, take};
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
                         T come;
                         std::memcpy(&come, message, sizeof come);
                         all.take_value(all.values[i.value() * all.components + k], come);
                     }
                 }
             },
         .value_count = values.size(),
         .entity_count = entity_count,
         .kind = kind});
}

}  // namespace detail

/// Collective. Every copy of an entity's values gets those of its owner.
///
/// Throws InputError on all processes if `values` of one has not `components` values for each of
/// its `entity_count` entities, or if two processes pass different kinds of values: another T,
/// another number of components, other entities. Nothing has been changed then.
template <class I, class T>
void update_copies(const Communicator& processes, const Sharing<I>& sharing,
                   std::size_t entity_count, std::span<T> values, std::size_t components = 1) {
    detail::exchange_shared(processes, sharing, &SharedWith<I>::owned, &SharedWith<I>::received,
                            entity_count, values, detail::kind_of<T, I>(components),
                            [](T& value, const T& come) { value = come; });
}

/// Collective. The owner of each entity gets operation(its value, a copy's) for every copy, in the
/// order of the ranks; copies keep theirs. An operation that does not mind order, such as a
/// minimum, has the same result on any number of processes. Throws as update_copies().
template <class I, class T, class Operation>
void combine_at_owner(const Communicator& processes, const Sharing<I>& sharing,
                      std::size_t entity_count, std::span<T> values, Operation operation,
                      std::size_t components = 1) {
    detail::ValueKind kind = detail::kind_of<T, I>(components);
    kind.operation = &typeid(Operation);
    detail::exchange_shared(processes, sharing, &SharedWith<I>::received, &SharedWith<I>::owned,
                            entity_count, values, kind,
                            [&](T& value, const T& come) { value = operation(value, come); });
}

/// Collective. Combines the values of all copies of each entity, and gives all copies the result:
/// what assembly needs. With std::logical_or<> a flag (bool, std::uint8_t) is set on all processes
/// that have the entity where it is set on one of them. Throws as update_copies().
template <class I, class T, class Operation>
void combine_everywhere(const Communicator& processes, const Sharing<I>& sharing,
                        std::size_t entity_count, std::span<T> values, Operation operation,
                        std::size_t components = 1) {
    combine_at_owner(processes, sharing, entity_count, values, operation, components);
    update_copies(processes, sharing, entity_count, values, components);
}

// The same of vectors, from which the type of a span is not deduced.
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
