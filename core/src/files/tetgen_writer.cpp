#include <memory>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/output_file.hpp"
#include "files/tetgen.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

void put_fields(OutputFile& out, auto... numbers) {
    const char* separator = "";
    ((out.put(std::string_view{separator}), out.put(numbers), separator = " "), ...);
}

void put_line(OutputFile& out, auto... numbers) {
    put_fields(out, numbers...);
    out.put('\n');
}

void write_node(OutputFile& out, const Mesh& mesh) {
    const std::size_t attributes = mesh.attributes_per_point;
    const bool markers = !mesh.point_markers.empty();
    put_line(out, mesh.points.size(), 3, attributes, markers ? 1 : 0);
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        const Point& p = mesh.points[v];
        put_fields(out, mesh.first_number + v.value(), p.x, p.y, p.z);
        for (std::size_t k = 0; k < attributes; ++k) {
            out.put(' ');
            out.put(mesh.point_attributes[v.value() * attributes + k]);
        }
        if (markers) {
            out.put(' ');
            out.put(mesh.point_markers[v]);
        }
        out.put('\n');
    }
}

/// Writes the entities of a list, their vertices and, where there are any, their markers.
template <class I, std::size_t N>
void write_entries(OutputFile& out, const IndexVector<I, std::array<VertexIndex, N>>& list,
                   const IndexVector<I, Marker>& markers, std::uint32_t first_number) {
    for (I i{0}; i < list.end_index(); ++i) {
        out.put(first_number + i.value());
        for (const VertexIndex vertex : list[i]) {
            out.put(' ');
            out.put(first_number + vertex.value());
        }
        if (!markers.empty()) {
            out.put(' ');
            out.put(markers[i]);
        }
        out.put('\n');
    }
}

/// To fail on what cannot be removed before anything has been put in place, not after it.
void refuse_directory(const fs::path& stale) {
    if (std::error_code ignored; fs::is_directory(stale, ignored)) {
        throw SystemError(fmt::format("{}: is a directory, not a file", stale.native()));
    }
}

}  // namespace

void write_tetgen(const Mesh& mesh, const fs::path& path) {
    std::vector<std::unique_ptr<OutputFile>> files;
    std::vector<fs::path> stale;
    const auto companion = [&](const char* extension) {
        return fs::path(path).replace_extension(extension);
    };
    const auto create = [&](const char* extension) -> OutputFile& {
        return *files.emplace_back(std::make_unique<OutputFile>(companion(extension)));
    };

    write_node(create(".node"), mesh);
    OutputFile& ele = create(".ele");
    put_line(ele, mesh.cells.size(), 4, mesh.regions.empty() ? 0 : 1);
    write_entries(ele, mesh.cells, mesh.regions, mesh.first_number);

    if (mesh.facets.empty()) {
        stale.push_back(companion(".face"));
    } else {
        OutputFile& face = create(".face");
        put_line(face, mesh.facets.size(), mesh.facet_markers.empty() ? 0 : 1);
        write_entries(face, mesh.facets, mesh.facet_markers, mesh.first_number);
    }
    if (mesh.edges.empty()) {
        stale.push_back(companion(".edge"));
    } else {
        OutputFile& edge = create(".edge");
        put_line(edge, mesh.edges.size(), mesh.edge_markers.empty() ? 0 : 1);
        write_entries(edge, mesh.edges, mesh.edge_markers, mesh.first_number);
    }

    for (const fs::path& file : stale) refuse_directory(file);
    for (const auto& file : files) file->close();
    for (const auto& file : files) file->commit();
    // Left from another mesh, these would be read as this one's.
    for (const fs::path& file : stale) fs::remove(file);
}

}  // namespace octetra
