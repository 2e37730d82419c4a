#include <memory>
#include <span>
#include <vector>

#include <octetra/core/files/output_paths.hpp>

#include "files/output/entity_list.hpp"
#include "files/output/output_file.hpp"
#include "files/output/places.hpp"
#include "files/output/text_row.hpp"
#include "files/output/text_slices.hpp"
#include "files/tetgen/tetgen.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// Collective. Writes a header line on the first process.
void put_header(OutputFile& out, const ProcessGroup& group, auto... numbers) {
    if (group.is_first()) put_line(out, numbers...);
}

void write_node(OutputFile& out, MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    const std::size_t attributes = facts.attributes_per_point;
    put_header(out, mesh.group(), facts.vertices, 3, attributes, facts.has_point_markers ? 1 : 0);
    put_list(out, facts.vertices, mesh.group(), [&](const Window& window, std::uint64_t number) {
        const std::span<const Point> points = mesh.points(window);
        std::span<const double> values;
        std::span<const Marker> markers;
        if (attributes > 0) values = mesh.point_attributes(window);
        if (facts.has_point_markers) markers = mesh.point_markers(window);
        for (std::size_t v = 0; v < points.size(); ++v, ++number) {
            const Point& p = points[v];
            TextRow row(out);
            row.put(facts.index_base + number);
            for (const double coordinate : {p.x, p.y, p.z}) row.put(coordinate);
            for (std::size_t k = 0; k < attributes; ++k) {
                row.reserve_more();
                row.put(values[v * attributes + k]);
            }
            if (!markers.empty()) row.put(markers[v]);
            row.end();
        }
    });
}

/// Writes the vertices and, if present, the markers of the entities of a list.
template <std::size_t N>
void write_list(OutputFile& out, MeshSource& mesh, const EntityList<N>& list) {
    const std::uint32_t index_base = mesh.facts().index_base;
    const ProcessGroup& group = mesh.group();
    const auto bytes_of = [&](const Window& stretches) {
        std::uint64_t bytes = bytes_of_row_numbers(stretches, group.rank(), index_base) +
                              bytes_of_vertices(mesh, list, stretches, index_base);
        if (list.has_markers) {
            bytes += bytes_of_markers(mesh, list, stretches,
                                      [](Marker marker) { return text_length(marker) + 1; });
        }
        return bytes;
    };
    put_list_in_ranges(out, list.count, group, bytes_of,
                       [&](const Window& window, std::uint64_t number) {
                           const auto entities = (mesh.*list.vertices)(window);
                           std::span<const Marker> markers;
                           if (list.has_markers) markers = (mesh.*list.markers)(window);
                           for (std::size_t i = 0; i < entities.size(); ++i, ++number) {
                               TextRow row(out);
                               row.put(index_base + number);
                               for (const std::uint64_t vertex : entities[i])
                                   row.put(index_base + vertex);
                               if (!markers.empty()) row.put(markers[i]);
                               row.end();
                           }
                       });
}

/// Removes lists of a previous mesh that would be read as lists of this one. Of a symbolic link,
/// only the link is removed: its target is another file's, or is removed under its own name.
void remove_stale_lists(const fs::path& path, const char* extension, bool was_written) {
    const fs::path written = fs::path(path).replace_extension(extension);
    for (const fs::path& list : lists_read_with(path, extension)) {
        if (!was_written || !refer_to_same_file(list, written)) fs::remove(list);
    }
}

}  // namespace

void write_tetgen(MeshSource& mesh, const fs::path& path) {
    const MeshFacts& facts = mesh.facts();
    const ProcessGroup& group = mesh.group();
    std::vector<std::unique_ptr<OutputFile>> files;
    const auto companion = [&](const char* extension) {
        return fs::path(path).replace_extension(extension);
    };
    const auto create = [&](const char* extension) -> OutputFile& {
        return *files.emplace_back(std::make_unique<OutputFile>(companion(extension), group));
    };

    write_node(create(".node"), mesh);
    OutputFile& ele = create(".ele");
    put_header(ele, group, facts.cells, 4, facts.has_regions ? 1 : 0);
    write_list(ele, mesh, list_of_cells(facts));

    if (facts.facets > 0) {
        OutputFile& face = create(".face");
        put_header(face, group, facts.facets, facts.has_facet_markers ? 1 : 0);
        write_list(face, mesh, list_of_facets(facts));
    }
    if (facts.edges > 0) {
        OutputFile& edge = create(".edge");
        put_header(edge, group, facts.edges, facts.has_edge_markers ? 1 : 0);
        write_list(edge, mesh, list_of_edges(facts));
    }

    OutputFile::commit_all(files, group, [&] {
        remove_stale_lists(path, ".face", facts.facets > 0);
        remove_stale_lists(path, ".edge", facts.edges > 0);
    });
}

}  // namespace octetra
