#include "files/stretches/readers.hpp"

#include <octetra/core/standard_arithmetic.hpp>

namespace octetra {

std::optional<MeshStretch> read_stretch(const std::filesystem::path& path,
                                        const ProcessGroup& group) {
    const StandardArithmetic standard;
    const std::filesystem::path extension = path.extension();
    if (extension == ".ele" || extension == ".node") return read_tetgen_stretch(path, group);
    if (extension == ".mesh") return read_medit_stretch(path, group);
    if (extension == ".meshb") return read_meshb_stretch(path, group);
    if (extension == ".msh") return read_gmsh_stretch(path, group);
    return std::nullopt;
}

}  // namespace octetra
