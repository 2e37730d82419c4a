#include "properties/histories/rewriting.hpp"

#include <algorithm>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace octetra::properties {

const std::vector<Format>& formats() {
    static const std::vector<Format> all{
        {simplest_format, ".mesh", {}},
        {"medit binary", ".meshb", {}},
        {"tetgen", ".ele", {}},
        {"gmsh 4 binary", ".msh", {}},
        {"gmsh 4 text", ".msh", {.msh = {.is_2 = false, .is_text = true}}},
        {"gmsh 2 binary", ".msh", {.msh = {.is_2 = true, .is_text = false}}},
        {"gmsh 2 text", ".msh", {.msh = {.is_2 = true, .is_text = true}}}};
    return all;
}

const Format& format_named(const std::string& name) {
    const auto format = std::ranges::find(formats(), name, &Format::name);
    if (format == formats().end()) throw std::out_of_range("there is no format named " + name);
    return *format;
}

Mesh rewritten(const Mesh& mesh, const Format& format) {
    const test::TemporaryFolder folder;
    const auto file = folder / ("mesh" + format.extension);
    (void)write_mesh(mesh, file, format.options);
    return read_mesh(file);
}

}  // namespace octetra::properties
