#include <fmt/format.h>

#include "files/medit.hpp"
#include "files/output_file.hpp"

namespace octetra {
namespace {

template <class I>
Marker marker_or_zero(const IndexVector<I, Marker>& markers, I i) {
    return markers.empty() ? 0 : markers[i];
}

template <class I, std::size_t N>
void write_section(OutputFile& out, std::string_view keyword,
                   const IndexVector<I, std::array<VertexIndex, N>>& list,
                   const IndexVector<I, Marker>& markers) {
    out.put(keyword);
    out.put('\n');
    out.put(list.size());
    out.put('\n');
    for (I i{0}; i < list.end_index(); ++i) {
        for (const VertexIndex vertex : list[i]) {
            out.put(std::uint64_t{vertex.value()} + 1);
            out.put(' ');
        }
        out.put(marker_or_zero(markers, i));
        out.put('\n');
    }
}

}  // namespace

std::string write_medit(const Mesh& mesh, const std::filesystem::path& path) {
    OutputFile out(path);
    out.put(std::string_view{"MeshVersionFormatted 2\nDimension 3\nVertices\n"});
    out.put(mesh.points.size());
    out.put('\n');
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        for (const double coordinate : {mesh.points[v].x, mesh.points[v].y, mesh.points[v].z}) {
            out.put(coordinate);
            out.put(' ');
        }
        out.put(marker_or_zero(mesh.point_markers, v));
        out.put('\n');
    }
    write_section(out, "Tetrahedra", mesh.cells, mesh.regions);
    if (!mesh.facets.empty()) write_section(out, "Triangles", mesh.facets, mesh.facet_markers);
    if (!mesh.edges.empty()) write_section(out, "Edges", mesh.edges, mesh.edge_markers);
    out.put(std::string_view{"End\n"});
    out.commit();

    if (mesh.attributes_per_point == 0) return {};
    return fmt::format("Medit's format has no place for the {} attribute(s) of each vertex",
                       mesh.attributes_per_point);
}

}  // namespace octetra
