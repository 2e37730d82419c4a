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

std::uint64_t first_number(const verify::Entity& entity, const JudgedFiles& judged) {
    return entity.mesh == verify::Which::fine ? judged.fine_index_base : judged.coarse_index_base;
}

std::string describe(const verify::Entity& entity, const JudgedFiles& judged) {
    const std::uint64_t first = first_number(entity, judged);
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
    constexpr std::array<std::string_view, 3> mesh_prefixes{"", "coarse ", "previous "};
    return std::string(mesh_prefixes[static_cast<std::size_t>(entity.mesh)]) + text;
}

}  // namespace octetra::cli
