#include "files/input/line_reader.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/index.hpp>

#include "files/input/fields.hpp"

namespace octetra {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20U;

std::string_view without_blanks(std::string_view line) {
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    return line;
}

}  // namespace

LineReader::LineReader(std::filesystem::path path) : path_(std::move(path)) {
    open();
    if (file_size_ == 0) {
        ::close(file_);
        throw InputError(fmt::format("{}:1: the file is empty", path_.native()));
    }
    make_room(std::min<std::uint64_t>(longest_line, file_size_ + 1));
}

LineReader::LineReader(std::filesystem::path path, std::uint64_t begin, std::uint64_t end)
    : path_(std::move(path)), left_(end - begin), buffer_position_(begin) {
    make_room(std::min<std::uint64_t>(longest_line, left_ + 1));
    open();
    (void)::lseek(file_, static_cast<off_t>(begin), SEEK_SET);
}

void LineReader::open() {
    // O_NONBLOCK: opening a named pipe must fail, not block.
    file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file_ < 0) {
        throw InputError(
            fmt::format("{}: cannot be opened: {}", path_.native(), std::strerror(errno)));
    }
    struct stat status {};
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(file_);
        throw InputError(fmt::format("{}: is not a file", path_.native()));
    }
    file_size_ = static_cast<std::uint64_t>(status.st_size);
}

void LineReader::seek(std::uint64_t begin, std::uint64_t end, std::uint64_t lines_before) {
    (void)::lseek(file_, static_cast<off_t>(begin), SEEK_SET);
    left_ = end - begin;
    buffer_position_ = begin;
    begin_ = end_ = comment_ = 0;
    at_end_of_file_ = false;
    line_number_ = lines_before;
}

LineReader::~LineReader() { ::close(file_); }

bool LineReader::next() {
    std::string_view raw;
    while (next_raw_line(raw)) {
        if (line_number_ == 0 && line_position_ == 0 && raw.starts_with(byte_order_mark)) {
            raw.remove_prefix(byte_order_mark.size());
        }
        ++line_number_;
        line_ = without_blanks(without_comment(raw));
        full_line_ = raw;
        if (!line_.empty()) return true;
    }
    line_ = full_line_ = {};
    return false;
}

std::string_view LineReader::without_comment(std::string_view raw) {
    const char* const comment = buffer_.data() + comment_;
    if (comment >= raw.data() + raw.size()) return raw;
    find_comment(begin_);
    return raw.substr(0, static_cast<std::size_t>(comment - raw.data()));
}

/// Finds the next comment in the buffer, from this index on.
void LineReader::find_comment(std::size_t from) {
    const void* const comment = std::memchr(buffer_.data() + from, '#', end_ - from);
    comment_ = comment == nullptr
                   ? end_
                   : static_cast<std::size_t>(static_cast<const char*>(comment) - buffer_.data());
}

bool LineReader::next_raw_line(std::string_view& raw) {
    line_position_ = next_position();
    std::size_t searched = begin_;
    while (true) {
        const char* start = buffer_.data() + searched;
        if (const void* newline = std::memchr(start, '\n', end_ - searched)) {
            const char* first = buffer_.data() + begin_;
            raw = {first, static_cast<std::size_t>(static_cast<const char*>(newline) - first)};
            begin_ += raw.size() + 1;
            has_line_end_ = true;
            return true;
        }
        if (at_end_of_file_) {
            raw = {buffer_.data() + begin_, end_ - begin_};
            begin_ = end_;
            has_line_end_ = raw.empty();
            return !raw.empty();
        }
        const std::size_t pending = end_ - begin_;
        fill();
        searched = begin_ + pending;
    }
}

void LineReader::make_room(std::size_t size) {
    buffer_.resize(size + bytes_behind_line);
    room_ = size;
}

void LineReader::fill() {
    const std::size_t pending = end_ - begin_;
    if (pending == longest_line) {
        fail("this line is longer than 1 MiB: not a text file?", line_number_ + 1);
    }
    if (pending == room_) make_room(longest_line);  // the file has grown since it was opened
    std::memmove(buffer_.data(), buffer_.data() + begin_, pending);
    buffer_position_ += begin_;
    comment_ -= begin_;
    begin_ = 0;
    end_ = pending;
    const std::size_t room = std::min<std::uint64_t>(room_ - end_, left_);
    const ssize_t got = ::read(file_, buffer_.data() + end_, room);
    if (got < 0 && errno == EINTR) return;
    if (got < 0) {
        throw SystemError(
            fmt::format("{}: reading failed: {}", path_.native(), std::strerror(errno)));
    }
    at_end_of_file_ = got == 0;
    end_ += static_cast<std::size_t>(got);
    if (comment_ == pending) find_comment(pending);
    left_ -= static_cast<std::uint64_t>(got);
}

void LineReader::fail(std::string_view what) const {
    if (has_line_end_) fail(what, line_number_);
    fail(fmt::format("{}; the file ends with this line, without a line end: was it cut off?", what),
         line_number_);
}

void LineReader::fail(std::string_view what, std::uint64_t line_number) const {
    throw InputError(fmt::format("{}:{}: {}", path_.native(), line_number, what));
}

void LineReader::check_count(std::uint64_t count, std::size_t fields, std::string_view what) const {
    // Each number takes a digit and a separator; the last separator of a file may be missing.
    const std::uint64_t most = (file_size_ + 1) / (2 * fields);
    if (count > most) {
        fail(
            fmt::format("{} {} announced, but a file of {} bytes holds at most {}; was it cut off?",
                        count, what, file_size_, most));
    }
    if (count >= VertexIndex::limit) {
        fail(fmt::format("{} {} announced; at most {} are supported", count, what,
                         VertexIndex::limit - 1));
    }
}

}  // namespace octetra
