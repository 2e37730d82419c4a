#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "files/input/fields.hpp"

namespace octetra::gmsh {

enum class SectionKind { names, entities, partitioned_entities, nodes, elements, other };

/// Which sections a file has, behind $MeshFormat, and in what order they may come. `fail(what)` is
/// called for what is wrong, and does not return.
class SectionOrder {
public:
    explicit SectionOrder(bool is_4) : is_4_(is_4) {}

    /// A section of this name begins.
    [[nodiscard]] SectionKind begin(const std::string& name, auto&& fail) {
        const SectionKind section = section_of(name);
        const bool is_known = section != SectionKind::other;
        is_first_ = !is_read(name);
        if (is_known && !is_first_) fail(fmt::format("a second section ${}", name));
        if (!is_known && name.starts_with("End"))
            fail(fmt::format("{} ends no section", shown("$" + name)));
        if (name == "ParametricNodes") {
            fail("nodes with parameters: save without Mesh.SaveParametric");
        }
        if (section == SectionKind::elements && !is_read("Nodes")) {
            fail("the section $Nodes must come before $Elements");
        }
        const bool has_entities =
            section == SectionKind::entities || section == SectionKind::partitioned_entities;
        if (has_entities && (!is_4_ || is_read("Elements"))) {
            fail(fmt::format("the section ${} must not stand here", name));
        }
        if (is_first_) read_.push_back(name);
        return section;
    }

    /// Of the last section that began, one of the others: is it to be noted that it is not kept?
    [[nodiscard]] bool is_noted() const { return is_first_ && read_.back() != "Comments"; }

    /// The file ends.
    void end(auto&& fail) const {
        for (const std::string_view needed : {"Nodes", "Elements"}) {
            if (!is_read(needed)) fail(fmt::format("there is no section ${}", needed));
        }
    }

private:
    static SectionKind section_of(std::string_view name) {
        if (name == "PhysicalNames") return SectionKind::names;
        if (name == "Entities") return SectionKind::entities;
        if (name == "PartitionedEntities") return SectionKind::partitioned_entities;
        if (name == "Nodes") return SectionKind::nodes;
        return name == "Elements" ? SectionKind::elements : SectionKind::other;
    }
    [[nodiscard]] bool is_read(std::string_view name) const {
        return std::ranges::find(read_, name) != read_.end();
    }

    bool is_4_;
    bool is_first_ = false;
    std::vector<std::string> read_;  // each once
};

}  // namespace octetra::gmsh
