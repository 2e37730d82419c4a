#include "files/stretches/readers.hpp"

#include <octetra/core/standard_arithmetic.hpp>

namespace octetra {

std::optional<MeshShare> read_mesh_share(const std::filesystem::path& path,
                                         const ProcessGroup& group) {
    const StandardArithmetic standard;
    const std::filesystem::path extension = path.extension();
    if (extension == ".ele" || extension == ".node") return read_tetgen_share(path, group);
    if (extension == ".mesh") return read_medit_share(path, group);
    if (extension == ".meshb") return read_meshb_share(path, group);
    if (extension == ".msh") return read_gmsh_share(path, group);
    return std::nullopt;
}

}  // namespace octetra
