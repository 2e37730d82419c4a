#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "files/input/byte_reader.hpp"
#include "files/medit/meshb_layout.hpp"

namespace octetra {

/// What stands between a keyword's code and the next keyword.
struct MeshbRecord {
    std::int32_t code = 0;
    std::uint64_t keyword_at = 0;
    std::uint64_t end = 0;  ///< of the section
};

/// Goes through the sections of a binary file of Medit's, whatever they hold. All throws
/// InputError "FILE: at byte N: what is wrong".
class MeshbSections {
public:
    /// More than any file has: who makes up a file must not make us remember it.
    static constexpr std::size_t most = 1000;

    /// Reads what stands before the first keyword. The reader must live as long.
    explicit MeshbSections(ByteReader& reader);

    [[nodiscard]] const MeshbFormat& format() const { return format_; }
    /// Calls take(record) for each section, with the reader where its content begins. Returns
    /// whether the file ends with the last keyword.
    bool for_each(auto&& take) {
        MeshbRecord record;
        while (next(record)) {
            take(static_cast<const MeshbRecord&>(record));
            reader_->seek(record.end);
        }
        return has_end_;
    }

    // Of the section that is being taken:

    [[nodiscard]] std::uint64_t take_count();
    /// Refuses any but 3.
    void take_dimension();
    /// Refuses rows, `count` of which are announced at byte `count_at`, that do not end with the
    /// section.
    void check_rows(std::uint64_t count, std::size_t row_size, std::string_view name,
                    std::uint64_t count_at, const MeshbRecord& record) const;

private:
    bool next(MeshbRecord& record);
    std::int64_t take_position();
    void read_end();

    ByteReader* reader_;
    MeshbFormat format_;
    std::size_t sections_ = 0;
    bool is_last_ = false;
    bool has_end_ = false;
};

}  // namespace octetra
