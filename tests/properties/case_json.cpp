#include "properties/case_json.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace octetra::properties {
namespace {

using distributed::Synchronisation;
using nlohmann::json;

json json_of(const Point& p) { return json::array({p.x, p.y, p.z}); }

Point point_of(const json& j) { return {j.at(0), j.at(1), j.at(2)}; }

/// Omits criteria that mark nothing.
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
    for (const Expression& expression : selection.where) j["where"].push_back(expression.text());
    for (const Selection& other : selection.narrowed_by) j["and"].push_back(json_of(other));
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
    for (const json& text : list(j, "where")) {
        selection.where.emplace_back(text.get<std::string>());
    }
    for (const json& other : list(j, "and")) selection.narrowed_by.push_back(selection_of(other));
    return selection;
}

std::string name_of(Scheme scheme) {
    return scheme == Scheme::eight ? "8t" : scheme == Scheme::four ? "4t" : "2t";
}

Closure closure_of(const std::string& name) {
    return name == "regular" ? Closure::regular : Closure::longest_edge;
}

Scheme scheme_of(const std::string& name) {
    return name == "8t" ? Scheme::eight : name == "4t" ? Scheme::four : Scheme::two;
}

/// Names, indexed by the values of Action.
constexpr std::array<const char*, 8> actions{"refine", "coarsen",   "take back", "again",
                                             "reload", "rebalance", "scatter",   "rewrite"};

json json_of(const Step& step) {
    json j{{"action", actions.at(static_cast<std::size_t>(step.action))}};
    if (step.action == Action::refine || step.action == Action::coarsen) {
        j["selection"] = json_of(step.selection);
    }
    if (step.action == Action::refine) j["scheme"] = name_of(step.scheme);
    if (step.action == Action::reload) j["ranks"] = step.ranks;
    if (step.action == Action::rewrite) j["format"] = step.format;
    return j;
}

Step step_of(const json& j) {
    const auto action = std::ranges::find(actions, j.at("action").get<std::string>());
    if (action == actions.end()) throw std::invalid_argument("there is no such step");
    return {.action = static_cast<Action>(action - actions.begin()),
            .selection = selection_of(j.value("selection", json::object())),
            .scheme = scheme_of(j.value("scheme", "8t")),
            .ranks = j.value("ranks", 1),
            .format = j.value("format", "")};
}

}  // namespace

json json_of(const Case& c) {
    json j{{"kind", c.kind},
           {"selection", json_of(c.selection)},
           {"scheme", name_of(c.scheme)},
           {"closure", c.closure == Closure::regular ? "regular" : "longest-edge"},
           {"levels", c.levels},
           {"sync", c.synchronisation == Synchronisation::gateway ? "gateway" : "neighbour"},
           {"cell_to_rank", c.cell_to_rank},
           {"seed", c.seed}};
    for (const Step& step : c.steps) j["steps"].push_back(json_of(step));
    return j;
}

Case case_of(const json& j) {
    std::vector<Step> steps;
    for (const json& step : list(j, "steps")) steps.push_back(step_of(step));
    return {.kind = j.at("kind"),
            .selection = selection_of(j.at("selection")),
            .scheme = scheme_of(j.at("scheme")),
            .closure = closure_of(j.value("closure", "longest-edge")),
            .levels = j.at("levels"),
            .synchronisation =
                j.at("sync") == "gateway" ? Synchronisation::gateway : Synchronisation::neighbour,
            .cell_to_rank = j.at("cell_to_rank"),
            .seed = j.at("seed"),
            .steps = std::move(steps)};
}

}  // namespace octetra::properties
