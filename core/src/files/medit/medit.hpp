#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_source.hpp>

#include "files/input/growing_mesh.hpp"

/// Medit's format, as text `.mesh` and binary `.meshb`. The text consists of free-form tokens: a
/// keyword, a count, and that many entries, each ending in a reference number (marker or region
/// tag). Entities are numbered from 1. meshb_layout.hpp describes the binary files.
namespace octetra {

/// Collective in the group of `growing`. Reads a mesh. Performs semantic checks unless the options
/// have only_syntax, which a sink and a share require.
void read_medit(const std::filesystem::path& path, const ReadOptions& options,
                GrowingMesh& growing);
void read_meshb(const std::filesystem::path& path, const ReadOptions& options,
                GrowingMesh& growing);

/// Returns the note on a section that is skipped.
[[nodiscard]] std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                                          std::uint64_t count, std::string_view keyword);
/// As above, for a section without a count.
[[nodiscard]] std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                                          std::string_view keyword);
/// As above, for a section of a binary file with an unknown keyword code.
[[nodiscard]] std::string note_on_section(const std::filesystem::path& path,
                                          std::uint64_t keyword_at, std::int32_t code);
/// Message for a file with neither the keyword End nor a section Tetrahedra.
inline constexpr std::string_view truncated_file_error =
    "the file ends before the section Tetrahedra, and without the keyword End: was it cut off?";
/// Returns the note on a file that only lacks the keyword End.
[[nodiscard]] std::string note_on_missing_end(const std::filesystem::path& path);

/// Collective. Returns a sentence naming the data that the format cannot hold, or an empty string.
[[nodiscard]] std::string write_medit(MeshSource& mesh, const std::filesystem::path& path);
/// Writes the lowest sufficient version from 2 on, little-endian.
[[nodiscard]] std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path);
/// Writes this version, 2 to 4. Precondition: it can hold the mesh.
[[nodiscard]] std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path,
                                      std::int32_t version);

/// Returns the lowest version from 2 on (which have 64-bit coordinates) that holds a mesh with
/// these numbers of entities: 2 if all counts and all positions in the file are less than 2^31, 3
/// if the counts are, otherwise 4.
[[nodiscard]] std::int32_t meshb_version(const MeshFacts& facts);

/// Returns a sentence naming data that neither the text nor the binary format holds, or an empty
/// string.
[[nodiscard]] std::string attributes_left_out(const MeshFacts& facts);

}  // namespace octetra
