#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "files/medit/medit.hpp"
#include "files/medit/meshb_layout.hpp"
#include "files/output/output_file.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

static_assert(std::endian::native == std::endian::little,
              "what is written is little-endian; another machine has to swap bytes");

constexpr std::uint64_t most_in_32_bits = std::numeric_limits<std::int32_t>::max();

/// The endianness, the version, and the section Dimension.
std::uint64_t head_size(const MeshbFormat& format) {
    return 4 + 4 + 4 + format.position_size() + 4;
}

std::uint64_t file_size(const MeshFacts& facts, const MeshbFormat& format) {
    const std::uint64_t heads = 2U + (facts.facets > 0 ? 1U : 0U) + (facts.edges > 0 ? 1U : 0U);
    return head_size(format) + heads * format.head_size() + facts.vertices * format.point_size() +
           facts.cells * format.entity_size(4) + facts.facets * format.entity_size(3) +
           facts.edges * format.entity_size(2) + 4 + format.position_size();
}

template <class Integer>
class MeshbWriter {
public:
    MeshbWriter(OutputFile& out, MeshSource& mesh, std::int32_t version)
        : out_(&out), mesh_(&mesh), format_{version} {}

    void write() {
        const MeshFacts& facts = mesh_->facts();
        const auto put_first = [&](auto... numbers) {
            if (mesh_->group().is_first()) (put(numbers), ...);
        };
        put_first(std::int32_t{1}, format_.version, meshb_code::dimension);
        put_position(head_size(format_));
        put_first(std::int32_t{3});
        written_ = head_size(format_);
        write_vertices();
        write_list<4>(meshb_code::tetrahedra, facts.cells, &MeshSource::cells, facts.has_regions,
                      &MeshSource::regions);
        if (facts.facets > 0) {
            write_list<3>(meshb_code::triangles, facts.facets, &MeshSource::facets,
                          facts.has_facet_markers, &MeshSource::facet_markers);
        }
        if (facts.edges > 0) {
            write_list<2>(meshb_code::edges, facts.edges, &MeshSource::edges,
                          facts.has_edge_markers, &MeshSource::edge_markers);
        }
        put_first(meshb_code::end);
        put_position(0);
    }

private:
    void put(auto number) { out_->put_bytes(&number, sizeof number); }

    void put_position(std::uint64_t position) {
        if (!mesh_->group().is_first()) return;
        if (format_.position_size() == 4) return put(static_cast<std::int32_t>(position));
        put(static_cast<std::int64_t>(position));
    }

    /// Where the next section begins follows from the count.
    void put_head(std::int32_t code, std::uint64_t count, std::size_t row_size) {
        written_ += format_.head_size() + count * row_size;
        if (mesh_->group().is_first()) put(code);
        put_position(written_);
        if (mesh_->group().is_first()) put(static_cast<Integer>(count));
    }

    void write_vertices() {
        const MeshFacts& facts = mesh_->facts();
        constexpr std::size_t row_size = sizeof(Point) + sizeof(Integer);
        put_head(meshb_code::vertices, facts.vertices, row_size);
        put_list(*out_, facts.vertices, mesh_->group(), [&](const Window& window, std::uint64_t) {
            const std::span<const Point> points = mesh_->points(window);
            std::span<const Marker> markers;
            if (facts.has_point_markers) markers = mesh_->point_markers(window);
            rows_.resize(points.size() * row_size);
            char* place = rows_.data();
            for (std::size_t v = 0; v < points.size(); ++v) {
                std::memcpy(place, &points[v], sizeof(Point));
                const auto reference = static_cast<Integer>(markers.empty() ? 0 : markers[v]);
                std::memcpy(place + sizeof(Point), &reference, sizeof reference);
                place += row_size;
            }
            out_->put_bytes(rows_.data(), rows_.size());
        });
    }

    template <std::size_t N>
    void write_list(std::int32_t code, std::uint64_t count,
                    std::span<const VertexNumbers<N>> (MeshSource::*vertices)(const Window&),
                    bool has_markers,
                    std::span<const Marker> (MeshSource::*markers_of)(const Window&)) {
        using Row = std::array<Integer, N + 1>;
        put_head(code, count, sizeof(Row));
        put_list(*out_, count, mesh_->group(), [&](const Window& window, std::uint64_t) {
            const auto entities = (mesh_->*vertices)(window);
            std::span<const Marker> markers;
            if (has_markers) markers = (mesh_->*markers_of)(window);
            rows_.resize(entities.size() * sizeof(Row));
            char* place = rows_.data();
            for (std::size_t i = 0; i < entities.size(); ++i) {
                Row row;
                for (std::size_t k = 0; k < N; ++k)
                    row[k] = static_cast<Integer>(entities[i][k] + 1);
                row[N] = static_cast<Integer>(markers.empty() ? 0 : markers[i]);
                std::memcpy(place, row.data(), sizeof row);
                place += sizeof row;
            }
            out_->put_bytes(rows_.data(), rows_.size());
        });
    }

    OutputFile* out_;
    MeshSource* mesh_;
    MeshbFormat format_;
    std::uint64_t written_ = 0;  ///< where the next section begins
    std::vector<char> rows_;
};

}  // namespace

std::int32_t meshb_version(const MeshFacts& facts) {
    const std::uint64_t most = std::max({facts.vertices, facts.cells, facts.facets, facts.edges});
    if (most > most_in_32_bits) return 4;
    return file_size(facts, {.version = 2}) > most_in_32_bits ? 3 : 2;
}

std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path) {
    return write_meshb(mesh, path, meshb_version(mesh.facts()));
}

std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path, std::int32_t version) {
    OutputFile out(path, mesh.group());
    if (version == 4) {
        MeshbWriter<std::int64_t>(out, mesh, version).write();
    } else {
        MeshbWriter<std::int32_t>(out, mesh, version).write();
    }
    out.commit();
    return attributes_left_out(mesh.facts());
}

}  // namespace octetra
