#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/sol_writer.hpp"
#include "files/output/entity_list.hpp"
#include "files/output/output_file.hpp"
#include "files/output/text_row.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

void put_section_heading(OutputFile& out, const ProcessGroup& group, std::string_view keyword,
                         std::uint64_t count) {
    if (!group.is_first()) return;
    out.put(keyword);
    out.put('\n');
    put_line(out, count);
}

/// Reference numbers are 0 if the mesh has no markers.
template <std::size_t N>
void write_section(OutputFile& out, MeshSource& mesh, std::string_view keyword,
                   const EntityList<N>& list) {
    const ProcessGroup& group = mesh.group();
    put_section_heading(out, group, keyword, list.count);
    const auto bytes_of = [&](const Window& stretches) {
        const std::uint64_t bytes = bytes_of_vertices(mesh, list, stretches, 1);
        if (!list.has_markers) return bytes + 2 * stretches.length_of(group.rank());
        return bytes + bytes_of_markers(mesh, list, stretches,
                                        [](Marker marker) { return text_length(marker) + 1; });
    };
    put_list_in_ranges(out, list.count, group, bytes_of, [&](const Window& window, std::uint64_t) {
        const auto entities = (mesh.*list.vertices)(window);
        std::span<const Marker> markers;
        if (list.has_markers) markers = (mesh.*list.markers)(window);
        for (std::size_t i = 0; i < entities.size(); ++i) {
            TextRow row(out);
            for (const std::uint64_t vertex : entities[i]) row.put(vertex + 1);
            row.put(markers.empty() ? 0 : markers[i]);
            row.end();
        }
    });
}

void write_vertices(OutputFile& out, MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    put_section_heading(out, mesh.group(), "Vertices", facts.vertices);
    put_list(out, facts.vertices, mesh.group(), [&](const Window& window, std::uint64_t) {
        const std::span<const Point> points = mesh.points(window);
        std::span<const Marker> markers;
        if (facts.has_point_markers) markers = mesh.point_markers(window);
        for (std::size_t v = 0; v < points.size(); ++v) {
            put_line(out, points[v].x, points[v].y, points[v].z, markers.empty() ? 0 : markers[v]);
        }
    });
}

void write_features(OutputFile& out, MeshSource& mesh) {
    for (const Feature feature : all_features) {
        const std::uint64_t count = mesh.facts().features[feature];
        if (count == 0) continue;
        put_section_heading(out, mesh.group(), keyword_of(feature).keyword, count);
        put_list(out, count, mesh.group(), [&](const Window& window, std::uint64_t) {
            for (const std::uint64_t number : mesh.features(feature, window)) {
                put_line(out, number + 1);
            }
        });
    }
}

}  // namespace

std::string write_medit(MeshSource& mesh, const std::filesystem::path& path) {
    const MeshFacts& facts = mesh.facts();
    const ProcessGroup& group = mesh.group();
    auto file = std::make_unique<OutputFile>(path, group);
    OutputFile& out = *file;
    if (group.is_first()) out.put(std::string_view{"MeshVersionFormatted 2\nDimension 3\n"});
    write_vertices(out, mesh);
    write_section(out, mesh, "Tetrahedra", list_of_cells(facts));
    if (facts.facets > 0) write_section(out, mesh, "Triangles", list_of_facets(facts));
    if (facts.edges > 0) write_section(out, mesh, "Edges", list_of_edges(facts));
    write_features(out, mesh);
    if (group.is_first()) out.put(std::string_view{"End\n"});
    commit_with_fields(std::move(file), mesh, path);
    return attributes_left_out(facts);
}

std::string attributes_left_out(const MeshFacts& facts) {
    if (facts.attributes_per_point == 0) return {};
    return fmt::format("the Medit format cannot hold the {} attribute(s) of each vertex",
                       facts.attributes_per_point);
}

}  // namespace octetra
