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

/// Numbers in binary files: integers and reals of 1, 2, 4 or 8 bytes.
template <class T>
concept BinaryNumber = (std::integral<T> || std::floating_point<T>)&&!std::same_as<T, bool> &&
                       sizeof(T) <= 8;

/// Returns the number in these bytes, which need not be aligned; with `swapped`, in the byte order
/// opposite to that of this machine.
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

/// Reads a binary file from any position on, through one buffer. Never reads beyond the end of the
/// file, and never allocates memory whose size the file's contents determine.
///
/// Bytes are counted from 0. `what` names the data for the error message if the file ends early:
/// "FILE: at byte N: the file ends where WHAT should be", where N is the position of the data.
/// Throws InputError, or SystemError if reading fails.
class ByteReader {
public:
    static constexpr std::size_t buffer_size = std::size_t{1} << 20U;

    explicit ByteReader(std::filesystem::path path);

    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
    [[nodiscard]] std::uint64_t size() const { return file_.size(); }
    /// The position of the next byte.
    [[nodiscard]] std::uint64_t position() const { return buffer_position_ + begin_; }
    [[nodiscard]] std::uint64_t remaining() const { return size() - position(); }

    /// Sets whether numbers from here on have the byte order opposite to that of this machine.
    void swap_bytes(bool swapped) { swapped_ = swapped; }
    [[nodiscard]] bool swaps_bytes() const { return swapped_; }

    /// Moves to a position from 0 to size(); throws InputError for others.
    void seek(std::uint64_t position);
    void skip(std::uint64_t bytes, std::string_view what);

    /// Returns the next number.
    template <BinaryNumber T>
    [[nodiscard]] T take(std::string_view what) {
        return number_at<T>(take_bytes(sizeof(T), what), swapped_);
    }
    /// Reads as many numbers as the span holds.
    template <BinaryNumber T>
    void take(std::span<T> numbers, std::string_view what);

    /// Returns the next bytes, at most buffer_size of them; valid until the next call.
    [[nodiscard]] const std::byte* take_bytes(std::size_t size, std::string_view what) {
        const std::byte* const bytes = peek_bytes(size, what);
        begin_ += size;
        return bytes;
    }
    /// Same, without advancing.
    [[nodiscard]] const std::byte* peek_bytes(std::size_t size, std::string_view what) {
        if (end_ - begin_ < size) ensure_buffered(size, what);
        return buffer_.data() + begin_;
    }
    /// Returns between one and `rows` rows of `row_size` bytes, as many as are buffered; the caller
    /// asks again for the rest. Valid until the next call.
    [[nodiscard]] std::span<const std::byte> take_rows(std::uint64_t rows, std::size_t row_size,
                                                       std::string_view what);
    /// Returns the rest of a line of text, without its end, which may be LF, CRLF, or the end of
    /// the file. Throws InputError for lines of more than buffer_size bytes.
    [[nodiscard]] std::string take_line(std::string_view what);

    /// Throws InputError if the rest of the file cannot hold `count` entries of `entry_size` bytes
    /// each, so that no memory is allocated for them, or if the count exceeds the range of indices.
    /// `counted_at`: the position of the count.
    void check_count(std::uint64_t count, std::uint64_t entry_size, std::string_view what,
                     std::uint64_t counted_at) const;

    /// Throws InputError "FILE: at byte N: what", for the next byte or the given position.
    [[noreturn]] void fail(std::string_view what) const { fail(what, position()); }
    [[noreturn]] void fail(std::string_view what, std::uint64_t position) const;

private:
    void require(std::uint64_t bytes, std::string_view what) const;
    void fill(std::uint64_t wanted);
    void ensure_buffered(std::size_t size, std::string_view what);
    void take_raw(void* place, std::uint64_t size, std::string_view what);

    InputFile file_;
    std::vector<std::byte> buffer_;
    std::uint64_t buffer_position_ = 0;  // position in the file of the start of the buffer
    std::size_t begin_ = 0;              // of the bytes that are not yet taken
    std::size_t end_ = 0;                // of the bytes that were read
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
