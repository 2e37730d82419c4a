#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

/// Medit's format, as text `.mesh` and in binary `.meshb`. The text is free-form tokens; a keyword,
/// a count, that many entries, each ending in a reference number (our markers and region tags).
/// Entities are numbered from 1. meshb_layout.hpp tells of the binary files.
namespace octetra {

[[nodiscard]] Mesh read_medit(const std::filesystem::path& path, const ReadOptions& options);
[[nodiscard]] Mesh read_meshb(const std::filesystem::path& path, const ReadOptions& options);

/// Takes everything as it stands; `options` must have only_syntax.
void stream_medit(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options);
void stream_meshb(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options);

/// What a reader says of a section that is not kept.
[[nodiscard]] std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                                          std::uint64_t count, std::string_view keyword);
/// The same of a section without a number of entries.
[[nodiscard]] std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                                          std::string_view keyword);
/// The same of a section of a binary file, of which only the keyword's code is known.
[[nodiscard]] std::string note_on_section(const std::filesystem::path& path,
                                          std::uint64_t keyword_at, std::int32_t code);
/// Why a file is refused that has neither the keyword End nor a section Tetrahedra.
inline constexpr std::string_view ends_early =
    "the file ends before the section Tetrahedra, and without the keyword End: was it cut off?";
/// Of a file that lacks that keyword alone.
[[nodiscard]] std::string note_on_missing_end(const std::filesystem::path& path);

/// Collective. Returns what of the mesh the format cannot hold, in a sentence, or nothing.
[[nodiscard]] std::string write_medit(MeshSource& mesh, const std::filesystem::path& path);
/// In the lowest version from 2 on that can hold it, little-endian.
[[nodiscard]] std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path);
/// In this version, 2 to 4, which must be able to hold the mesh.
[[nodiscard]] std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path,
                                      std::int32_t version);

/// The lowest version from 2 on, which has coordinates of 64 bits, that holds a mesh of so many
/// entities: 2 if all counts and all positions in the file are less than 2^31, 3 if the counts are,
/// else 4.
[[nodiscard]] std::int32_t meshb_version(const MeshFacts& facts);

/// What of the mesh neither file holds, in a sentence, or nothing.
[[nodiscard]] std::string attributes_left_out(const MeshFacts& facts);

}  // namespace octetra
