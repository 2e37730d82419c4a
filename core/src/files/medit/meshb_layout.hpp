#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <octetra/core/features.hpp>

#include "files/input/byte_reader.hpp"

/// How Medit's binary format `.meshb` is laid out: 1, which tells the byte order, and a version, of
/// 32 bits each; then sections: a keyword's code of 32 bits, the position of the next keyword, a
/// count, and as many rows. Entities are numbered from 1.
namespace octetra {

/// Codes of keywords of a mesh's lists; keywords.hpp has those of others.
namespace meshb_code {
inline constexpr std::int32_t dimension = 3;
inline constexpr std::int32_t vertices = 4;
inline constexpr std::int32_t edges = 5;
inline constexpr std::int32_t triangles = 6;
inline constexpr std::int32_t tetrahedra = 8;
inline constexpr std::int32_t end = 54;
}  // namespace meshb_code

/// The four versions differ in how many bytes numbers take.
struct MeshbFormat {
    std::int32_t version = 2;
    bool swapped = false;  ///< in the other byte order than this machine's

    [[nodiscard]] std::size_t position_size() const { return version < 3 ? 4 : 8; }
    /// Of counts, vertex numbers and references.
    [[nodiscard]] std::size_t integer_size() const { return version < 4 ? 4 : 8; }
    [[nodiscard]] std::size_t real_size() const { return version < 2 ? 4 : 8; }
    /// Three coordinates and a reference.
    [[nodiscard]] std::size_t point_size() const { return 3 * real_size() + integer_size(); }
    /// So many vertices and a reference.
    [[nodiscard]] std::size_t entity_size(std::size_t vertices) const {
        return (vertices + 1) * integer_size();
    }
    /// Keyword, next position and count.
    [[nodiscard]] std::size_t head_size() const { return 4 + position_size() + integer_size(); }
};

/// Where a section is. All positions count bytes from the file's beginning.
struct MeshbSection {
    std::uint64_t keyword_at = 0;  ///< 0: there is no such section
    std::uint64_t rows_at = 0;
    std::uint64_t count = 0;
    std::int32_t code = 0;

    [[nodiscard]] bool is_there() const { return keyword_at != 0; }
};

/// The sections that a mesh is made of.
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
    /// In the order of the file. Of a keyword that keywords.hpp has no name for the count is not
    /// known, and 0.
    std::vector<MeshbSection> skipped;
};

/// Goes from keyword to keyword, and over the rows. What holds of a layout that is returned: rows
/// of all lists are in the file, and as many as announced; there are vertices. Throws InputError
/// "FILE: at byte N: what is wrong".
[[nodiscard]] MeshbLayout read_meshb_layout(ByteReader& reader);

/// What is said of the sections that are not kept, and of a file without the last keyword.
[[nodiscard]] std::vector<std::string> notes_on(const std::filesystem::path& path, bool has_end,
                                                const std::vector<MeshbSection>& skipped);

}  // namespace octetra
