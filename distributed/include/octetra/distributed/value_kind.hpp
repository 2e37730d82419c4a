#pragma once

#include <cstddef>
#include <typeinfo>

namespace octetra::distributed::detail {

/// The kind of values that a collective function exchanges; the same on all processes.
struct ValueKind {
    const std::type_info* type = nullptr;
    std::size_t size = 0;                    ///< of a value, in bytes
    std::size_t components = 1;              ///< values for each entity
    bool are_lists = false;                  ///< lists of any length instead of `components` values
    const std::type_info* entity = nullptr;  ///< the type of the entity's index
    const std::type_info* operation = nullptr;  ///< null: values are copied

    /// Size of the values of one entity, in bytes.
    [[nodiscard]] std::size_t entry_size() const { return size * components; }
};

/// Returns the kind of `components` values of type T for each entity with an index of type I.
template <class T, class I>
[[nodiscard]] ValueKind kind_of(std::size_t components) {
    return {.type = &typeid(T), .size = sizeof(T), .components = components, .entity = &typeid(I)};
}

}  // namespace octetra::distributed::detail
