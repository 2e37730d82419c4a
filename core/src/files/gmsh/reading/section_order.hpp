#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "files/input/fields.hpp"

namespace octetra::gmsh {

enum class SectionKind { names, entities, partitioned_entities, nodes, elements, other };

/// Checks which sections a file has after $MeshFormat, and their order. `fail(what)` is called for
/// an error and does not return.
class SectionOrder {
public:
    explicit SectionOrder(bool is_4) : is_4_(is_4) {}

    /// Registers the beginning of a section of this name.
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
            fail(fmt::format("the section ${} is not allowed here", name));
        }
        if (is_first_) read_.push_back(name);
        return section;
    }

    /// Returns whether a note should report that the last section, of an unsupported kind, is
    /// ignored.
    [[nodiscard]] bool is_noted() const { return is_first_ && read_.back() != "Comments"; }

    /// Checks at the end of the file that the required sections are present.
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
    std::vector<std::string> read_;  // without duplicates
};

}  // namespace octetra::gmsh
