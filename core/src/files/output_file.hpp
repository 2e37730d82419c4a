#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "files/unfinished_files.hpp"

namespace octetra {

/// A file that is written under a temporary name beside its final one and takes that name only on
/// commit(). Destroyed before, it leaves no trace. Every failure throws SystemError.
class OutputFile {
public:
    explicit OutputFile(std::filesystem::path path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&&) = delete;
    OutputFile& operator=(OutputFile&&) = delete;

    void put(char c) {
        if (used_ == buffer_.size()) flush();
        buffer_[used_++] = c;
    }
    void put(std::string_view text);
    /// In the fewest decimal digits that read back to the same bits.
    void put(double number) { put_number(number); }
    void put(std::integral auto number) { put_number(number); }
    void put_bytes(const void* data, std::size_t size);

    /// How many bytes have been put so far: where the next one will stand.
    [[nodiscard]] std::uint64_t position() const { return flushed_ + used_; }
    /// Replaces bytes that were put before.
    void overwrite(std::uint64_t position, const void* data, std::size_t size);

    /// Brings everything to the file and closes it. Call it on all files of a set, then commit().
    void close();
    void commit();

private:
    void put_number(auto number) {
        constexpr std::size_t longest_number = 32;
        if (buffer_.size() - used_ < longest_number) flush();
        char* first = buffer_.data() + used_;
        const auto result = std::to_chars(first, buffer_.data() + buffer_.size(), number);
        used_ += static_cast<std::size_t>(result.ptr - first);
    }
    void flush();
    void write_all(const char* data, std::size_t size);
    [[noreturn]] void fail(std::string_view doing) const;

    std::filesystem::path path_;
    std::filesystem::path temporary_;
    UnfinishedFile unfinished_;
    int file_ = -1;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
    bool committed_ = false;
};

}  // namespace octetra
