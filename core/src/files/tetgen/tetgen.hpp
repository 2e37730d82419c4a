#pragma once

#include <filesystem>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

/// TetGen's text files: `.node` (vertices), `.ele` (cells), `.face` (facets), `.edge` (edges).
/// Each begins with a header line of counts; every further line begins with the entity's number.
namespace octetra {

[[nodiscard]] Mesh read_tetgen(const std::filesystem::path& path, const ReadOptions& options);

/// Performs no semantic checks; `options` must have only_syntax.
void stream_tetgen(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options);

/// Collective.
void write_tetgen(MeshSource& mesh, const std::filesystem::path& path);

}  // namespace octetra
