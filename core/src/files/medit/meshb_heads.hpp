#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include <octetra/core/mesh_source.hpp>

#include "files/medit/meshb_layout.hpp"
#include "files/output/output_file.hpp"

namespace octetra {

static_assert(std::endian::native == std::endian::little,
              "output is little-endian; a big-endian machine has to swap bytes");

/// Returns the lowest version from 2 on (which have 64-bit reals) for a file with lists of at most
/// `most` entries and positions up to `size`.
[[nodiscard]] inline std::int32_t lowest_meshb_version(std::uint64_t most, std::uint64_t size) {
    constexpr std::uint64_t most_in_32_bits = std::numeric_limits<std::int32_t>::max();
    if (most > most_in_32_bits) return 4;
    return size > most_in_32_bits ? 3 : 2;
}

/// Writes the headers of a binary Medit file on the first process.
class MeshbHeads {
public:
    MeshbHeads(const MeshSource& mesh, OutputFile& out, std::int32_t version)
        : is_first_(mesh.group().is_first()), out_(&out), format_{version} {}

    [[nodiscard]] const MeshbFormat& format() const { return format_; }

    /// Writes a number as its bytes.
    void put_first(auto number) {
        if (is_first_) out_->put_bytes(&number, sizeof number);
    }
    /// Writes the byte order, the version, and the section Dimension.
    void put_start() {
        put_first(std::int32_t{1});
        put_first(format_.version);
        put_first(meshb_code::dimension);
        put_position(start_size(format_));
        put_first(std::int32_t{3});
        written_ = start_size(format_);
    }
    /// Writes the keyword, position and count of a section with `content` bytes after its header.
    void put_section(std::int32_t code, std::uint64_t count, std::uint64_t content) {
        written_ += format_.head_size() + content;
        put_first(code);
        put_position(written_);
        if (format_.integer_size() == 4) return put_first(static_cast<std::int32_t>(count));
        put_first(static_cast<std::int64_t>(count));
    }
    void put_end() {
        put_first(meshb_code::end);
        put_position(0);
    }

    [[nodiscard]] static std::uint64_t start_size(const MeshbFormat& format) {
        return 4 + 4 + 4 + format.position_size() + 4;
    }

private:
    void put_position(std::uint64_t position) {
        if (format_.position_size() == 4) return put_first(static_cast<std::int32_t>(position));
        put_first(static_cast<std::int64_t>(position));
    }

    bool is_first_;
    OutputFile* out_;
    MeshbFormat format_;
    std::uint64_t written_ = 0;  ///< position of the next section
};

}  // namespace octetra
