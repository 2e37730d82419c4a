#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <octetra/core/process_group.hpp>

namespace octetra::verify {

/// Serialises values for another process of the same program.
class Packer {
public:
    template <class T>
    void operator()(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof(T));
    }
    /// Appends a list or string with its length.
    template <class List>
    void list(const List& values) {
        static_assert(std::is_trivially_copyable_v<typename List::value_type>);
        (*this)(std::uint64_t{values.size()});
        append(values.data(), values.size() * sizeof(typename List::value_type));
    }
    [[nodiscard]] ProcessGroup::Bytes& bytes() { return bytes_; }

private:
    void append(const void* data, std::size_t size) {
        if (size == 0) return;
        const auto* begin = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }
    ProcessGroup::Bytes bytes_;
};

/// Deserialises values in the order in which they were appended.
class Unpacker {
public:
    explicit Unpacker(const ProcessGroup::Bytes& bytes) : next_(bytes.data()) {}

    template <class T>
    void operator()(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        take(&value, sizeof(T));
    }
    template <class List>
    void list(List& values) {
        std::uint64_t size = 0;
        (*this)(size);
        values.resize(size);
        take(values.data(), values.size() * sizeof(typename List::value_type));
    }

private:
    void take(void* data, std::size_t size) {
        if (size == 0) return;
        std::memcpy(data, next_, size);
        next_ += size;
    }
    const std::byte* next_;
};

}  // namespace octetra::verify
