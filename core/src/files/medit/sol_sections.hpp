#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/sol_fields.hpp>

#include "files/input/line_reader.hpp"
#include "files/input/tokens.hpp"
#include "files/medit/meshb_layout.hpp"

/// How Medit's files of values are laid out: as its meshes, with sections that have a count of
/// rows, a number of fields and a type for each, and then the rows: of each entity the values of
/// all fields.
namespace octetra {

/// A keyword of a section of values, and its code in binary files.
struct SolKeyword {
    std::string_view keyword;
    std::int32_t code;
    std::string_view entities;
};
/// Of vertices and of cells, as FieldOn numbers them; then those that are not kept.
inline constexpr std::array<SolKeyword, 7> sol_keywords{{{"SolAtVertices", 62, "vertices"},
                                                         {"SolAtTetrahedra", 66, "tetrahedra"},
                                                         {"SolAtEdges", 63, "edges"},
                                                         {"SolAtTriangles", 64, "triangles"},
                                                         {"SolAtQuadrilaterals", 65, "entities"},
                                                         {"SolAtPrisms", 67, "entities"},
                                                         {"SolAtHexahedra", 68, "entities"}}};
inline constexpr std::size_t kept_sol_keywords = 2;

/// Components of the types 1 to 4: scalar, vector, symmetric and full tensor, in three dimensions.
inline constexpr std::array<std::size_t, 4> sol_components{1, 3, 6, 9};
/// The type of a field with so many components, counted from 1; 0 if there is none.
[[nodiscard]] std::int32_t sol_type(std::size_t components);

/// More than anybody has.
inline constexpr std::size_t most_sol_fields = 1000;

/// What a section announces.
struct SolSection {
    std::size_t keyword = 0;  ///< place in sol_keywords
    std::uint64_t count = 0;
    std::vector<std::size_t> components;
    std::uint64_t keyword_at = 0;  ///< line, or byte
    std::uint64_t rows_at = 0;     ///< of a binary file: the byte

    [[nodiscard]] std::size_t width() const;
    /// What is kept of it, without rows.
    [[nodiscard]] FieldRows without_rows() const;
};

/// What is wrong with a count, a number of fields, or a type; or nothing.
[[nodiscard]] std::string wrong_sol_count(const SolSection& section,
                                          const std::optional<EntityCounts>& expected);
[[nodiscard]] std::string wrong_field_count(std::int64_t fields);
[[nodiscard]] std::string wrong_sol_type(std::int64_t type);
/// What is wrong with a value that is finite; or nothing.
[[nodiscard]] std::string wrong_value(double value);

[[nodiscard]] std::string second_sol_section(std::string_view keyword);

/// Place in sol_keywords of a keyword, or of a code; that array's size if it is none of these.
[[nodiscard]] std::size_t sol_keyword(std::string_view keyword);
[[nodiscard]] std::size_t sol_keyword(std::int32_t code);

/// Of a text file, behind the keyword: its count, fields and types.
[[nodiscard]] SolSection take_sol_head(Tokens& tokens, const LineReader& reader,
                                       std::size_t keyword,
                                       const std::optional<EntityCounts>& expected);

/// A value of a text file, from Fields or Tokens.
[[nodiscard]] double take_sol_value(auto& numbers, const LineReader& reader) {
    const double value = numbers.real("a value");
    if (const std::string wrong = wrong_value(value); !wrong.empty()) reader.fail(wrong);
    return value;
}

/// The layout of a binary file: what is kept, and notes on the rest.
struct SolbLayout {
    MeshbFormat format;
    std::vector<SolSection> sections;
    std::vector<std::string> notes;
};
[[nodiscard]] SolbLayout read_solb_layout(ByteReader& reader,
                                          const std::optional<EntityCounts>& expected);
/// Rows first .. first + count - 1 of a section.
[[nodiscard]] std::vector<double> read_solb_rows(ByteReader& reader, const MeshbFormat& format,
                                                 const SolSection& section, std::uint64_t first,
                                                 std::uint64_t count);

}  // namespace octetra
