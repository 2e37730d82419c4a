#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

#include "verdict/describe.hpp"

namespace octetra::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Code;

Json json(const verify::Entity& entity, const JudgedFiles& judged) {
    constexpr std::array<std::string_view, 3> meshes{"fine", "coarse", "before"};
    const std::uint64_t first = first_number(entity, judged);
    Json out{{"kind", kind_of(entity)}, {"mesh", meshes[static_cast<std::size_t>(entity.mesh)]}};
    if (entity.vertices.empty()) {
        out["number"] = entity.number + first;
    } else {
        for (const VertexIndex v : entity.vertices) out["vertices"].push_back(v.value() + first);
    }
    return out;
}

Json json(const verify::Violation& violation, const JudgedFiles& judged) {
    Json out{{"code", name(violation.code)},
             {"entities", Json::array()},
             {"found", violation.found},
             {"expected", violation.expected}};
    for (const auto& entity : violation.entities) out["entities"].push_back(json(entity, judged));
    return out;
}

Json json(const verify::Facts& facts, bool of_refinement) {
    Json out{{"vertices", facts.vertices},
             {"cells", facts.cells},
             {"edges", facts.edges},
             {"faces", facts.faces},
             {"boundary_faces", facts.boundary_faces},
             {"unused_vertices", facts.unused_vertices},
             {"singular_edges", facts.singular_edges},
             {"singular_vertices", facts.singular_vertices}};
    if (of_refinement) {
        out["cells_kept"] = facts.cells_kept;
        out["midpoints"] = facts.bisected_edges;
        out["rounded_midpoints"] = facts.rounded_midpoints;
        out["deepest"] = facts.deepest;
        out["rounding_bound"] = facts.rounding_bound;
    }
    return out;
}

Json json(const std::optional<verify::AngleFigures>& angles, std::uint32_t index_base) {
    if (!angles || angles->min_dihedral_at.is_none()) return nullptr;
    return {{"min_dihedral", angles->min_dihedral},
            {"min_dihedral_cell", angles->min_dihedral_at.value() + std::uint64_t{index_base}},
            {"max_dihedral", angles->max_dihedral},
            {"min_solid", angles->min_solid},
            {"min_eta", angles->min_eta}};
}

/// `tag` and `quantity` are the JSON keys of the tag and of the sum.
Json json(const std::vector<verify::TagSum>& sums, const std::string& tag,
          const std::string& quantity, bool of_refinement) {
    Json out = Json::array();
    for (const verify::TagSum& sum : sums) {
        Json entry{{tag, sum.tag}, {quantity, sum.fine}};
        if (of_refinement) {
            entry["coarse_" + quantity] = sum.coarse;
            entry["difference"] = sum.difference;
        }
        out.push_back(std::move(entry));
    }
    return out;
}

}  // namespace

std::string format_json(const verify::Verdict& verdict, const JudgedFiles& judged) {
    const bool of_refinement = !judged.coarse.empty();
    Json out{{"schema", "octetra-verdict-1"}, {"valid", verdict.valid()}, {"mesh", judged.fine}};
    out["coarse_mesh"] = of_refinement ? Json(judged.coarse) : Json(nullptr);
    out["coarsened_from"] = judged.is_coarsened ? Json(judged.coarse) : Json(nullptr);
    out["checks"] = Json::array();
    for (const verify::Check& check : verdict.checks) {
        out["checks"].push_back({{"name", check.name},
                                 {"status", word_of(check.status)},
                                 {"note", check.note},
                                 {"seconds", check.seconds}});
    }
    out["violation_counts"] = Json::object();
    for (std::size_t code = 0; code < verify::code_count; ++code) {
        if (verdict.counts[code] == 0) continue;
        out["violation_counts"][std::string(name(static_cast<Code>(code)))] = verdict.counts[code];
    }
    out["violations"] = Json::array();
    for (const auto& violation : verdict.violations) {
        out["violations"].push_back(json(violation, judged));
    }
    out["facts"] = json(verdict.facts, of_refinement);
    out["volumes"] = json(verdict.volumes, "region", "volume", of_refinement);
    out["areas"] = json(verdict.areas, "marker", "area", of_refinement);
    out["angles"] = json(verdict.angles, judged.fine_index_base);
    out["coarse_angles"] = json(verdict.coarse_angles, judged.coarse_index_base);
    out["angles_by_depth"] = Json::array();
    for (const verify::DepthFigures& figures : verdict.by_depth) {
        out["angles_by_depth"].push_back({{"depth", figures.depth},
                                          {"cells", figures.cells},
                                          {"min_dihedral", figures.min_dihedral},
                                          {"min_eta", figures.min_eta}});
    }
    out["arithmetic"] = {{"filtered", verdict.arithmetic.filtered},
                         {"exact", verdict.arithmetic.exact}};
    return out.dump(2) + "\n";
}

}  // namespace octetra::cli
