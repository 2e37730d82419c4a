#include "files/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra {

namespace {
constexpr std::size_t buffer_size = std::size_t{1} << 20U;
}

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)),
      temporary_(fmt::format("{}.{}.tmp", path_.native(), ::getpid())),
      unfinished_(temporary_),
      buffer_(buffer_size) {
    // Taking the name of a device would put an end to the device: think of /dev/null.
    std::error_code ignored;
    if (const auto there = std::filesystem::status(path_, ignored);
        std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
        throw SystemError(fmt::format(
            "{}: {}, not a file", path_.native(),
            std::filesystem::is_directory(there) ? "is a directory" : "is a device or the like"));
    }
    constexpr mode_t read_write_for_all = 0666;  // less what the umask takes away
    file_ =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, read_write_for_all);
    if (file_ < 0) fail("cannot be written");
}

OutputFile::~OutputFile() {
    if (file_ >= 0) ::close(file_);
    if (!committed_) ::unlink(temporary_.c_str());
}

void OutputFile::put(std::string_view text) { put_bytes(text.data(), text.size()); }

void OutputFile::put_bytes(const void* data, std::size_t size) {
    if (buffer_.size() - used_ < size) flush();
    if (size > buffer_.size()) {
        write_all(static_cast<const char*>(data), size);
        flushed_ += size;
        return;
    }
    if (size == 0) return;
    std::memcpy(buffer_.data() + used_, data, size);
    used_ += size;
}

void OutputFile::overwrite(std::uint64_t position, const void* data, std::size_t size) {
    flush();
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::pwrite(file_, bytes, size, static_cast<off_t>(position));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("writing failed");
        bytes += written;
        position += static_cast<std::uint64_t>(written);
        size -= static_cast<std::size_t>(written);
    }
}

void OutputFile::close() {
    flush();
    const int file = std::exchange(file_, -1);
    if (::close(file) != 0) fail("writing failed");
}

void OutputFile::commit() {
    if (file_ >= 0) close();
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be put in place");
    committed_ = true;
}

void OutputFile::flush() {
    write_all(buffer_.data(), used_);
    flushed_ += used_;
    used_ = 0;
}

void OutputFile::write_all(const char* data, std::size_t size) {
    while (size > 0) {
        const ssize_t written = ::write(file_, data, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("writing failed");
        data += written;
        size -= static_cast<std::size_t>(written);
    }
}

void OutputFile::fail(std::string_view doing) const {
    throw SystemError(fmt::format("{}: {}: {}", path_.native(), doing, std::strerror(errno)));
}

}  // namespace octetra
