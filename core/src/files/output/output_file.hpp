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

/// A file that is written under a temporary name beside its final place and takes that place only
/// on commit(). Destroyed before, it leaves no trace. Every failure throws SystemError.
/// A link is followed: the place is where it leads. A file that is there already passes its
/// permissions on and, as far as the system allows, its owner and group.
///
/// A group of processes writes one file by taking turns: what each has put since the last turn
/// follows what the lower ranks have put. Constructing, both ways of ending a turn, close() and
/// commit() are collective, and failures are thrown there, on all processes. One process alone
/// needs no turns.
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

    /// Room for so many bytes, for who puts text there himself and then tells where it ends.
    [[nodiscard]] char* room_for(std::size_t size) {
        if (room_ - used_ < size) make_room(size);
        return buffer_.data() + used_;
    }
    void put_up_to(const char* end) { used_ = static_cast<std::size_t>(end - buffer_.data()); }

    /// Where it is until commit().
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

    /// Brings what has been put to the file.
    void end_turn();
    /// The same, but what has been put may come to the file in the course of the next turn: until
    /// that has ended nothing of it may be overwritten.
    void end_turn_later();

    /// From here to end_stretches() each process has a stretch of `size` bytes of the file to
    /// itself, by rank, and its turns, which end_turn_later() ends, are no other's affair.
    void begin_stretches(std::uint64_t size);
    /// Fails where a process has not put as many bytes as it said.
    void end_stretches();

    /// How many bytes have been put so far: where the next one will stand. For a group: at the end
    /// of a turn, and the same on all processes.
    [[nodiscard]] std::uint64_t position() const { return flushed_ + used_; }
    /// Replaces bytes that were put before (in earlier turns, by whichever process).
    void overwrite(std::uint64_t position, const void* data, std::size_t size);

    /// Collective. Brings everything to the disk, and its place when it is put there: once it has
    /// its final name it has it for good, whatever becomes of the machine.
    void sync();
    /// Brings everything to the file and closes it.
    void close();
    void commit();
    /// Commits files that belong together, when all are complete: the last first, so that where the
    /// first one is in its place all are. Then does `rest` on the first process. A signal that
    /// would end the program in between waits until all is done.
    static void commit_all(const std::vector<std::unique_ptr<OutputFile>>& files,
                           const ProcessGroup& group, const std::function<void()>& rest);

private:
    void put_many_bytes(const void* data, std::size_t size);
    void put_as_text(auto number) { put_up_to(put_number(room_for(longest_number), number)); }
    [[nodiscard]] bool is_alone() const { return group_->size() == 1; }
    void make_room(std::size_t size);
    [[nodiscard]] std::uint64_t place_of_turn();
    [[nodiscard]] std::uint64_t place_in_group(std::uint64_t size);
    void write_kept();
    void name_temporary(std::uint64_t number);
    std::uint64_t create();
    void open_created(std::uint64_t number);
    void rename();
    void write_at(std::uint64_t position, const void* data, std::size_t size);
    void fail(std::string_view doing);
    void agree();

    const ProcessGroup* group_;
    std::filesystem::path path_;       ///< as it was named
    std::filesystem::path place_;      ///< where its links lead
    std::filesystem::path temporary_;  ///< the place, a random number and ".tmp"
    std::unique_ptr<UnfinishedFile> unfinished_;
    int file_ = -1;
    std::vector<char> buffer_;
    std::size_t room_ = 0;  ///< so much of the buffer may be used before something must be done
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
    std::vector<char> kept_;     ///< of a group: what the last turn has put, kept_size_ bytes,
    std::size_t kept_size_ = 0;  ///< until it is written: then 0
    std::uint64_t kept_position_ = 0;
    /// What is left of this process's stretch, while there is one.
    struct Stretch {
        std::uint64_t begin;
        std::uint64_t end;
    };
    std::optional<Stretch> stretch_;
    bool committed_ = false;
    bool is_synced_ = false;
    std::string failure_;  ///< the first one, until it is thrown
};

}  // namespace octetra
