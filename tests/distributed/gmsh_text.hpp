#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>

/// Gmsh files in forms that other programs may write.
namespace octetra::test {

/// Variations of a file that write_mesh() does not produce.
struct GmshForm {
    MshFormat format;
    std::function<std::uint64_t(std::uint64_t)> tag_of = [](std::uint64_t v) { return v + 1; };
    std::size_t block = 1000;    ///< most rows in a block, in version 4.1 and binary version 2
    bool is_parametric = false;  ///< version 4.1
    std::size_t groups = 1;      ///< version 2: groups of an element, which is listed for each
    bool has_points = false;     ///< elements of a kind that is discarded
};

/// Writes numbers as text or in binary.
class GmshText {
public:
    GmshText(const Mesh& mesh, GmshForm form) : mesh_(&mesh), form_(std::move(form)) {
        const bool is_2 = form_.format.is_2;
        text_ = fmt::format("$MeshFormat\n{} {} 8\n", is_2 ? "2.2" : "4.1", is_text() ? 0 : 1);
        if (!is_text()) row(std::int32_t{1});
        end("MeshFormat");
        is_2 ? write_2() : write_4();
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    [[nodiscard]] bool is_text() const { return form_.format.is_text; }
    [[nodiscard]] std::uint64_t node_count() const { return mesh_->points.size(); }
    [[nodiscard]] std::uint64_t element_count() const {
        return mesh_->edges.size() + mesh_->facets.size() + mesh_->cells.size() +
               (form_.has_points ? node_count() : 0);
    }
    template <class T>
    void put(T number) {
        if (is_text()) {
            text_ += fmt::format("{} ", number);
        } else {
            const std::size_t at = text_.size();
            text_.resize(at + sizeof number);
            std::memcpy(text_.data() + at, &number, sizeof number);
        }
    }
    void end_row() {
        if (is_text()) text_.back() = '\n';
    }
    void row(auto... numbers) {
        (put(numbers), ...);
        end_row();
    }
    void end(const std::string& name) {
        text_ += fmt::format("{}$End{}\n", is_text() ? "" : "\n", name);
    }

    void write_2() {
        text_ += fmt::format("$Nodes\n{}\n", node_count());
        for (std::size_t v = 0; v < node_count(); ++v) {
            put(static_cast<std::int32_t>(form_.tag_of(v)));
            put_point(v);
            end_row();
        }
        end("Nodes");
        text_ += fmt::format("$Elements\n{}\n", element_count() * form_.groups);
        elements();
        end("Elements");
    }
    void put_point(std::size_t v) {
        const Point& p = mesh_->points[VertexIndex{v}];
        put(p.x);
        put(p.y);
        put(p.z);
    }

    void write_4() {
        put_entities();
        const std::uint64_t block = std::min<std::uint64_t>(form_.block, node_count());
        text_ += "$Nodes\n";
        const std::uint64_t blocks = node_count() == 0 ? 0 : (node_count() - 1) / block + 1;
        row(blocks, node_count(), std::uint64_t{1}, std::uint64_t{node_count()});
        for (std::size_t begin = 0; begin < node_count(); begin += block) {
            const std::size_t end_of = std::min<std::size_t>(begin + block, node_count());
            row(std::int32_t{2}, std::int32_t{1}, std::int32_t{form_.is_parametric},
                std::uint64_t{end_of - begin});
            for (std::size_t v = begin; v < end_of; ++v) row(form_.tag_of(v));
            for (std::size_t v = begin; v < end_of; ++v) {
                put_point(v);
                for (int k = 0; k < (form_.is_parametric ? 2 : 0); ++k) put(0.25);
                end_row();
            }
        }
        end("Nodes");
        const std::string before = std::exchange(text_, {});
        elements();
        const std::string rows = std::exchange(text_, before + "$Elements\n");
        row(blocks_, element_count(), std::uint64_t{1}, element_count());
        text_ += rows;
        end("Elements");
    }
    void put_entities() {
        const auto tags = [](const auto& markers) {
            return std::set<Marker>(markers.begin(), markers.end());
        };
        const std::set<Marker> of_kind[] = {
            {}, tags(mesh_->edge_markers), tags(mesh_->facet_markers), tags(mesh_->regions)};
        text_ += "$Entities\n";
        row(std::uint64_t{0}, of_kind[1].size(), of_kind[2].size(), of_kind[3].size());
        for (const auto& markers : of_kind) {
            for (const Marker marker : markers) {
                put(marker + 100);
                for (int k = 0; k < 6; ++k) put(0.5);
                put(std::uint64_t{marker != 0});
                if (marker != 0) put(marker);
                row(std::uint64_t{0});
            }
        }
        end("Entities");
    }

    void elements() {
        if (form_.has_points) {
            list(
                15, 0, node_count(), [](std::size_t) { return Marker{0}; },
                [](std::size_t v) { return std::array{VertexIndex{v}}; });
        }
        const auto of = [&](std::int32_t type, std::int32_t dimension, const auto& list_of,
                            const auto& markers) {
            list(
                type, dimension, list_of.size(),
                [&](std::size_t i) {
                    return markers.empty() ? 0
                                           : *(markers.begin() + static_cast<std::ptrdiff_t>(i));
                },
                [&](std::size_t i) { return *(list_of.begin() + static_cast<std::ptrdiff_t>(i)); });
        };
        of(1, 1, mesh_->edges, mesh_->edge_markers);
        of(2, 2, mesh_->facets, mesh_->facet_markers);
        of(4, 3, mesh_->cells, mesh_->regions);
    }
    /// A block contains elements of one marker.
    void list(std::int32_t type, std::int32_t dimension, std::size_t count, auto&& marker_of,
              auto&& vertices_of) {
        for (std::size_t begin = 0; begin < count;) {
            std::size_t stop = begin + 1;
            const Marker marker = marker_of(begin);
            while (stop < std::min(count, begin + form_.block) && marker_of(stop) == marker) ++stop;
            ++blocks_;
            const auto rows = static_cast<std::uint64_t>(stop - begin);
            if (!form_.format.is_2) {
                row(dimension, marker + 100, type, rows);
            } else if (!is_text()) {
                row(type, static_cast<std::int32_t>(rows * form_.groups), std::int32_t{2});
            }
            for (; begin < stop; ++begin) {
                for (std::size_t group = 0; group < form_.groups; ++group) {
                    put_head(type, marker, group);
                    for (const VertexIndex v : vertices_of(begin)) put_tag(form_.tag_of(v.value()));
                    end_row();
                }
            }
        }
    }
    void put_head(std::int32_t type, Marker marker, std::size_t group) {
        put_tag(++number_);
        if (!form_.format.is_2) return;
        if (is_text()) {
            put(type);
            put(2);
        }
        put(marker + 50 * static_cast<std::int32_t>(group));
        put(std::int32_t{1});
    }
    void put_tag(std::uint64_t tag) {
        form_.format.is_2 ? put(static_cast<std::int32_t>(tag)) : put(tag);
    }

    const Mesh* mesh_;
    GmshForm form_;
    std::string text_;
    std::uint64_t blocks_ = 0;
    std::uint64_t number_ = 0;
};

}  // namespace octetra::test
