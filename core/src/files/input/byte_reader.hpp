#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "files/input/input_file.hpp"

namespace octetra {

/// Numbers that binary files are made of: whole ones and reals of 1, 2, 4 or 8 bytes.
template <class T>
concept BinaryNumber = (std::integral<T> || std::floating_point<T>)&&!std::same_as<T, bool> &&
                       sizeof(T) <= 8;

/// The number in these bytes, which need not be aligned; with `swapped`, in the other byte order
/// than this machine's.
template <BinaryNumber T>
[[nodiscard]] T number_at(const std::byte* bytes, bool swapped) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    if (!swapped) return value;
    const auto reversed = [](auto bits, auto reverse, T number) {
        std::memcpy(&bits, &number, sizeof bits);
        bits = reverse(bits);
        std::memcpy(&number, &bits, sizeof bits);
        return number;
    };
    if constexpr (sizeof(T) == 1) {
        return value;
    } else if constexpr (sizeof(T) == 2) {
        return reversed(
            std::uint16_t{}, [](auto b) { return __builtin_bswap16(b); }, value);
    } else if constexpr (sizeof(T) == 4) {
        return reversed(
            std::uint32_t{}, [](auto b) { return __builtin_bswap32(b); }, value);
    } else {
        return reversed(
            std::uint64_t{}, [](auto b) { return __builtin_bswap64(b); }, value);
    }
}

/// Reads a binary file from any place on, through one buffer, never the whole of it. Nothing beyond
/// the file's end is read, and nothing is allocated that depends on what the file says.
///
/// Bytes are counted from 0. `what` in these calls names what is read for the error message where
/// the file ends before it: "FILE: at byte N: the file ends where WHAT should be", N being where
/// it should begin. Throws InputError, or SystemError where reading fails.
class ByteReader {
public:
    static constexpr std::size_t buffer_size = std::size_t{1} << 20U;

    explicit ByteReader(std::filesystem::path path);

    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
    [[nodiscard]] std::uint64_t size() const { return file_.size(); }
    /// Of the next byte.
    [[nodiscard]] std::uint64_t position() const { return buffer_position_ + begin_; }
    [[nodiscard]] std::uint64_t remaining() const { return size() - position(); }

    /// Are numbers from here on in the other byte order than this machine's?
    void swap_bytes(bool swapped) { swapped_ = swapped; }
    [[nodiscard]] bool swaps_bytes() const { return swapped_; }

    /// Goes to a place from 0 to size(); others are refused.
    void seek(std::uint64_t position);
    void skip(std::uint64_t bytes, std::string_view what);

    /// The next number.
    template <BinaryNumber T>
    [[nodiscard]] T take(std::string_view what) {
        return number_at<T>(take_bytes(sizeof(T), what), swapped_);
    }
    /// As many numbers as there is room for.
    template <BinaryNumber T>
    void take(std::span<T> numbers, std::string_view what);

    /// The next bytes as they are, at most buffer_size of them; valid until the next call.
    [[nodiscard]] const std::byte* take_bytes(std::size_t size, std::string_view what) {
        const std::byte* const bytes = look_at_bytes(size, what);
        begin_ += size;
        return bytes;
    }
    /// The same bytes, which stay the next ones.
    [[nodiscard]] const std::byte* look_at_bytes(std::size_t size, std::string_view what) {
        if (end_ - begin_ < size) have_at_hand(size, what);
        return buffer_.data() + begin_;
    }
    /// Of `rows` rows to come, each of `row_size` bytes, as many as are at hand, one at least: it
    /// is for the caller to ask again for the others. Valid until the next call.
    [[nodiscard]] std::span<const std::byte> take_rows(std::uint64_t rows, std::size_t row_size,
                                                       std::string_view what);
    /// The rest of a line of text, without its end, which may be CRLF, or the file's end. Lines of
    /// more than buffer_size bytes are refused.
    [[nodiscard]] std::string take_line(std::string_view what);

    /// Refuses a count of entries of `entry_size` bytes each that the rest of the file does not
    /// hold, so that nobody allocates for it; also what no index can number. `counted_at`: where
    /// the count stands.
    void check_count(std::uint64_t count, std::uint64_t entry_size, std::string_view what,
                     std::uint64_t counted_at) const;

    /// Throws InputError "FILE: at byte N: what", for the next byte or another.
    [[noreturn]] void fail(std::string_view what) const { fail(what, position()); }
    [[noreturn]] void fail(std::string_view what, std::uint64_t position) const;

private:
    void require(std::uint64_t bytes, std::string_view what) const;
    void fill(std::uint64_t wanted);
    void have_at_hand(std::size_t size, std::string_view what);
    void take_raw(void* place, std::uint64_t size, std::string_view what);

    InputFile file_;
    std::vector<std::byte> buffer_;
    std::uint64_t buffer_position_ = 0;  // of the buffer's beginning, in the file
    std::size_t begin_ = 0;              // of what is not yet handed out
    std::size_t end_ = 0;                // of what was read
    bool swapped_ = false;
};

template <BinaryNumber T>
void ByteReader::take(std::span<T> numbers, std::string_view what) {
    take_raw(numbers.data(), numbers.size_bytes(), what);
    if (!swapped_) return;
    for (T& number : numbers) {
        number = number_at<T>(reinterpret_cast<const std::byte*>(&number), true);
    }
}

}  // namespace octetra
