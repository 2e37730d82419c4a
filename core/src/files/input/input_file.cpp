#include "files/input/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
    // O_NONBLOCK: opening a named pipe must fail, not block.
    file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file_ < 0) fail(fmt::format("cannot be opened: {}", std::strerror(errno)));
    struct stat status {};
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(file_);
        fail("is not a file");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { ::close(file_); }

std::vector<std::byte> InputFile::read(std::uint64_t position, std::uint64_t size) const {
    std::vector<std::byte> bytes(size);
    read(position, bytes.data(), size);
    return bytes;
}

void InputFile::read(std::uint64_t position, void* data, std::uint64_t size) const {
    auto* place = static_cast<std::byte*>(data);
    while (size > 0) {
        const ssize_t got = ::pread(file_, place, size, static_cast<off_t>(position));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            throw SystemError(
                fmt::format("{}: reading failed: {}", path_.native(), std::strerror(errno)));
        }
        if (got == 0) fail("it has become shorter while it was read");
        place += got;
        position += static_cast<std::uint64_t>(got);
        size -= static_cast<std::uint64_t>(got);
    }
}

void InputFile::fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", path_.native(), what));
}

}  // namespace octetra
