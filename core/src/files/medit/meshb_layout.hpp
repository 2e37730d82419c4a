#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <octetra/core/features.hpp>

#include "files/input/byte_reader.hpp"

/// The layout of Medit's binary format `.meshb`: the number 1, which indicates the byte order, and
/// a version, of 32 bits each; then sections, each with a 32-bit keyword code, the position of the
/// next keyword, a count, and that many rows. Entities are numbered from 1.
namespace octetra {

/// Keyword codes of the lists of a mesh; keywords.hpp has those of other sections.
namespace meshb_code {
inline constexpr std::int32_t dimension = 3;
inline constexpr std::int32_t vertices = 4;
inline constexpr std::int32_t edges = 5;
inline constexpr std::int32_t triangles = 6;
inline constexpr std::int32_t tetrahedra = 8;
inline constexpr std::int32_t end = 54;
}  // namespace meshb_code

/// The four versions differ in the sizes of numbers.
struct MeshbFormat {
    std::int32_t version = 2;
    bool swapped = false;  ///< byte order is opposite to this machine's

    [[nodiscard]] std::size_t position_size() const { return version < 3 ? 4 : 8; }
    /// Size of counts, vertex numbers and references.
    [[nodiscard]] std::size_t integer_size() const { return version < 4 ? 4 : 8; }
    [[nodiscard]] std::size_t real_size() const { return version < 2 ? 4 : 8; }
    /// Size of three coordinates and a reference.
    [[nodiscard]] std::size_t point_size() const { return 3 * real_size() + integer_size(); }
    /// Size of `vertices` vertex numbers and a reference.
    [[nodiscard]] std::size_t entity_size(std::size_t vertices) const {
        return (vertices + 1) * integer_size();
    }
    /// Size of keyword, next position and count.
    [[nodiscard]] std::size_t head_size() const { return 4 + position_size() + integer_size(); }
};

/// The position of a section. All positions are byte offsets in the file.
struct MeshbSection {
    std::uint64_t keyword_at = 0;  ///< 0: there is no such section
    std::uint64_t rows_at = 0;
    std::uint64_t count = 0;
    std::int32_t code = 0;

    [[nodiscard]] bool is_there() const { return keyword_at != 0; }
};

/// The sections of which a mesh consists.
struct MeshbLists {
    MeshbFormat format;
    MeshbSection vertices;
    MeshbSection tetrahedra;
    MeshbSection triangles;
    MeshbSection edges;
    PerFeature<MeshbSection> features;
    bool has_end = false;
};

struct MeshbLayout {
    MeshbLists lists;
    /// Ignored sections, in file order. The count is 0 (unknown) for a keyword that keywords.hpp
    /// does not list.
    std::vector<MeshbSection> skipped;
};

/// Reads the headers of all sections and skips the rows. Guarantees for the result: the rows of all
/// lists are within the file and as many as announced, and there is a section of vertices. Throws
/// InputError "FILE: at byte N: what is wrong".
[[nodiscard]] MeshbLayout read_meshb_layout(ByteReader& reader);

/// Returns notes on ignored sections and on a missing keyword End.
[[nodiscard]] std::vector<std::string> notes_on(const std::filesystem::path& path, bool has_end,
                                                const std::vector<MeshbSection>& skipped);

}  // namespace octetra
