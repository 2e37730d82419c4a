#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace octetra {

/// A file with random access. Throws InputError if it cannot be opened, is not a regular file, or
/// has become shorter, and SystemError if reading fails.
class InputFile {
public:
    explicit InputFile(std::filesystem::path path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    InputFile(InputFile&&) = delete;
    InputFile& operator=(InputFile&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] std::vector<std::byte> read(std::uint64_t position, std::uint64_t size) const;
    void read(std::uint64_t position, void* data, std::uint64_t size) const;
    /// Throws InputError "PATH: what".
    [[noreturn]] void fail(const std::string& what) const;

private:
    std::filesystem::path path_;
    int file_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace octetra
