#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "info/name_of_group.hpp"
#include "info/print_statistics.hpp"
#include "terminal.hpp"

namespace octetra::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json(const Point& p) { return {p.x, p.y, p.z}; }

Json json(const Box& box) { return {{"low", json(box.low)}, {"high", json(box.high)}}; }

Json json(const quality::Range& range) { return {{"min", range.min}, {"max", range.max}}; }

Json json(const quality::Quality& quality) {
    return {{"min", quality.min}, {"mean", quality.mean}, {"max", quality.max}};
}

Json json(const quality::Histogram& histogram) {
    return {{"low", histogram.low}, {"high", histogram.high}, {"counts", histogram.counts}};
}

Json json(const quality::Adjacency& adjacency) {
    return {{"cells_per_edge", adjacency.cells_per_edge},
            {"cells_per_vertex", adjacency.cells_per_vertex},
            {"edges_per_vertex", adjacency.edges_per_vertex},
            {"faces_per_edge", adjacency.faces_per_edge},
            {"max_cells_at_edge", adjacency.max_cells_at_edge},
            {"max_cells_at_vertex", adjacency.max_cells_at_vertex}};
}

Json json(const FeatureCounts& counts) {
    Json out = Json::object();
    for (const Feature feature : all_features) {
        std::string name(name_of(feature));
        std::ranges::replace(name, ' ', '_');
        out[name] = counts[feature];
    }
    return out;
}

Json json(const History& history) {
    const CheckpointFacts& facts = history.facts;
    Json steps = Json::array();
    for (const StepFacts& step : facts.steps) {
        steps.push_back({{"cells_before", step.cells_before},
                         {"cells_cut", step.cells_cut},
                         {"bytes", step.bytes}});
    }
    Json levels = Json::array();
    for (const LevelFacts& level : history.levels) {
        levels.push_back({{"step", level.step}, {"vertices", level.vertices}});
    }
    Json fields = Json::array();
    for (const FieldFacts& field : facts.fields) {
        fields.push_back({{"name", field.name},
                          {"on", field.on == FieldOn::vertices ? "vertices" : "cells"},
                          {"components", field.components}});
    }
    const bool is_regular = facts.closure == Closure::regular;
    Json out{{"steps", std::move(steps)},
             {"closure", is_regular ? "regular" : "longest-edge"},
             {"levels", std::move(levels)},
             {"fields", std::move(fields)}};
    if (facts.state) {
        out["state"] = {
            {"time", facts.state->time}, {"step", facts.state->step}, {"text", facts.state->text}};
    }
    return out;
}

Json json(const quality::EntityCounts& counts) {
    return {{"vertices", counts.vertices},
            {"edges", counts.edges},
            {"faces", counts.faces},
            {"cells", counts.cells},
            {"boundary_faces", counts.boundary_faces},
            {"nonmanifold_faces", counts.nonmanifold_faces},
            {"listed_facets", counts.tagged_facets},
            {"listed_edges", counts.tagged_edges},
            {"unused_vertices", counts.unused_vertices},
            {"components", counts.components},
            {"euler_characteristic", counts.euler_characteristic}};
}

template <class T>
Json json(const std::optional<T>& value) {
    return value ? json(*value) : Json(nullptr);
}

Json json(const std::vector<quality::TagTotal>& totals, const char* tag, const char* count,
          const char* size, int dimension, const std::vector<GroupName>& names) {
    Json out = Json::array();
    for (const quality::TagTotal& total : totals) {
        Json& entry =
            out.emplace_back(Json{{tag, total.tag}, {count, total.count}, {size, total.size}});
        const std::string* name = name_of_group(names, dimension, total.tag);
        if (name != nullptr) entry["name"] = *name;
    }
    return out;
}

}  // namespace

std::string format_json(const quality::MeshStatistics& s, const History* history,
                        const std::vector<GroupName>& names) {
    Json out{{"counts", json(s.counts)},
             {"bounding_box", json(s.bounding_box)},
             {"volume", s.volume},
             {"boundary_area", s.boundary_area},
             {"regions", json(s.regions, "tag", "cells", "volume", 3, names)},
             {"facet_markers", json(s.facet_markers, "marker", "facets", "area", 2, names)},
             {"edge_markers", json(s.edge_markers, "marker", "edges", "length", 1, names)},
             {"features", json(s.features)},
             {"edge_length", json(s.edge_length)},
             {"cell_volume", json(s.cell_volume)},
             {"face_angle", json(s.face_angle)},
             {"dihedral_angle", json(s.dihedral_angle)},
             {"eta", json(s.eta)},
             {"dihedral_histogram", json(s.dihedral_histogram)},
             {"eta_histogram", json(s.eta_histogram)},
             {"adjacency", json(s.adjacency)}};
    if (history != nullptr) out["history"] = json(*history);
    return out.dump(2) + "\n";
}

void print_json(const quality::MeshStatistics& statistics, const History* history,
                const std::vector<GroupName>& names) {
    print_text(format_json(statistics, history, names));
}

}  // namespace octetra::cli
