#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/gmsh/binary_input.hpp"
#include "files/gmsh/entity_groups.hpp"
#include "files/gmsh/format_line.hpp"
#include "files/gmsh/gmsh.hpp"
#include "files/gmsh/mesh_intake.hpp"
#include "files/gmsh/sections_2.hpp"
#include "files/gmsh/sections_4.hpp"
#include "files/gmsh/text_input.hpp"
#include "files/input/fields.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace gmsh;

/// Reads the sections of a file behind $MeshFormat.
template <class Input>
class GmshSections {
public:
    GmshSections(Input& in, const FormatLine& format, const ReadOptions& options,
                 GrowingMesh& growing, const std::optional<ElementCounts>& counts)
        : in_(&in), is_4_(format.is_4), options_(&options), intake_(growing, options, counts) {}

    /// Returns how many elements of each kind there are. `path` is for notes.
    ElementCounts read(const fs::path& path) {
        while (true) {
            const std::string name = in_->section();
            if (name.empty()) break;
            read_section(name);
        }
        for (const std::string_view needed : {"Nodes", "Elements"}) {
            if (!is_read(needed)) in_->fail(fmt::format("there is no section ${}", needed));
        }
        intake_.check(Input::has_lines, [this](const std::string& what, std::uint64_t place) {
            in_->fail_at(what, place);
        });
        if (groups_.in_several() > 0) {
            options_->note(fmt::format(
                "{}: {} entities are in more physical groups than one: the first is kept",
                path.native(), groups_.in_several()));
        }
        intake_.tell_notes(path.native());
        return intake_.counts();
    }

private:
    void read_section(const std::string& name) {
        if (name == "PhysicalNames" || name == "Nodes" || name == "Elements" ||
            name == "Entities" || name == "PartitionedEntities") {
            if (is_read(name)) in_->fail(fmt::format("a second section ${}", name));
            read_known(name);
            return in_->end_section(name);
        }
        if (name.starts_with("End"))
            in_->fail(fmt::format("{} ends no section", shown("$" + name)));
        if (name == "ParametricNodes") {
            in_->fail("nodes with parameters: save without Mesh.SaveParametric");
        }
        const bool is_first = !is_read(name);
        if (is_first && name != "Comments") {
            options_->note(
                fmt::format("{}: the section {} is not kept", in_->place(), shown(name)));
        }
        if (is_first) read_.push_back(name);
        in_->skip_section(name);
    }

    void read_known(const std::string& name) {
        read_.push_back(name);
        if (name == "Nodes") {
            is_4_ ? read_nodes_4(*in_, intake_) : read_nodes_2(*in_, intake_);
            intake_.nodes_complete([this](const std::string& what, std::uint64_t place) {
                in_->fail_at(what, place);
            });
        } else if (name == "PhysicalNames") {
            intake_.take_names(*in_);
        } else if (name == "Elements") {
            if (!is_read("Nodes")) in_->fail("the section $Nodes must come before $Elements");
            is_4_ ? read_elements_4(*in_, groups_, intake_) : Elements2(*in_, intake_).read();
            intake_.elements_complete();
        } else if (!is_4_ || is_read("Elements")) {
            in_->fail(fmt::format("the section ${} must not stand here", name));
        } else if (name == "Entities") {
            read_entities_4(*in_, groups_);
        } else {
            read_partitioned_entities_4(*in_, groups_);
        }
    }

    [[nodiscard]] bool is_read(std::string_view name) const {
        return std::ranges::find(read_, name) != read_.end();
    }

    Input* in_;
    bool is_4_;
    const ReadOptions* options_;
    MeshIntake intake_;
    EntityGroups groups_;
    std::vector<std::string> read_;  // sections, each once
};

/// Reads the file into `growing`, and returns how many elements of each kind it has.
ElementCounts read_file(const fs::path& path, const ReadOptions& options, GrowingMesh& growing,
                        const std::optional<ElementCounts>& counts) {
    LineReader lines(path);
    const FormatLine format = read_format_line(lines);
    const auto read = [&](auto& in) {
        return GmshSections(in, format, options, growing, counts).read(path);
    };
    ElementCounts found;
    if (format.is_binary) {
        ByteReader bytes(path);
        bytes.seek(lines.next_position());
        BinaryInput in(bytes);
        find_byte_order(bytes);
        in.end_section("MeshFormat");
        found = read(in);
    } else {
        TextInput in(lines);
        in.end_section("MeshFormat");
        found = read(in);
    }
    if (counts && found != *counts) {
        throw InputError(fmt::format("{}: the file has changed while it was read", path.native()));
    }
    growing.finish();
    return found;
}

}  // namespace

Mesh read_gmsh(const fs::path& path, const ReadOptions& options) {
    GrowingMesh growing(nullptr, true);
    (void)read_file(path, options, growing, std::nullopt);
    return std::move(growing.mesh);
}

void stream_gmsh(const fs::path& path, MeshSink& sink, const ReadOptions& options) {
    GrowingMesh counted(&sink, true, Streamed::nothing);
    const ElementCounts counts = read_file(path, {.only_syntax = true}, counted, std::nullopt);
    GrowingMesh growing(&sink, true);
    (void)read_file(path, options, growing, counts);
}

}  // namespace octetra
