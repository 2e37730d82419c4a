#include "files/medit/meshb_sections.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

namespace octetra {

MeshbSections::MeshbSections(ByteReader& reader) : reader_(&reader) {
    const auto one = reader_->take<std::int32_t>("the number 1");
    reader_->swap_bytes(one == 0x01000000);
    if (one != 1 && !reader_->swaps_bytes()) {
        constexpr std::array text{'M', 'e', 's', 'h'};  // MeshVersionFormatted
        constexpr std::array mfem{'M', 'F', 'E', 'M'};
        const auto begin = std::bit_cast<std::array<char, 4>>(one);
        if (begin == text) reader_->fail("this is a text file: name it .mesh", 0);
        if (begin == mfem) {
            reader_->fail("this is a mesh of MFEM; of .meshb files only those of Medit are read",
                          0);
        }
        reader_->fail(fmt::format("a binary Medit file begins with the number 1, of 32 bits in "
                                  "either byte order, not with {}",
                                  one),
                      0);
    }
    const auto version = reader_->take<std::int32_t>("the format's version");
    if (version < 1 || version > 4) {
        reader_->fail(fmt::format("the Medit format has versions 1 to 4, not {}", version), 4);
    }
    format_ = {version, reader_->swaps_bytes()};
}

std::int64_t MeshbSections::take_position() {
    constexpr std::string_view what = "the position of the next keyword";
    if (format_.position_size() == 4) return reader_->take<std::int32_t>(what);
    return reader_->take<std::int64_t>(what);
}

std::uint64_t MeshbSections::take_count() {
    constexpr std::string_view what = "the number of entries";
    const std::uint64_t at = reader_->position();
    const std::int64_t count = format_.integer_size() == 4
                                   ? std::int64_t{reader_->take<std::int32_t>(what)}
                                   : reader_->take<std::int64_t>(what);
    if (count < 0) {
        reader_->fail(fmt::format("the number of entries should be from 0, not {}", count), at);
    }
    return static_cast<std::uint64_t>(count);
}

/// Reads the header of the next section. Returns false at the end.
bool MeshbSections::next(MeshbRecord& record) {
    if (is_last_ || reader_->remaining() == 0) return false;
    if (++sections_ > most) {
        reader_->fail(fmt::format("more than {} keywords; is this a mesh?", most));
    }
    record = {.keyword_at = reader_->position()};
    record.code = reader_->take<std::int32_t>("a keyword");
    if (record.code == meshb_code::end) {
        read_end();
        return false;
    }
    const std::uint64_t position_at = reader_->position();
    const std::int64_t next = take_position();
    is_last_ = next == 0;
    record.end = is_last_ ? reader_->size() : static_cast<std::uint64_t>(next);
    // Positions must ascend, which guarantees termination.
    if (next != 0 && (next < 0 || record.end < reader_->position())) {
        reader_->fail(
            fmt::format("the next keyword is said to be at byte {}, before this one's end", next),
            position_at);
    }
    if (record.end > reader_->size()) {
        reader_->fail(fmt::format("the next keyword is said to be at byte {}, but the file has "
                                  "{}; was it cut off?",
                                  next, reader_->size()),
                      position_at);
    }
    return true;
}

/// Reads the position after the last keyword, which some programs write and others do not.
void MeshbSections::read_end() {
    has_end_ = true;
    if (reader_->remaining() == 0) return;
    const std::uint64_t at = reader_->position();
    const std::int64_t next = take_position();
    if (next != 0 && static_cast<std::uint64_t>(next) != reader_->size()) {
        reader_->fail(fmt::format("a keyword after End is said to be at byte {}", next), at);
    }
    if (reader_->remaining() > 0) reader_->fail("extra bytes after the keyword End");
}

void MeshbSections::take_dimension() {
    const std::uint64_t at = reader_->position();
    const auto dimension = reader_->take<std::int32_t>("the dimension");
    if (dimension != 3) {
        reader_->fail(fmt::format("dimension 3 expected, {} found", dimension), at);
    }
}

void MeshbSections::check_rows(std::uint64_t count, std::size_t row_size, std::string_view name,
                               std::uint64_t count_at, const MeshbRecord& record) const {
    reader_->check_count(count, row_size, name, count_at);
    const std::uint64_t end = reader_->position() + count * row_size;
    if (end == record.end) return;
    reader_->fail(fmt::format("{} {} announced, which end at byte {}, but the next keyword is said "
                              "to be at byte {}",
                              count, name, end, record.end),
                  count_at);
}

}  // namespace octetra
