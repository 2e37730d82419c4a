#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

/// The formats of mesh files: their extensions, and the data that they can hold.
namespace octetra {

enum class Format { tetgen, medit, meshb, gmsh, vtu, pvtu, vtkhdf, xdmf, checkpoint, unknown };

struct MeshFormat {
    Format format = Format::unknown;
    /// The extensions by which a mesh is named, then those of the files beside it; empty ones at
    /// the end.
    std::array<std::string_view, 4> extensions{};
    std::size_t names = 0;  ///< number of extensions by which a mesh is named
    bool attributes = true;
    bool vertex_markers = true;
    bool facets = true;
    bool parents = true;
    bool fields = false;  ///< in the mesh file, and by write_mesh()
    bool features = false;
    bool group_names = false;
};

inline constexpr std::array<MeshFormat, 9> mesh_formats{{
    {.format = Format::tetgen,
     .extensions = {".node", ".ele", ".face", ".edge"},
     .names = 2,
     .parents = false},
    {.format = Format::medit,
     .extensions = {".mesh", ".sol"},
     .names = 1,
     .attributes = false,
     .parents = false,
     .features = true},
    {.format = Format::meshb,
     .extensions = {".meshb", ".solb"},
     .names = 1,
     .attributes = false,
     .parents = false,
     .features = true},
    {.format = Format::gmsh,
     .extensions = {".msh"},
     .names = 1,
     .attributes = false,
     .vertex_markers = false,
     .parents = false,
     .group_names = true},
    {.format = Format::vtu, .extensions = {".vtu"}, .names = 1, .facets = false, .fields = true},
    {.format = Format::pvtu, .extensions = {".pvtu"}, .names = 1, .facets = false, .fields = true},
    {.format = Format::vtkhdf,
     .extensions = {".vtkhdf"},
     .names = 1,
     .facets = false,
     .fields = true},
    {.format = Format::xdmf, .extensions = {".xdmf", ".h5"}, .names = 1, .fields = true},
    {.format = Format::checkpoint, .extensions = {".octetra"}, .names = 1},
}};

/// Returns the format of a mesh of this name, by its extension; the default one if it is unknown.
[[nodiscard]] inline MeshFormat mesh_format_of(const std::filesystem::path& path) {
    const std::filesystem::path extension = path.extension();
    for (const MeshFormat& format : mesh_formats) {
        for (std::size_t k = 0; k < format.names; ++k) {
            if (extension == format.extensions.at(k)) return format;
        }
    }
    return {};
}
[[nodiscard]] inline Format format_of(const std::filesystem::path& path) {
    return mesh_format_of(path).format;
}

/// Returns whether a file of this name would be one of the files of a mesh.
[[nodiscard]] inline bool is_mesh_file(const std::filesystem::path& path) {
    const std::filesystem::path extension = path.extension();
    if (extension.empty()) return false;
    return std::ranges::any_of(mesh_formats, [&](const MeshFormat& format) {
        return std::ranges::any_of(format.extensions,
                                   [&](std::string_view one) { return extension == one; });
    });
}

}  // namespace octetra
