#include "files/output/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/output_paths.hpp>

#include "files/output/places.hpp"

namespace octetra {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20U;

/// Copies owner, group and permissions as far as the system allows. If the group cannot be copied,
/// the new group gets no more permissions than others had.
void copy_permissions(const struct stat& old, int file) {
    mode_t mode = old.st_mode & 0777U;
    constexpr auto same_owner = static_cast<uid_t>(-1);
    if (::fchown(file, old.st_uid, old.st_gid) != 0 &&
        ::fchown(file, same_owner, old.st_gid) != 0) {
        mode = (mode & 0707U) | ((mode & 0007U) << 3U);
    }
    // Fails on file systems without permissions, where nothing needs to be copied.
    (void)::fchmod(file, mode);
}

/// Synchronises a directory to disk; file systems that do not support this do not need it.
/// Allocates no memory.
void sync_folder(const std::filesystem::path& folder) {
    const int opened = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY);
    if (opened < 0) return;
    (void)::fsync(opened);
    ::close(opened);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, const ProcessGroup& group)
    : group_(&group),
      path_(std::move(path)),
      final_path_(resolved_path(path_)),
      buffer_(buffer_size),
      room_(buffer_size) {
    try {
        if (const std::string what = write_obstacle(path_); !what.empty()) {
            failure_ = fmt::format("{}: {}", path_.native(), what);
        }
        agree();
        const std::uint64_t number = group_->is_first() ? create() : 0;
        agree();
        const std::uint64_t number_of_first = group_->of_first(number);
        if (!group_->is_first()) open_created(number_of_first);
        agree();
    } catch (...) {
        if (file_ >= 0) ::close(file_);
        if (group_->is_first() && file_ >= 0) ::unlink(temporary_.c_str());
        throw;
    }
}

OutputFile::~OutputFile() {
    if (file_ >= 0) ::close(file_);
    if (!committed_) ::unlink(temporary_.c_str());
}

void OutputFile::put(std::string_view text) { put_bytes(text.data(), text.size()); }

/// Handles data that exceed the room in the buffer.
void OutputFile::put_many_bytes(const void* data, std::size_t size) {
    if (is_alone() && size > buffer_.size()) {
        end_turn();
        write_at(flushed_, data, size);
        flushed_ += size;
        return;
    }
    make_room(size);
    std::memcpy(buffer_.data() + used_, data, size);
    used_ += size;
}

void OutputFile::overwrite(std::uint64_t position, const void* data, std::size_t size) {
    if (is_alone()) end_turn();
    write_kept();
    write_at(position, data, size);
}

void OutputFile::end_turn() {
    write_at(position_of_turn(), buffer_.data(), used_);
    used_ = 0;
}

/// Most file systems let one process at a time write to a file. Therefore even ranks write when the
/// next turn begins, odd ranks in the middle of it: one half writes while the other prepares.
void OutputFile::end_turn_later() {
    kept_position_ = position_of_turn();
    kept_.swap(buffer_);
    kept_size_ = std::exchange(used_, 0);
    room_ = group_->rank() % 2 == 0 ? 0 : std::min(kept_size_ / 2, buffer_.size());
}

std::uint64_t OutputFile::position_of_turn() {
    write_kept();
    if (range_) return std::exchange(range_->begin, range_->begin + used_);
    return position_in_group(used_);
}

/// Collective. Returns the position of this process's bytes, of which each process has `size`.
std::uint64_t OutputFile::position_in_group(std::uint64_t size) {
    const std::uint64_t place = flushed_ + group_->sum_before(size);
    flushed_ += group_->sum(size);
    return place;
}

void OutputFile::begin_ranges(std::uint64_t size) {
    end_turn();
    const std::uint64_t begin = position_in_group(size);
    range_ = {begin, begin + size};
}

void OutputFile::end_ranges() {
    write_kept();
    const bool is_full = range_->begin == range_->end;
    range_.reset();
    if (!is_full && failure_.empty()) {
        failure_ =
            fmt::format("{}: writing failed: rows have an unexpected length", path_.native());
    }
}

void OutputFile::write_kept() {
    write_at(kept_position_, kept_.data(), std::exchange(kept_size_, 0));
    room_ = buffer_.size();
}

void OutputFile::sync() {
    end_turn();
    if (failure_.empty() && ::fsync(file_) != 0) fail("writing failed");
    is_synced_ = true;
    agree();
}

void OutputFile::close() {
    end_turn();
    if (struct stat old{}; group_->is_first() && ::stat(final_path_.c_str(), &old) == 0) {
        copy_permissions(old, file_);
    }
    const int file = std::exchange(file_, -1);
    if (::close(file) != 0) fail("writing failed");
    agree();
}

void OutputFile::commit() {
    if (file_ >= 0) close();
    if (group_->is_first()) rename();
    agree();
    committed_ = true;
}

void OutputFile::commit_all(const std::vector<std::unique_ptr<OutputFile>>& files,
                            const ProcessGroup& group, const std::function<void()>& rest) {
    for (const auto& file : files) file->close();
    // If a signal ends a process, its handler removes the temporary files. No file may be renamed
    // until all processes defer such signals. The first process defers last, so that it can still
    // be ended if another process does not arrive.
    std::optional<DeferredTermination> deferred;
    if (!group.is_first()) deferred.emplace();
    group.agree({});
    if (group.is_first()) deferred.emplace();
    group.on_first([&] {
        for (auto next = files.rbegin(); next != files.rend(); ++next) {
            OutputFile& file = **next;
            file.rename();
            if (!file.failure_.empty()) throw SystemError(file.failure_);
        }
        rest();
    });
    for (const auto& file : files) file->committed_ = true;
}

void OutputFile::rename() {
    // No operation may fail after the rename.
    const std::filesystem::path folder =
        final_path_.has_parent_path() ? final_path_.parent_path() : ".";
    if (::rename(temporary_.c_str(), final_path_.c_str()) != 0)
        return fail("renaming the temporary file failed");
    if (is_synced_) sync_folder(folder);
}

/// Flushes the buffer on a single process; enlarges it in a group, where it is kept until the turn
/// ends.
void OutputFile::make_room(std::size_t size) {
    if (is_alone()) return end_turn();
    write_kept();
    if (room_ - used_ >= size) return;
    buffer_.resize(std::max({buffer_size, 2 * buffer_.size(), used_ + size}));
    room_ = buffer_.size();
}

void OutputFile::name_temporary(std::uint64_t number) {
    temporary_ = fmt::format("{}.{:012x}.tmp", final_path_.native(), number);
    unfinished_.reset();
    unfinished_ = std::make_unique<UnfinishedFile>(temporary_);
}

/// Returns the random number in the name of the temporary file. A predictable name could be planted
/// as a link to another file, or be in use by a program of the same process number in another
/// container.
std::uint64_t OutputFile::create() {
    // Users without access to the replaced file must not get access to the incomplete one.
    const bool replaces = ::access(final_path_.c_str(), F_OK) == 0;
    const mode_t mode = replaces ? 0600 : 0666;  // subject to the umask
    std::uint64_t number = 0;
    constexpr int max_attempts = 100;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        if (::getentropy(&number, sizeof number) != 0) break;
        number >>= 16U;
        name_temporary(number);
        file_ =
            ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        if (file_ >= 0) return number;
        if (errno != EEXIST) break;
    }
    fail("cannot be written");
    return number;
}

/// Opens the file that the first process has created.
void OutputFile::open_created(std::uint64_t number) {
    name_temporary(number);
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    if (file_ < 0)
        fail("cannot be written by all ranks; is its directory on a shared file system?");
}

void OutputFile::write_at(std::uint64_t position, const void* data, std::size_t size) {
    if (!failure_.empty()) return;  // the failure is reported when the processes agree
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::pwrite(file_, bytes, size, static_cast<off_t>(position));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail("writing failed");
        bytes += written;
        position += static_cast<std::uint64_t>(written);
        size -= static_cast<std::size_t>(written);
    }
}

void OutputFile::fail(std::string_view doing) {
    if (failure_.empty()) {
        failure_ = fmt::format("{}: {}: {}", path_.native(), doing, std::strerror(errno));
    }
    // Other processes of a group may be waiting for this process's turn.
    if (is_alone()) throw SystemError(failure_);
}

void OutputFile::agree() { group_->agree(failure_); }

}  // namespace octetra
