#include "verdict/describe.hpp"

#include <array>

#include <fmt/format.h>

namespace octetra::cli {

std::string_view kind_of(const verify::Entity& entity) {
    constexpr std::array<std::string_view, 7> kinds{"vertex", "cell", "facet", "listed_edge",
                                                    "face",   "edge", "piece"};
    return kinds[static_cast<std::size_t>(entity.kind)];
}

std::string_view word_of(verify::Status status) {
    constexpr std::array<std::string_view, 3> words{"passed", "failed", "skipped"};
    return words[static_cast<std::size_t>(status)];
}

std::string describe(const verify::Entity& entity, const JudgedFiles& judged) {
    const bool coarse = entity.mesh == verify::Which::coarse;
    const std::uint64_t first = coarse ? judged.coarse_index_base : judged.fine_index_base;
    std::string text;
    if (entity.vertices.empty()) {
        text = fmt::format("{} {}", kind_of(entity), entity.number + first);
        if (entity.kind == verify::Entity::Kind::tagged_edge) text = text.substr(7);
    } else {
        for (const VertexIndex v : entity.vertices) {
            text += fmt::format("{}{}", text.empty() ? "" : " ", v.value() + first);
        }
        text = fmt::format("{} ({})", kind_of(entity), text);
    }
    return coarse ? "coarse " + text : text;
}

}  // namespace octetra::cli
