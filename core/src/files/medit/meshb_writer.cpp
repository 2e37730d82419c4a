#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "files/medit/keywords.hpp"
#include "files/medit/medit.hpp"
#include "files/medit/meshb_heads.hpp"
#include "files/medit/sol_writer.hpp"
#include "files/output/entity_list.hpp"
#include "files/output/output_file.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

std::uint64_t file_size(const MeshFacts& facts, const MeshbFormat& format) {
    std::uint64_t heads = 2U + (facts.facets > 0 ? 1U : 0U) + (facts.edges > 0 ? 1U : 0U);
    std::uint64_t featured = 0;
    for (const std::uint64_t count : facts.features) {
        heads += count > 0 ? 1U : 0U;
        featured += count;
    }
    return MeshbHeads::start_size(format) + heads * format.head_size() +
           facts.vertices * format.point_size() + facts.cells * format.entity_size(4) +
           facts.facets * format.entity_size(3) + facts.edges * format.entity_size(2) +
           featured * format.integer_size() + 4 + format.position_size();
}

template <class Integer>
class MeshbWriter {
public:
    MeshbWriter(OutputFile& out, MeshSource& mesh, std::int32_t version)
        : out_(&out), mesh_(&mesh), heads_(mesh, out, version) {}

    void write() {
        const MeshFacts& facts = mesh_->facts();
        heads_.put_start();
        write_vertices();
        write_list(meshb_code::tetrahedra, list_of_cells(facts));
        if (facts.facets > 0) write_list(meshb_code::triangles, list_of_facets(facts));
        if (facts.edges > 0) write_list(meshb_code::edges, list_of_edges(facts));
        for (const Feature feature : all_features) {
            if (facts.features[feature] > 0) write_feature(feature, facts.features[feature]);
        }
        heads_.put_end();
    }

private:
    void write_vertices() {
        const MeshFacts& facts = mesh_->facts();
        constexpr std::size_t row_size = sizeof(Point) + sizeof(Integer);
        heads_.put_section(meshb_code::vertices, facts.vertices, facts.vertices * row_size);
        put_list_of_rows(*out_, facts.vertices, mesh_->group(), row_size,
                         [&](const Window& window, std::uint64_t) {
                             const std::span<const Point> points = mesh_->points(window);
                             std::span<const Marker> markers;
                             if (facts.has_point_markers) markers = mesh_->point_markers(window);
                             rows_.resize(points.size() * row_size);
                             char* place = rows_.data();
                             for (std::size_t v = 0; v < points.size(); ++v) {
                                 std::memcpy(place, &points[v], sizeof(Point));
                                 const auto reference =
                                     static_cast<Integer>(markers.empty() ? 0 : markers[v]);
                                 std::memcpy(place + sizeof(Point), &reference, sizeof reference);
                                 place += row_size;
                             }
                             out_->put_bytes(rows_.data(), rows_.size());
                         });
    }

    template <std::size_t N>
    void write_list(std::int32_t code, const EntityList<N>& list) {
        using Row = std::array<Integer, N + 1>;
        heads_.put_section(code, list.count, list.count * sizeof(Row));
        put_list_of_rows(*out_, list.count, mesh_->group(), sizeof(Row),
                         [&](const Window& window, std::uint64_t) {
                             const auto entities = (mesh_->*list.vertices)(window);
                             std::span<const Marker> markers;
                             if (list.has_markers) markers = (mesh_->*list.markers)(window);
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

    void write_feature(Feature feature, std::uint64_t count) {
        heads_.put_section(keyword_of(feature).code, count, count * sizeof(Integer));
        std::vector<Integer> numbers;
        put_list_of_rows(*out_, count, mesh_->group(), sizeof(Integer),
                         [&](const Window& window, std::uint64_t) {
                             numbers.clear();
                             for (const std::uint64_t number : mesh_->features(feature, window)) {
                                 numbers.push_back(static_cast<Integer>(number + 1));
                             }
                             out_->put_bytes(numbers.data(), numbers.size() * sizeof(Integer));
                         });
    }

    OutputFile* out_;
    MeshSource* mesh_;
    MeshbHeads heads_;
    std::vector<char> rows_;
};

}  // namespace

std::int32_t meshb_version(const MeshFacts& facts) {
    const std::uint64_t most = std::max({facts.vertices, facts.cells, facts.facets, facts.edges});
    return lowest_meshb_version(most, file_size(facts, {.version = 2}));
}

std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path) {
    return write_meshb(mesh, path, meshb_version(mesh.facts()));
}

std::string write_meshb(MeshSource& mesh, const std::filesystem::path& path, std::int32_t version) {
    auto out = std::make_unique<OutputFile>(path, mesh.group());
    if (version == 4) {
        MeshbWriter<std::int64_t>(*out, mesh, version).write();
    } else {
        MeshbWriter<std::int32_t>(*out, mesh, version).write();
    }
    commit_with_fields(std::move(out), mesh, path);
    return attributes_left_out(mesh.facts());
}

}  // namespace octetra
