#pragma once

#include <cstddef>
#include <typeinfo>

namespace octetra::distributed::detail {

/// The kind of values that a collective function exchanges, which all processes pass alike.
struct ValueKind {
    const std::type_info* type = nullptr;
    std::size_t size = 0;                    ///< of a value, in bytes
    std::size_t components = 1;              ///< values of each entity
    bool are_lists = false;                  ///< of any length, which take the place of components
    const std::type_info* entity = nullptr;  ///< the type of its index
    const std::type_info* operation = nullptr;  ///< null: values are copied

    /// The bytes of one entity.
    [[nodiscard]] std::size_t entry_size() const { return size * components; }
};

template <class T, class I>
[[nodiscard]] ValueKind kind_of(std::size_t components) {
    return {.type = &typeid(T), .size = sizeof(T), .components = components, .entity = &typeid(I)};
}

}  // namespace octetra::distributed::detail
