#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace octetra {

/// An optional prefix of UTF-8 files.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Reads a text file line by line through one buffer. Skips blank lines and a UTF-8 byte order
/// mark, removes `#` comments; CRLF counts as a line end.
class LineReader {
public:
    /// Throws InputError if `path` is not a regular file that can be read.
    explicit LineReader(std::filesystem::path path);
    /// Reads only the bytes begin .. end - 1 of the file, which must be whole lines. Line numbers
    /// count from `begin`.
    LineReader(std::filesystem::path path, std::uint64_t begin, std::uint64_t end);
    /// Continues with the bytes begin .. end - 1 of the file, which must be whole lines, after this
    /// number of lines.
    void seek(std::uint64_t begin, std::uint64_t end, std::uint64_t lines_before);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;
    LineReader(LineReader&&) = delete;
    LineReader& operator=(LineReader&&) = delete;

    /// Moves to the next line that is not blank; returns false at the end of the file.
    [[nodiscard]] bool next();

    /// The number of bytes after a line that are readable, with unspecified contents.
    static constexpr std::size_t bytes_behind_line = 16;
    /// The current line, without comment and line end; valid until next().
    [[nodiscard]] std::string_view line() const { return line_; }
    /// Same, with comment and blanks.
    [[nodiscard]] std::string_view full_line() const { return full_line_; }
    /// The number of the current line, counted from 1; after the last line, the number of lines.
    [[nodiscard]] std::uint64_t line_number() const { return line_number_; }
    /// The positions in the file of the current line and of the one after it.
    [[nodiscard]] std::uint64_t line_position() const { return line_position_; }
    [[nodiscard]] std::uint64_t next_position() const { return buffer_position_ + begin_; }
    [[nodiscard]] std::uint64_t file_size() const { return file_size_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Throws InputError "PATH:LINE: what", for the current line or the given one.
    [[noreturn]] void fail(std::string_view what) const;
    [[noreturn]] void fail(std::string_view what, std::uint64_t line_number) const;

    /// Throws InputError if the file is too small for `count` entries of at least `fields` numbers
    /// each, so that no memory is allocated for them, or if the count exceeds the range of indices.
    void check_count(std::uint64_t count, std::size_t fields, std::string_view what) const;

private:
    void open();
    [[nodiscard]] bool next_raw_line(std::string_view& raw);
    [[nodiscard]] std::string_view without_comment(std::string_view raw);
    void make_room(std::size_t size);
    void find_comment(std::size_t from);
    void fill();

    std::filesystem::path path_;
    int file_ = -1;
    std::uint64_t file_size_ = 0;
    // maximum number of bytes to read
    std::uint64_t left_ = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t buffer_position_ = 0;  // position in the file of the start of the buffer
    std::uint64_t line_position_ = 0;
    std::vector<char> buffer_;
    std::size_t room_ = 0;     // usable size of the buffer
    std::size_t begin_ = 0;    // of the bytes that are not yet taken
    std::size_t end_ = 0;      // of the bytes that were read
    std::size_t comment_ = 0;  // the first '#' from begin_ on, or end_
    bool at_end_of_file_ = false;
    bool has_line_end_ = true;  // whether the last line read has one
    std::string_view line_;
    std::string_view full_line_;
    std::uint64_t line_number_ = 0;
};

}  // namespace octetra
