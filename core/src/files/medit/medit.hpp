#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

/// Medit's text format `.mesh`: free-form tokens; a keyword, a count, that many entries, each
/// ending in a reference number (our markers and region tags). Entities are numbered from 1.
namespace octetra {

[[nodiscard]] Mesh read_medit(const std::filesystem::path& path, const ReadOptions& options);

/// Takes everything as it stands; `options` must have only_syntax.
void stream_medit(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options);

/// What a reader says of a section that is not kept, and of a file without the last keyword.
[[nodiscard]] std::string note_on_skipped(const std::filesystem::path& path, std::uint64_t line,
                                          std::uint64_t count, std::string_view keyword);
[[nodiscard]] std::string note_on_missing_end(const std::filesystem::path& path);

/// Collective. Returns what of the mesh the format cannot hold, in a sentence, or nothing.
[[nodiscard]] std::string write_medit(MeshSource& mesh, const std::filesystem::path& path);

}  // namespace octetra
