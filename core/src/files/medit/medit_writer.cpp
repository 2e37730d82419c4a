#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/sol_writer.hpp"
#include "files/output/output_file.hpp"
#include "files/output/text_row.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

/// Where the entities of a section come from, and their reference numbers, which are 0 where the
/// mesh has no markers.
template <std::size_t N>
struct EntitySection {
    std::string_view keyword;
    std::uint64_t count;
    std::span<const VertexNumbers<N>> (MeshSource::*vertices)(const Window&);
    bool has_markers;
    std::span<const Marker> (MeshSource::*markers)(const Window&);
};

void put_section_heading(OutputFile& out, const ProcessGroup& group, std::string_view keyword,
                         std::uint64_t count) {
    if (!group.is_first()) return;
    out.put(keyword);
    out.put('\n');
    put_line(out, count);
}

template <std::size_t N>
void write_section(OutputFile& out, MeshSource& mesh, const EntitySection<N>& section) {
    put_section_heading(out, mesh.group(), section.keyword, section.count);
    put_list(out, section.count, mesh.group(), [&](const Window& window, std::uint64_t) {
        const auto entities = (mesh.*section.vertices)(window);
        std::span<const Marker> markers;
        if (section.has_markers) markers = (mesh.*section.markers)(window);
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
    write_section<4>(
        out, mesh,
        {"Tetrahedra", facts.cells, &MeshSource::cells, facts.has_regions, &MeshSource::regions});
    if (facts.facets > 0) {
        write_section<3>(out, mesh,
                         {"Triangles", facts.facets, &MeshSource::facets, facts.has_facet_markers,
                          &MeshSource::facet_markers});
    }
    if (facts.edges > 0) {
        write_section<2>(out, mesh,
                         {"Edges", facts.edges, &MeshSource::edges, facts.has_edge_markers,
                          &MeshSource::edge_markers});
    }
    write_features(out, mesh);
    if (group.is_first()) out.put(std::string_view{"End\n"});
    commit_with_fields(std::move(file), mesh, path);
    return attributes_left_out(facts);
}

std::string attributes_left_out(const MeshFacts& facts) {
    if (facts.attributes_per_point == 0) return {};
    return fmt::format("Medit's format has no place for the {} attribute(s) of each vertex",
                       facts.attributes_per_point);
}

}  // namespace octetra
