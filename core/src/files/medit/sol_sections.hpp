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

/// The layout of Medit's solution files: as mesh files, with sections that have a count of rows, a
/// number of fields, a type for each field, and then the rows, each with the values of all fields
/// for one entity.
namespace octetra {

/// The keyword of a section of values, and its code in binary files.
struct SolKeyword {
    std::string_view keyword;
    std::int32_t code;
    std::string_view entities;
};
/// Sections of vertices and cells, in the order of FieldOn, followed by sections that are ignored.
inline constexpr std::array<SolKeyword, 7> sol_keywords{{{"SolAtVertices", 62, "vertices"},
                                                         {"SolAtTetrahedra", 66, "tetrahedra"},
                                                         {"SolAtEdges", 63, "edges"},
                                                         {"SolAtTriangles", 64, "triangles"},
                                                         {"SolAtQuadrilaterals", 65, "entities"},
                                                         {"SolAtPrisms", 67, "entities"},
                                                         {"SolAtHexahedra", 68, "entities"}}};
inline constexpr std::size_t kept_sol_keywords = 2;

/// The number of components of the types 1 to 4: scalar, vector, symmetric and full tensor, in
/// three dimensions.
inline constexpr std::array<std::size_t, 4> sol_components{1, 3, 6, 9};
/// Returns the type of a field with this number of components, counted from 1; 0 if there is none.
[[nodiscard]] std::int32_t sol_type(std::size_t components);

/// Upper limit of the number of fields in a section, larger than needed in practice.
inline constexpr std::size_t max_sol_fields = 1000;

/// The header of a section.
struct SolSection {
    std::size_t keyword = 0;  ///< position in sol_keywords
    std::uint64_t count = 0;
    std::vector<std::size_t> components;
    std::uint64_t keyword_at = 0;  ///< line, or byte offset
    std::uint64_t rows_at = 0;     ///< byte offset, for a binary file

    [[nodiscard]] std::size_t width() const;
    /// Returns the fields of the section, without rows.
    [[nodiscard]] FieldRows without_rows() const;
};

/// Return an error message for a count, a number of fields or a type, or an empty string.
[[nodiscard]] std::string wrong_sol_count(const SolSection& section,
                                          const std::optional<EntityCounts>& expected);
[[nodiscard]] std::string wrong_field_count(std::int64_t fields);
[[nodiscard]] std::string wrong_sol_type(std::int64_t type);
/// Returns an error message for a value that is not finite or too large, or an empty string.
[[nodiscard]] std::string wrong_value(double value);

[[nodiscard]] std::string second_sol_section(std::string_view keyword);

/// Returns the position in sol_keywords of a keyword or code, or the size of the array if not
/// found.
[[nodiscard]] std::size_t sol_keyword(std::string_view keyword);
[[nodiscard]] std::size_t sol_keyword(std::int32_t code);

/// Reads the count, fields and types of a section of a text file, after its keyword.
[[nodiscard]] SolSection take_sol_head(Tokens& tokens, const LineReader& reader,
                                       std::size_t keyword,
                                       const std::optional<EntityCounts>& expected);

/// Reads a value of a text file, from Fields or Tokens.
[[nodiscard]] double take_sol_value(auto& numbers, const LineReader& reader) {
    const double value = numbers.real("a value");
    if (const std::string wrong = wrong_value(value); !wrong.empty()) reader.fail(wrong);
    return value;
}

/// The layout of a binary file: sections of vertices and cells, and notes on other sections.
struct SolbLayout {
    MeshbFormat format;
    std::vector<SolSection> sections;
    std::vector<std::string> notes;
};
[[nodiscard]] SolbLayout read_solb_layout(ByteReader& reader,
                                          const std::optional<EntityCounts>& expected);
/// Returns rows first .. first + count - 1 of a section.
[[nodiscard]] std::vector<double> read_solb_rows(ByteReader& reader, const MeshbFormat& format,
                                                 const SolSection& section, std::uint64_t first,
                                                 std::uint64_t count);

}  // namespace octetra
