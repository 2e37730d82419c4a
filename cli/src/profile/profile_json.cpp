#include <nlohmann/json.hpp>

#include "profile/format_profile.hpp"
#include "profile/spread.hpp"

namespace octetra::cli {
namespace {

using Json = nlohmann::ordered_json;
using distributed::PhaseCounts;

template <class T>
Json json(const std::vector<T>& of_rank) {
    const Spread<T> s = spread(of_rank);
    return {{"min", s.min}, {"mean", s.mean}, {"max", s.max}, {"of_rank", of_rank}};
}

/// Returns a figure that is additive over ranks.
template <class T>
Json json_with_sum(const std::vector<T>& of_rank) {
    Json out = json(of_rank);
    out["sum"] = spread(of_rank).sum;
    return out;
}

Json json(const distributed::ProfiledPhase& phase) {
    const auto& counts = phase.of_rank;
    return {{"phase", phase.name},
            {"level", phase.level},
            {"computing_seconds", json(each(counts, &PhaseCounts::computing_seconds))},
            {"communicating_seconds", json(each(counts, &PhaseCounts::communicating_seconds))},
            {"messages", json_with_sum(each(counts, &PhaseCounts::messages))},
            {"bytes", json_with_sum(each(counts, &PhaseCounts::bytes))},
            {"collectives", json_with_sum(each(counts, &PhaseCounts::collectives))},
            {"collective_bytes", json_with_sum(each(counts, &PhaseCounts::collective_bytes))},
            {"rounds", json(each(counts, &PhaseCounts::rounds))}};
}

Json json(const distributed::ProfiledLevel& level) {
    return {{"level", level.level},
            {"cells", json_with_sum(level.cells_of_rank)},
            {"cells_touched", json_with_sum(level.cells_touched_of_rank)},
            {"peak_memory_bytes", json(level.peak_memory_of_rank)}};
}

/// Returns an array with a line for each entry.
template <class T>
std::string lines(const std::vector<T>& entries) {
    std::string text = "[";
    for (const T& entry : entries) {
        text += &entry == &entries.front() ? "\n    " : ",\n    ";
        text += json(entry).dump();
    }
    return text + "\n  ]";
}

}  // namespace

std::string format_profile_json(const distributed::GatheredProfile& profile) {
    std::string text = "{\n  \"format\": \"octetra profile\",\n  \"version\": 1";
    const auto add = [&](const char* name, const std::string& value) {
        text += ",\n  \"";
        text += name;
        text += "\": ";
        text += value;
    };
    add("ranks", std::to_string(profile.seconds_of_rank.size()));
    add("seconds", json(profile.seconds_of_rank).dump());
    add("peak_memory_bytes", json(profile.peak_memory_of_rank).dump());
    add("levels", lines(profile.levels));
    add("phases", lines(profile.phases));
    return text + "\n}\n";
}

}  // namespace octetra::cli
