#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/mesh_source.hpp>

#include "files/output/number_text.hpp"
#include "files/output/unfinished_files.hpp"

namespace octetra {

/// A file that is written under a temporary name in the same directory and renamed on commit(). The
/// destructor removes an uncommitted file. Every failure throws SystemError. Symbolic links are
/// followed to the final path. An existing file is replaced; its permissions and, as far as the
/// system allows, its owner and group are kept.
///
/// A group of processes writes one file in turns: the bytes that each process has put since the
/// last turn follow those of lower ranks. The constructor, both functions that end a turn, close()
/// and commit() are collective, and throw failures on all processes. A single process needs no
/// turns.
class OutputFile {
public:
    explicit OutputFile(std::filesystem::path path,
                        const ProcessGroup& group = ProcessGroup::alone());
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&&) = delete;
    OutputFile& operator=(OutputFile&&) = delete;

    void put(char c) {
        if (used_ == room_) make_room(1);
        buffer_[used_++] = c;
    }
    void put(std::string_view text);
    void put(double number) { put_as_text(number); }
    void put(std::integral auto number) { put_as_text(number); }
    void put_bytes(const void* data, std::size_t size) {
        if (size == 0) return;
        if (room_ - used_ < size) return put_many_bytes(data, size);
        std::memcpy(buffer_.data() + used_, data, size);
        used_ += size;
    }

    /// Returns space for `size` bytes. The caller writes text there and passes its end to
    /// put_up_to().
    [[nodiscard]] char* room_for(std::size_t size) {
        if (room_ - used_ < size) make_room(size);
        return buffer_.data() + used_;
    }
    void put_up_to(const char* end) { used_ = static_cast<std::size_t>(end - buffer_.data()); }

    /// The path of the file until commit().
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

    /// Writes the buffered bytes to the file.
    void end_turn();
    /// Same, but the bytes may be written during the next turn; they must not be overwritten before
    /// that has ended.
    void end_turn_later();

    /// Until end_ranges(), each process writes to a byte range of the given size of its own, in
    /// the order of ranks. end_turn_later() is not collective meanwhile.
    void begin_ranges(std::uint64_t size);
    /// Fails if a process has not put as many bytes as it announced.
    void end_ranges();

    /// The number of bytes put so far, which is the position of the next one. In a group it is
    /// valid at the end of a turn, and equal on all processes.
    [[nodiscard]] std::uint64_t position() const { return flushed_ + used_; }
    /// Overwrites bytes that were put before (in earlier turns, by any process).
    void overwrite(std::uint64_t position, const void* data, std::size_t size);

    /// Collective. Synchronises the file to disk, and its directory after the rename, so that a
    /// committed file survives a crash of the machine.
    void sync();
    /// Writes all bytes to the file and closes it.
    void close();
    void commit();
    /// Commits files that belong together, when all are complete: the last one first, so that all
    /// are committed if the first one is. Then calls `rest` on the first process. Signals that
    /// would end the program are deferred meanwhile.
    static void commit_all(const std::vector<std::unique_ptr<OutputFile>>& files,
                           const ProcessGroup& group, const std::function<void()>& rest);

private:
    void put_many_bytes(const void* data, std::size_t size);
    void put_as_text(auto number) { put_up_to(put_number(room_for(longest_number), number)); }
    [[nodiscard]] bool is_alone() const { return group_->size() == 1; }
    void make_room(std::size_t size);
    [[nodiscard]] std::uint64_t position_of_turn();
    [[nodiscard]] std::uint64_t position_in_group(std::uint64_t size);
    void write_kept();
    void name_temporary(std::uint64_t number);
    std::uint64_t create();
    void open_created(std::uint64_t number);
    void rename();
    void write_at(std::uint64_t position, const void* data, std::size_t size);
    void fail(std::string_view doing);
    void agree();

    const ProcessGroup* group_;
    std::filesystem::path path_;        ///< as passed by the caller
    std::filesystem::path final_path_;  ///< after following links
    std::filesystem::path temporary_;   ///< final_path_, a random number and ".tmp"
    std::unique_ptr<UnfinishedFile> unfinished_;
    int file_ = -1;
    std::vector<char> buffer_;
    std::size_t room_ = 0;  ///< bytes of the buffer that may be used before make_room()
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
    std::vector<char> kept_;     ///< of a group: the bytes of the last turn, kept_size_ of them,
    std::size_t kept_size_ = 0;  ///< until they are written: then 0
    std::uint64_t kept_position_ = 0;
    /// The rest of this process's byte range, while there is one.
    struct ByteRange {
        std::uint64_t begin;
        std::uint64_t end;
    };
    std::optional<ByteRange> range_;
    bool committed_ = false;
    bool is_synced_ = false;
    std::string failure_;  ///< the first one, until it is thrown
};

}  // namespace octetra
