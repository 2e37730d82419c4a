#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <octetra/core/files/mesh_files.hpp>

/// Formats in which a history writes its mesh, to continue with the mesh that is read.
namespace octetra::properties {

struct Format {
    std::string name;
    std::string extension;
    WriteOptions options;
};

[[nodiscard]] const std::vector<Format>& formats();
inline const std::string simplest_format = "medit text";

/// Throws std::out_of_range.
[[nodiscard]] const Format& format_named(const std::string& name);

/// Writes the mesh and reads it again, on one process.
[[nodiscard]] Mesh rewritten(const Mesh& mesh, const Format& format);

}  // namespace octetra::properties
