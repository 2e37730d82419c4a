#include <optional>
#include <string>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/gmsh/binary_input.hpp"
#include "files/gmsh/entity_groups.hpp"
#include "files/gmsh/format_line.hpp"
#include "files/gmsh/gmsh.hpp"
#include "files/gmsh/ignored.hpp"
#include "files/gmsh/mesh_intake.hpp"
#include "files/gmsh/section_order.hpp"
#include "files/gmsh/sections_2.hpp"
#include "files/gmsh/sections_4.hpp"
#include "files/gmsh/text_input.hpp"
#include "files/input/fields.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace gmsh;

/// Reads the sections of a file after $MeshFormat.
template <class Input>
class GmshSections {
public:
    GmshSections(Input& in, const FormatLine& format, const ReadOptions& options,
                 GrowingMesh& growing, const std::optional<ElementCounts>& counts)
        : in_(&in),
          is_4_(format.is_4),
          options_(&options),
          intake_(growing, options, counts),
          order_(format.is_4) {}

    /// Returns the number of elements of each kind. `path` is used in notes.
    ElementCounts read(const fs::path& path) {
        while (true) {
            const std::string name = in_->section();
            if (name.empty()) break;
            read_section(name);
        }
        order_.end([this](const std::string& what) { in_->fail(what); });
        intake_.check(
            Input::has_lines, in_->end_position(),
            [this](const std::string& what, std::uint64_t place) { in_->fail_at(what, place); });
        note_entities_in_several_groups(groups_.in_several(), path.native(), options_->note);
        intake_.add_notes(path.native());
        return intake_.counts();
    }

private:
    void read_section(const std::string& name) {
        const SectionKind section =
            order_.begin(name, [this](const std::string& what) { in_->fail(what); });
        if (section != SectionKind::other) {
            read_known(section);
            return in_->end_section(name);
        }
        if (order_.is_noted()) {
            options_->note(
                fmt::format("{}: the section {} is not kept", in_->place(), shown(name)));
        }
        in_->skip_section(name);
    }

    void read_known(SectionKind section) {
        if (section == SectionKind::names) return intake_.take_names(*in_);
        if (section == SectionKind::entities) return read_entities_4(*in_, groups_);
        if (section == SectionKind::partitioned_entities) {
            return read_partitioned_entities_4(*in_, groups_);
        }
        if (section == SectionKind::nodes) {
            is_4_ ? read_nodes_4(*in_, intake_) : read_nodes_2(*in_, intake_);
            return intake_.nodes_complete([this](const std::string& what, std::uint64_t place) {
                in_->fail_at(what, place);
            });
        }
        is_4_ ? read_elements_4(*in_, groups_, intake_) : Elements2(*in_, intake_).read();
        intake_.elements_complete();
    }

    Input* in_;
    bool is_4_;
    const ReadOptions* options_;
    MeshIntake intake_;
    EntityGroups groups_;
    SectionOrder order_;
};

/// Reads the file into `growing`, and returns the number of elements of each kind.
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
    return found;
}

}  // namespace

void read_gmsh(const fs::path& path, const ReadOptions& options, GrowingMesh& growing) {
    std::optional<ElementCounts> counts;
    if (growing.is_streaming()) {
        GrowingMesh counted(true, *growing.sink());
        counted.stream_only(Streamed::nothing);
        counts = read_file(path, {.only_syntax = true}, counted, std::nullopt);
    }
    (void)read_file(path, options, growing, counts);
}

}  // namespace octetra
