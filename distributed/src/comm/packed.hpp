#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

/// Packs lists of several types into the bytes of one message, and unpacks them.
namespace octetra::distributed {

class Packer {
public:
    template <class T>
    void put(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::uint64_t count = values.size();
        append(&count, sizeof count);
        append(values.data(), values.size_bytes());
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(std::span<const T>(values));
    }

    [[nodiscard]] std::vector<std::byte> take() && { return std::move(bytes_); }

private:
    void append(const void* data, std::size_t size) {
        const auto* const begin = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }

    std::vector<std::byte> bytes_;
};

/// Returns the lists in the order in which they were put. The bytes must be those of a Packer of
/// this program on any process.
class Unpacker {
public:
    explicit Unpacker(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <class T>
    [[nodiscard]] std::vector<T> take() {
        std::uint64_t count = 0;
        copy(&count, sizeof count);
        std::vector<T> values(count);
        copy(values.data(), count * sizeof(T));
        return values;
    }

private:
    void copy(void* to, std::size_t size) {
        if (size > 0) std::memcpy(to, rest_.data(), size);
        rest_ = rest_.subspan(size);
    }

    std::span<const std::byte> rest_;
};

}  // namespace octetra::distributed
