#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <octetra/core/files/mesh_files.hpp>

/// Formats that a history writes its mesh in, to go on with what is read.
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

/// What one process by itself writes and reads again.
[[nodiscard]] Mesh rewritten(const Mesh& mesh, const Format& format);

}  // namespace octetra::properties
