#include "files/input/byte_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/index.hpp>

namespace octetra {

ByteReader::ByteReader(std::filesystem::path path)
    : file_(std::move(path)), buffer_(std::min<std::uint64_t>(buffer_size, file_.size())) {}

void ByteReader::fail(std::string_view what, std::uint64_t position) const {
    file_.fail(fmt::format("at byte {}: {}", position, what));
}

void ByteReader::require(std::uint64_t bytes, std::string_view what) const {
    if (bytes > remaining()) fail(fmt::format("the file ends where {} should be", what));
}

void ByteReader::seek(std::uint64_t position) {
    if (position > size()) {
        fail(fmt::format("the file refers to byte {}, but has only {} bytes", position, size()));
    }
    if (position >= buffer_position_ && position - buffer_position_ <= end_) {
        begin_ = position - buffer_position_;
        return;
    }
    buffer_position_ = position;
    begin_ = end_ = 0;
}

void ByteReader::skip(std::uint64_t bytes, std::string_view what) {
    require(bytes, what);
    seek(position() + bytes);
}

/// Reads until `wanted` bytes are buffered or the buffer is full. Reads at least 64 KiB, for
/// sequential access, and not much more than requested, for random access.
void ByteReader::fill(std::uint64_t wanted) {
    constexpr std::uint64_t few = std::uint64_t{1} << 16U;
    const std::size_t pending = end_ - begin_;
    std::memmove(buffer_.data(), buffer_.data() + begin_, pending);
    buffer_position_ += begin_;
    begin_ = 0;
    end_ = pending;
    const std::uint64_t from = buffer_position_ + end_;
    const std::uint64_t room =
        std::min<std::uint64_t>(std::max(wanted, few), buffer_.size()) - end_;
    const std::size_t more = std::min(room, size() - from);
    file_.read(from, buffer_.data() + end_, more);
    end_ += more;
}

void ByteReader::ensure_buffered(std::size_t size, std::string_view what) {
    require(size, what);
    fill(size);
}

std::span<const std::byte> ByteReader::take_rows(std::uint64_t rows, std::size_t row_size,
                                                 std::string_view what) {
    require(row_size, what);
    if (end_ - begin_ < row_size)
        fill(rows > buffer_.size() / row_size ? buffer_.size() : rows * row_size);
    const auto count = std::min<std::uint64_t>(rows, (end_ - begin_) / row_size);
    const std::span bytes(buffer_.data() + begin_, count * row_size);
    begin_ += bytes.size();
    return bytes;
}

void ByteReader::take_raw(void* place, std::uint64_t size, std::string_view what) {
    if (size == 0) return;
    require(size, what);
    auto* to = static_cast<std::byte*>(place);
    const std::size_t buffered = std::min<std::uint64_t>(size, end_ - begin_);
    std::memcpy(to, buffer_.data() + begin_, buffered);
    begin_ += buffered;
    to += buffered;
    size -= buffered;
    if (size >= buffer_.size()) {  // large reads bypass the buffer
        const std::uint64_t from = position();
        file_.read(from, to, size);
        return seek(from + size);
    }
    if (size > 0) std::memcpy(to, take_bytes(size, what), size);
}

std::string ByteReader::take_line(std::string_view what) {
    require(1, what);
    const std::uint64_t start = position();
    const auto newline = [&] {
        return std::find(buffer_.data() + begin_, buffer_.data() + end_, std::byte{'\n'});
    };
    const std::byte* last = newline();
    if (last == buffer_.data() + end_) {
        fill(buffer_.size());
        last = newline();
        if (last == buffer_.data() + end_ && remaining() > end_ - begin_) {
            fail(fmt::format("a line of more than {} bytes where {} should be", buffer_size, what),
                 start);
        }
    }
    const auto length = static_cast<std::size_t>(last - (buffer_.data() + begin_));
    std::string line(reinterpret_cast<const char*>(buffer_.data() + begin_), length);
    begin_ = std::min(begin_ + length + 1, end_);
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

void ByteReader::check_count(std::uint64_t count, std::uint64_t entry_size, std::string_view what,
                             std::uint64_t counted_at) const {
    const std::uint64_t most = remaining() / entry_size;
    if (count > most) {
        fail(fmt::format("{} {} announced, but the {} bytes that follow hold at most {}; was the "
                         "file cut off?",
                         count, what, remaining(), most),
             counted_at);
    }
    if (count >= VertexIndex::limit) {
        fail(fmt::format("{} {} announced; at most {} are supported", count, what,
                         VertexIndex::limit - 1),
             counted_at);
    }
}

}  // namespace octetra
