#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "files/input/byte_reader.hpp"
#include "files/medit/meshb_layout.hpp"

namespace octetra {

/// A section: its keyword's code, position and end.
struct MeshbRecord {
    std::int32_t code = 0;
    std::uint64_t keyword_at = 0;
    std::uint64_t end = 0;  ///< of the section
};

/// Iterates over the sections of a binary Medit file, whatever their content. All functions throw
/// InputError "FILE: at byte N: what is wrong".
class MeshbSections {
public:
    /// Upper limit of the number of sections, more than any valid file has: bounds the memory used
    /// for a malicious file.
    static constexpr std::size_t most = 1000;

    /// Reads the bytes before the first keyword. The reader must outlive the object.
    explicit MeshbSections(ByteReader& reader);

    [[nodiscard]] const MeshbFormat& format() const { return format_; }
    /// Calls take(record) for each section, with the reader at the beginning of its content.
    /// Returns whether the file ends with the keyword End.
    bool for_each(auto&& take) {
        MeshbRecord record;
        while (next(record)) {
            take(static_cast<const MeshbRecord&>(record));
            reader_->seek(record.end);
        }
        return has_end_;
    }

    // Functions for the section passed to take():

    [[nodiscard]] std::uint64_t take_count();
    /// Reads the dimension; throws unless it is 3.
    void take_dimension();
    /// Throws unless `count` rows, announced at byte `count_at`, end where the section ends.
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
