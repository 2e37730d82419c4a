#include <algorithm>
#include <array>

#include <octetra/core/files/mesh_files.hpp>

#include "properties/draw.hpp"
#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::properties {
namespace {

using Path = std::filesystem::path;

/// The contents of all files of a mesh.
std::string bytes_of(const Path& mesh) {
    std::string bytes;
    for (const char* extension : {".mesh", ".node", ".ele", ".face", ".edge"}) {
        Path file = mesh;
        file.replace_extension(extension);
        if (std::filesystem::exists(file)) bytes += extension + test::content_of(file);
    }
    return bytes;
}

void drop_if_all_zero(auto& markers) {
    if (std::ranges::all_of(markers, [](Marker marker) { return marker == 0; })) markers.clear();
}

/// Adapts the mesh to Medit, which has no attributes and reads markers that are all 0 as absent.
/// Midpoints have no markers if vertices have none, and an unmarked tagged edge leaves its midpoint
/// the marker of a facet.
void fit_medit(Mesh& mesh) {
    mesh.attributes_per_point = 0;
    mesh.point_attributes.clear();
    drop_if_all_zero(mesh.point_markers);
    drop_if_all_zero(mesh.facet_markers);
    drop_if_all_zero(mesh.edge_markers);
}

/// Replaces marks by number, because the intermediate file numbers cells differently.
void mark_by_position(Selection& selection) {
    if (selection.cells.empty()) return;
    selection.cells.clear();
    if (!selection.random) selection.random = RandomShare{0.3, 1};
}

}  // namespace

std::string fault_of_files(const Case& drawn) {
    Draw draw(drawn.seed);
    const std::string extension = draw.chance(0.5) ? ".mesh" : ".ele";
    Case c = drawn;
    // A file has no history, so each level would begin with its own regular cells.
    if (c.closure == Closure::regular) c.levels = 1;
    mark_by_position(c.selection);
    if (extension == ".mesh") fit_medit(c.mesh);

    const test::TemporaryFolder folder;
    const Outcome expected = refined_by_reference(c);
    std::string error;
    Case step = c;
    step.levels = 1;
    for (int level = 1; level <= c.levels && error.empty(); ++level) {
        const Path file = folder / ("level" + std::to_string(level) + extension);
        error = write_refined_by_all(step, file);
        if (!error.empty()) break;
        step.mesh = read_mesh(file);
        step.cell_to_rank.resize(step.mesh.cells.size());
        for (int& rank : step.cell_to_rank) rank = draw.between(0, 7);
    }
    if (error.empty() != expected.error.empty()) {
        return "refused as '" + error + "', by the reference as '" + expected.error + "'";
    }
    if (!error.empty()) return {};
    (void)write_mesh(expected.mesh, folder / ("expected" + extension));
    const std::string last = "level" + std::to_string(c.levels) + extension;
    if (bytes_of(folder / last) != bytes_of(folder / ("expected" + extension))) {
        return "through " + extension + " files the last one has other bytes";
    }
    return {};
}

}  // namespace octetra::properties
