#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/check_group_names.hpp>
#include <octetra/core/error.hpp>

#include "files/gmsh/element_types.hpp"
#include "files/gmsh/gmsh.hpp"
#include "files/gmsh/writing/marker_runs.hpp"
#include "files/gmsh/writing/number_output.hpp"
#include "files/gmsh/writing/points_box.hpp"
#include "files/output/entity_list.hpp"
#include "files/output/output_file.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

using namespace gmsh;

/// The elements of one kind: lines, triangles or tetrahedra.
template <std::size_t N>
struct ElementList : EntityList<N> {
    std::uint64_t type;
    MarkerRuns runs{};
    std::uint64_t first_tag = 1;
    Marker untagged = 0;  ///< the physical group of elements without a marker; 0: none

    [[nodiscard]] Marker group_of(Marker marker) const { return marker == 0 ? untagged : marker; }
    [[nodiscard]] std::int32_t dimension() const { return static_cast<std::int32_t>(N) - 1; }
    /// Returns the entity of a marker. Entities are numbered from 1, in the order of their markers.
    [[nodiscard]] std::int32_t entity_of(Marker marker) const {
        const auto place = std::ranges::lower_bound(runs.markers, marker) - runs.markers.begin();
        return static_cast<std::int32_t>(place) + 1;
    }
};

class GmshFile {
public:
    GmshFile(OutputFile& out, MeshSource& mesh, const MshFormat& format)
        : numbers_(out, format.is_text),
          out_(&out),
          mesh_(&mesh),
          facts_(mesh.facts()),
          group_(mesh.group()),
          is_2_(format.is_2) {
        find_runs(lines_);
        find_runs(triangles_);
        find_runs(tetrahedra_);
        triangles_.first_tag = 1 + lines_.count;
        tetrahedra_.first_tag = triangles_.first_tag + triangles_.count;
        find_untagged_groups();
        // Nodes need an entity even if there are no cells.
        if (tetrahedra_.runs.markers.empty()) tetrahedra_.runs.markers.push_back(0);
    }

    void write() {
        on_first([&] {
            put_format();
            put_group_names();
        });
        is_2_ ? write_2() : write_4();
    }

    /// Returns whether any element has a negative marker.
    [[nodiscard]] bool has_negative_markers() const {
        const auto has = [](const auto& list) {
            return !list.runs.markers.empty() && list.runs.markers.front() < 0;
        };
        return has(lines_) || has(triangles_) || has(tetrahedra_);
    }

private:
    /// Writes on the first process only: data that occurs once in the file.
    void on_first(auto&& put) {
        if (group_.is_first()) put();
    }
    void put_all(auto... numbers) { (numbers_.put(numbers), ...); }
    void put_row(auto... numbers) {
        put_all(numbers...);
        numbers_.end_row();
    }
    [[nodiscard]] std::uint64_t element_count() const {
        return lines_.count + triangles_.count + tetrahedra_.count;
    }

    template <std::size_t N>
    void find_runs(ElementList<N>& list) {
        std::function<std::span<const Marker>(const Window&)> markers;
        if (list.has_markers) {
            markers = [this, &list](const Window& window) {
                return (mesh_->*list.markers)(window);
            };
        }
        list.runs = find_marker_runs(list.count, group_, markers);
    }

    /// Gmsh saves only elements of physical groups if there are any; then every element needs a
    /// group.
    void find_untagged_groups() {
        names_ = facts_.group_names.list();
        const auto has_tagged = [](const auto& list) {
            return std::ranges::any_of(list.runs.markers,
                                       [](Marker marker) { return marker != 0; });
        };
        if (!has_tagged(lines_) && !has_tagged(triangles_) && !has_tagged(tetrahedra_)) return;
        find_untagged_group(lines_);
        find_untagged_group(triangles_);
        find_untagged_group(tetrahedra_);
    }
    /// Assigns to elements without a marker the lowest positive tag that is not in use in this
    /// dimension.
    template <std::size_t N>
    void find_untagged_group(ElementList<N>& list) {
        if (!std::ranges::binary_search(list.runs.markers, 0)) return;
        std::set<std::int64_t> taken;
        for (const Marker marker : list.runs.markers) taken.insert(std::abs(std::int64_t{marker}));
        for (const GroupName& group : facts_.group_names.list()) {
            if (group.dimension == list.dimension())
                taken.insert(std::abs(std::int64_t{group.tag}));
        }
        list.untagged = 1;
        while (taken.contains(list.untagged)) ++list.untagged;
        names_.push_back({list.dimension(), list.untagged, std::string(untagged_group_name)});
    }

    void put_format() {
        numbers_.put_text(fmt::format("$MeshFormat\n{} {} 8\n", is_2_ ? "2.2" : "4.1",
                                      numbers_.is_text() ? 0 : 1));
        if (numbers_.is_text()) return numbers_.put_text("$EndMeshFormat\n");
        put_row(std::int32_t{1});
        numbers_.end_section("MeshFormat");
    }

    void put_group_names() {
        if (names_.empty()) return;
        numbers_.put_text(fmt::format("$PhysicalNames\n{}\n", names_.size()));
        for (const GroupName& group : names_) {
            numbers_.put_text(
                fmt::format("{} {} \"{}\"\n", group.dimension, group.tag, group.name));
        }
        numbers_.put_text("$EndPhysicalNames\n");
    }

    // Version 4.1

    void write_4() {
        const PointsBox box = box_of_points(*mesh_);
        on_first([&] {
            numbers_.put_text("$Entities\n");
            put_row(std::uint64_t{0}, std::uint64_t{lines_.runs.markers.size()},
                    std::uint64_t{triangles_.runs.markers.size()},
                    std::uint64_t{tetrahedra_.runs.markers.size()});
            put_entities(lines_, box);
            put_entities(triangles_, box);
            put_entities(tetrahedra_, box);
            numbers_.end_section("Entities");
        });
        write_nodes_4();
        on_first([&] {
            numbers_.put_text("$Elements\n");
            put_row(lines_.runs.count + triangles_.runs.count + tetrahedra_.runs.count,
                    element_count(), std::uint64_t{element_count() > 0}, element_count());
        });
        write_elements_4(lines_);
        write_elements_4(triangles_);
        write_elements_4(tetrahedra_);
        on_first([&] { numbers_.end_section("Elements"); });
    }

    /// Writes one entity for each marker, all with the bounding box of the whole mesh.
    template <std::size_t N>
    void put_entities(const ElementList<N>& list, const PointsBox& box) {
        for (const Marker marker : list.runs.markers) {
            put_all(list.entity_of(marker), box.low.x, box.low.y, box.low.z, box.high.x, box.high.y,
                    box.high.z);
            const Marker group = list.group_of(marker);
            put_all(std::uint64_t{group != 0});
            if (group != 0) numbers_.put(group);
            put_row(std::uint64_t{0});  // entities on its boundary
        }
    }

    void write_nodes_4() {
        const std::uint64_t count = facts_.vertices;
        const std::uint64_t is_any = count > 0 ? 1 : 0;
        on_first([&] {
            numbers_.put_text("$Nodes\n");
            put_row(is_any, count, is_any, count);
            if (count > 0) put_row(std::int32_t{3}, std::int32_t{1}, std::int32_t{0}, count);
        });
        const auto bytes_of_tags = [&](const Window& stretches) {
            return numbers_.is_text() ? bytes_of_row_numbers(stretches, group_.rank(), 1)
                                      : stretches.length_of(group_.rank()) * sizeof count;
        };
        put_list_in_ranges(*out_, count, group_, bytes_of_tags,
                           [&](const Window& window, std::uint64_t first) {
                               const std::uint64_t end = window.end_of(group_.rank());
                               for (std::uint64_t v = first; v < end; ++v) put_row(v + 1);
                           });
        put_nodes(sizeof(Point), [&](const Point& p, std::uint64_t) {
            numbers_.put_row(std::array{p.x, p.y, p.z});
        });
        on_first([&] { numbers_.end_section("Nodes"); });
    }

    template <std::size_t N>
    void write_elements_4(const ElementList<N>& list) {
        const auto bytes_of = [&](const Window& stretches) {
            std::uint64_t bytes = 0;
            for (const MarkerRun& run : list.runs.here) bytes += bytes_of_head(list, run);
            if (numbers_.is_text()) {
                return bytes + bytes_of_row_numbers(stretches, group_.rank(), list.first_tag) +
                       bytes_of_vertices(*mesh_, list, stretches, 1);
            }
            return bytes + stretches.length_of(group_.rank()) * (1 + N) * sizeof(std::uint64_t);
        };
        auto next = list.runs.here.begin();
        const auto put_slice = [&](const Window& window, std::uint64_t number) {
            for (const VertexNumbers<N>& vertices : (mesh_->*list.vertices)(window)) {
                if (next != list.runs.here.end() && next->first == number) {
                    put_row(list.dimension(), list.entity_of(next->marker),
                            static_cast<std::int32_t>(list.type), next->length);
                    ++next;
                }
                std::array<std::uint64_t, 1 + N> row{list.first_tag + number++};
                for (std::size_t k = 0; k < N; ++k) row[1 + k] = vertices[k] + 1;
                numbers_.put_row(row);
            }
        };
        put_list_in_ranges(*out_, list.count, group_, bytes_of, put_slice);
    }

    /// Returns the size of the block header that precedes the elements of a run.
    template <std::size_t N>
    [[nodiscard]] std::uint64_t bytes_of_head(const ElementList<N>& list,
                                              const MarkerRun& run) const {
        if (!numbers_.is_text()) return 3 * sizeof(std::int32_t) + sizeof run.length;
        return 4 + text_length(list.dimension()) + text_length(list.entity_of(run.marker)) +
               text_length(list.type) + text_length(run.length);
    }
    /// Calls put(point, number) for the points of this process, each of which takes `row_size`
    /// bytes in a binary file.
    void put_nodes(std::size_t row_size, auto&& put) {
        const auto put_slice = [&](const Window& window, std::uint64_t number) {
            for (const Point& p : mesh_->points(window)) put(p, number++);
        };
        if (numbers_.is_text()) return put_list(*out_, facts_.vertices, group_, put_slice);
        put_list_of_rows(*out_, facts_.vertices, group_, row_size, put_slice);
    }

    // Version 2.2

    void write_2() {
        on_first([&] { numbers_.put_text(fmt::format("$Nodes\n{}\n", facts_.vertices)); });
        put_nodes(node_bytes_2, [&](const Point& p, std::uint64_t number) {
            put_number_2(number + 1);
            put_row(p.x, p.y, p.z);
        });
        on_first([&] {
            numbers_.end_section("Nodes");
            numbers_.put_text(fmt::format("$Elements\n{}\n", element_count()));
        });
        write_elements_2(lines_);
        write_elements_2(triangles_);
        write_elements_2(tetrahedra_);
        on_first([&] { numbers_.end_section("Elements"); });
    }

    /// Writes a number, which has 32 bits in binary files of version 2.
    void put_number_2(std::uint64_t number) {
        numbers_.is_text() ? numbers_.put(number) : numbers_.put(static_cast<std::int32_t>(number));
    }

    template <std::size_t N>
    void write_elements_2(const ElementList<N>& list) {
        const auto type = static_cast<std::int32_t>(list.type);
        constexpr std::int32_t tags = 2;  // the physical group and the entity
        on_first([&] {
            if (numbers_.is_text() || list.count == 0) return;
            put_row(type, static_cast<std::int32_t>(list.count), tags);
        });
        const auto bytes_of = [&](const Window& stretches) {
            const std::uint64_t rows = stretches.length_of(group_.rank());
            if (!numbers_.is_text()) return rows * (1 + std::size_t{tags} + N) * sizeof(type);
            const auto bytes_of_tags = [&](Marker marker) {
                return text_length(list.group_of(marker)) + text_length(list.entity_of(marker)) + 2;
            };
            return bytes_of_row_numbers(stretches, group_.rank(), list.first_tag) +
                   rows * (text_length(type) + text_length(tags) + 2) +
                   (list.has_markers ? bytes_of_markers(*mesh_, list, stretches, bytes_of_tags)
                                     : rows * bytes_of_tags(0)) +
                   bytes_of_vertices(*mesh_, list, stretches, 1);
        };
        const auto put_slice = [&](const Window& window, std::uint64_t number) {
            const auto elements = (mesh_->*list.vertices)(window);
            std::span<const Marker> markers;
            if (list.has_markers) markers = (mesh_->*list.markers)(window);
            for (std::size_t i = 0; i < elements.size(); ++i) {
                const Marker marker = markers.empty() ? 0 : markers[i];
                put_number_2(list.first_tag + number++);
                if (numbers_.is_text()) put_all(type, tags);
                put_all(list.group_of(marker), list.entity_of(marker));
                for (const std::uint64_t vertex : elements[i]) put_number_2(vertex + 1);
                numbers_.end_row();
            }
        };
        put_list_in_ranges(*out_, list.count, group_, bytes_of, put_slice);
    }

    NumberOutput numbers_;
    OutputFile* out_;
    MeshSource* mesh_;
    const MeshFacts& facts_;
    const ProcessGroup& group_;
    bool is_2_;
    std::vector<GroupName> names_;
    ElementList<2> lines_{list_of_edges(facts_), line_type};
    ElementList<3> triangles_{list_of_facets(facts_), triangle_type};
    ElementList<4> tetrahedra_{list_of_cells(facts_), tetrahedron_type};
};

/// Throws InputError if a number does not fit into the 32 bits of binary files of version 2.
void check_entity_counts(const MeshFacts& facts, const std::filesystem::path& path) {
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    if (facts.vertices <= most && facts.cells + facts.facets + facts.edges <= most) return;
    throw InputError(
        fmt::format("{}: binary files of version 2.2 number at most {} nodes and elements; write "
                    "version 4.1",
                    path.native(), most));
}

std::string unsupported_data(const MeshFacts& facts, bool has_negative_markers) {
    std::string lost;
    const auto add = [&](std::string_view what) {
        lost += lost.empty() ? "" : "; ";
        lost += what;
    };
    if (facts.attributes_per_point > 0) {
        add(fmt::format("the Gmsh format cannot hold the {} attribute(s) of each vertex",
                        facts.attributes_per_point));
    }
    if (facts.has_point_markers) add("the markers of vertices are not written to .msh files");
    if (has_negative_markers) {
        add("Gmsh reads a negative marker as the group of its absolute value, reversed");
    }
    return lost;
}

}  // namespace

std::string write_gmsh(MeshSource& mesh, const std::filesystem::path& path,
                       const MshFormat& format) {
    if (format.is_2 && !format.is_text) check_entity_counts(mesh.facts(), path);
    OutputFile out(path, mesh.group());
    GmshFile file(out, mesh, format);
    file.write();
    out.commit();
    return unsupported_data(mesh.facts(), file.has_negative_markers());
}

}  // namespace octetra
