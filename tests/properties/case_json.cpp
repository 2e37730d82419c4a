#include "properties/case_json.hpp"

namespace octetra::properties {
namespace {

using distributed::Synchronisation;
using nlohmann::json;

json json_of(const Point& p) { return json::array({p.x, p.y, p.z}); }

Point point_of(const json& j) { return {j.at(0), j.at(1), j.at(2)}; }

/// Criteria that mark nothing are left out.
json json_of(const Selection& selection) {
    json j = json::object();
    if (selection.all) j["all"] = true;
    for (const GlobalCell c : selection.cells) {
        j["cells"].push_back(static_cast<std::uint64_t>(c));
    }
    for (const auto& [centre, radius] : selection.spheres) {
        j["spheres"].push_back({{"centre", json_of(centre)}, {"radius", radius}});
    }
    for (const auto& [low, high] : selection.boxes) {
        j["boxes"].push_back({{"low", json_of(low)}, {"high", json_of(high)}});
    }
    if (!selection.regions.empty()) j["regions"] = selection.regions;
    if (selection.random) {
        j["random"] = {{"fraction", selection.random->fraction}, {"seed", selection.random->seed}};
    }
    if (selection.max_volume) j["max_volume"] = *selection.max_volume;
    return j;
}

json list(const json& j, const char* key) { return j.value(key, json::array()); }

Selection selection_of(const json& j) {
    Selection selection;
    selection.all = j.value("all", false);
    for (const json& c : list(j, "cells")) selection.cells.push_back(GlobalCell{c});
    for (const json& s : list(j, "spheres")) {
        selection.spheres.push_back({point_of(s.at("centre")), s.at("radius")});
    }
    for (const json& b : list(j, "boxes")) {
        selection.boxes.push_back({point_of(b.at("low")), point_of(b.at("high"))});
    }
    selection.regions = j.value("regions", std::vector<Marker>{});
    if (j.contains("random")) {
        selection.random = RandomShare{j["random"].at("fraction"), j["random"].at("seed")};
    }
    if (j.contains("max_volume")) selection.max_volume = j["max_volume"].get<double>();
    return selection;
}

}  // namespace

json json_of(const Case& c) {
    return {{"kind", c.kind},
            {"selection", json_of(c.selection)},
            {"scheme", c.scheme == Scheme::eight  ? "8t"
                       : c.scheme == Scheme::four ? "4t"
                                                  : "2t"},
            {"levels", c.levels},
            {"sync", c.synchronisation == Synchronisation::gateway ? "gateway" : "neighbour"},
            {"cell_to_rank", c.cell_to_rank},
            {"seed", c.seed}};
}

Case case_of(const json& j) {
    const std::string scheme = j.at("scheme");
    return {.kind = j.at("kind"),
            .selection = selection_of(j.at("selection")),
            .scheme = scheme == "8t"   ? Scheme::eight
                      : scheme == "4t" ? Scheme::four
                                       : Scheme::two,
            .levels = j.at("levels"),
            .synchronisation =
                j.at("sync") == "gateway" ? Synchronisation::gateway : Synchronisation::neighbour,
            .cell_to_rank = j.at("cell_to_rank"),
            .seed = j.at("seed")};
}

}  // namespace octetra::properties
