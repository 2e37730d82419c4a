#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace octetra {

/// A file of UTF-8 may begin with it.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Reads a text file line by line through one buffer, never the whole of it.
/// Skips blank lines and a UTF-8 byte order mark, cuts off `#` comments; CRLF counts as a line end.
class LineReader {
public:
    /// Throws InputError if `path` is not a regular file that can be read.
    explicit LineReader(std::filesystem::path path);
    /// Reads the bytes begin .. end-1 of the file alone, where lines begin and end. Line numbers
    /// count from `begin`.
    LineReader(std::filesystem::path path, std::uint64_t begin, std::uint64_t end);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;
    LineReader(LineReader&&) = delete;
    LineReader& operator=(LineReader&&) = delete;

    /// Moves to the next line that holds something; false at the end of the file.
    [[nodiscard]] bool next();

    /// So many bytes behind a line can be read, too, whatever they are.
    static constexpr std::size_t bytes_behind_line = 16;
    /// The current line, with neither comment nor line end; valid until next().
    [[nodiscard]] std::string_view line() const { return line_; }
    /// The same with its comment, and with blanks.
    [[nodiscard]] std::string_view full_line() const { return full_line_; }
    /// Its number, counted from 1; after the last line, the number of lines.
    [[nodiscard]] std::uint64_t line_number() const { return line_number_; }
    /// Where in the file the current line begins, and where what follows it does.
    [[nodiscard]] std::uint64_t line_position() const { return line_position_; }
    [[nodiscard]] std::uint64_t next_position() const { return buffer_position_ + begin_; }
    [[nodiscard]] std::uint64_t file_size() const { return file_size_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Throws InputError "PATH:LINE: what", for the current line or another.
    [[noreturn]] void fail(std::string_view what) const;
    [[noreturn]] void fail(std::string_view what, std::uint64_t line_number) const;

    /// Refuses a count of entries that the file is too small to hold, if each takes at least
    /// `fields` numbers, so that nobody allocates for it. Also refuses what no index can number.
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
    std::uint64_t left_ = std::numeric_limits<std::uint64_t>::max();  // bytes to read at most
    std::uint64_t buffer_position_ = 0;  // of the buffer's beginning, in the file
    std::uint64_t line_position_ = 0;
    std::vector<char> buffer_;
    std::size_t room_ = 0;     // of the buffer, for what is read
    std::size_t begin_ = 0;    // of what is not yet handed out
    std::size_t end_ = 0;      // of what was read
    std::size_t comment_ = 0;  // the first '#' of what is not yet handed out, or its end
    bool at_end_of_file_ = false;
    bool has_line_end_ = true;  // the line that was read last
    std::string_view line_;
    std::string_view full_line_;
    std::uint64_t line_number_ = 0;
};

}  // namespace octetra
