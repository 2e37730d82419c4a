#include <nlohmann/json.hpp>

#include "profile/format_profile.hpp"

namespace octetra::cli {
namespace {

using Json = nlohmann::ordered_json;
using distributed::Span;

double microseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1000; }

/// Returns the metadata event that names or orders the lane of a rank in the viewer.
Json lane(std::size_t rank, const char* what, const Json& arguments) {
    return {{"name", what}, {"ph", "M"}, {"pid", rank}, {"tid", 0}, {"args", arguments}};
}

Json event(std::size_t rank, const Span& span) {
    Json arguments = Json::object();
    if (span.level > 0) arguments["level"] = span.level;
    if (span.is_communication) {
        arguments["messages"] = span.messages;
        arguments["bytes"] = span.bytes;
    }
    return {{"name", span.name.data()},
            {"cat", span.is_communication ? "communication" : "phase"},
            {"ph", "X"},
            {"pid", rank},
            {"tid", 0},
            {"ts", microseconds(span.begin_nanoseconds)},
            {"dur", microseconds(span.nanoseconds)},
            {"args", arguments}};
}

}  // namespace

std::string format_trace(const distributed::GatheredProfile& profile) {
    std::string text = "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [\n";
    bool is_first = true;
    const auto add = [&](const Json& json) {
        if (!is_first) text += ",\n";
        is_first = false;
        text += json.dump();
    };
    for (std::size_t rank = 0; rank < profile.spans_of_rank.size(); ++rank) {
        add(lane(rank, "process_name", {{"name", "rank " + std::to_string(rank)}}));
        add(lane(rank, "process_sort_index", {{"sort_index", rank}}));
        for (const Span& span : profile.spans_of_rank[rank]) add(event(rank, span));
    }
    return text + "\n]}\n";
}

}  // namespace octetra::cli
