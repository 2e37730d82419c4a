#include "info/print_statistics.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "grouped.hpp"
#include "info/name_of_group.hpp"
#include "info/table.hpp"
#include "terminal.hpp"

namespace octetra::cli {
namespace {

/// The maximum number of regions or markers shown; a mesh may have one per cell.
constexpr std::size_t shown_tags = 20;

void add_counts(Table& table, const quality::EntityCounts& counts) {
    table.heading("Counts");
    table.row("vertices", shown(counts.vertices));
    table.row("edges", shown(counts.edges));
    table.row("faces", shown(counts.faces));
    table.row("cells", shown(counts.cells));
    table.row("boundary faces", shown(counts.boundary_faces));
    table.row("tagged facets", shown(counts.tagged_facets));
    table.row("tagged edges", shown(counts.tagged_edges));
    table.row("unused vertices", shown(counts.unused_vertices));
    table.row("faces of more than two cells", shown(counts.nonmanifold_faces));
    table.row("connected components", shown(counts.components));
    table.row("Euler characteristic", fmt::format("{}", counts.euler_characteristic));
}

/// Appends the features of Medit files; nothing if there are none.
void add_features(Table& table, const FeatureCounts& counts) {
    if (!has_any(counts)) return;
    table.heading("Features", "count");
    for (const Feature feature : all_features) {
        if (counts[feature] > 0) table.row(name_of(feature), shown(counts[feature]));
    }
}

void add_extent(Table& table, const quality::MeshStatistics& s) {
    table.heading("Extent, in the mesh's units", "minimum", "maximum", "size");
    const auto row = [&](const char* name, double low, double high) {
        table.row(name, shown(low), shown(high), shown(high - low));
    };
    if (s.bounding_box) {
        const auto& [low, high] = *s.bounding_box;
        row("x", low.x, high.x);
        row("y", low.y, high.y);
        row("z", low.z, high.z);
    } else {
        table.row("bounding box", "none", "none", "none");
    }
    table.row("total volume", "", "", shown(s.volume));
    table.row("boundary area", "", "", shown(s.boundary_area));
}

void add_shapes(Table& table, const quality::MeshStatistics& s) {
    table.heading("Shape", "minimum", "maximum", "mean");
    const auto row = [&](const char* name, const std::optional<quality::Range>& range) {
        if (range) {
            table.row(name, shown(range->min), shown(range->max));
        } else {
            table.row(name, "none", "none");
        }
    };
    row("edge length", s.edge_length);
    row("cell volume", s.cell_volume);
    row("face angle, degrees", s.face_angle);
    row("dihedral angle, degrees", s.dihedral_angle);
    if (s.eta) {
        table.row("eta (regular: 1)", shown(s.eta->min), shown(s.eta->max), shown(s.eta->mean));
    } else {
        table.row("eta (regular: 1)", "none", "none", "none");
    }
}

void add_adjacency(Table& table, const std::optional<quality::Adjacency>& adjacency) {
    table.heading("Adjacency", "mean", "maximum");
    if (!adjacency) {
        table.row("none");
        return;
    }
    table.row("cells at an edge", shown(adjacency->cells_per_edge),
              shown(adjacency->max_cells_at_edge));
    table.row("cells at a vertex", shown(adjacency->cells_per_vertex),
              shown(adjacency->max_cells_at_vertex));
    table.row("edges at a vertex", shown(adjacency->edges_per_vertex));
    table.row("faces at an edge", shown(adjacency->faces_per_edge));
}

/// Returns the tag, followed by as much of its group's name as fits.
std::string named_tag(Marker tag, const std::string* name) {
    std::string words = fmt::format("{}", tag);
    if (name == nullptr) return words;
    constexpr std::size_t room = 27;
    words += " " + *name;
    if (words.size() <= room) return words;
    std::size_t end = room - 3;
    while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xc0U) == 0x80U) --end;  // UTF-8
    return words.substr(0, end) + "...";
}

/// `names` contains the names of the groups of all dimensions.
void add_tags(Table& table, const std::vector<quality::TagTotal>& totals, const char* title,
              const char* count, const char* size, int dimension,
              const std::vector<GroupName>& names) {
    if (totals.empty()) return;
    table.heading(title, count, size);
    const std::size_t shown_count = std::min(shown_tags, totals.size());
    for (std::size_t i = 0; i < shown_count; ++i) {
        table.row(named_tag(totals[i].tag, name_of_group(names, dimension, totals[i].tag)),
                  shown(totals[i].count), shown(totals[i].size));
    }
    if (shown_count < totals.size()) {
        table.row(fmt::format("and {} more; --json has all", grouped(totals.size() - shown_count)));
    }
}

}  // namespace

std::string format_table(const quality::MeshStatistics& s, const std::vector<GroupName>& names) {
    Table table;
    add_counts(table, s.counts);
    add_extent(table, s);
    add_tags(table, s.regions, "Region", "cells", "volume", 3, names);
    add_tags(table, s.facet_markers, "Facet marker", "facets", "area", 2, names);
    add_tags(table, s.edge_markers, "Edge marker", "edges", "length", 1, names);
    add_features(table, s.features);
    add_shapes(table, s);
    add_adjacency(table, s.adjacency);
    table.histogram("Dihedral angle, degrees", s.dihedral_histogram);
    table.histogram("Eta", s.eta_histogram);
    return std::move(table).take();
}

void print_table(const quality::MeshStatistics& statistics, const std::vector<GroupName>& names) {
    print_text(format_table(statistics, names));
}

}  // namespace octetra::cli
