#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/gmsh/gmsh.hpp"
#include "files/gmsh/intake/ignored.hpp"
#include "files/gmsh/intake/mesh_intake.hpp"
#include "files/gmsh/reading/binary_input.hpp"
#include "files/gmsh/reading/blocks.hpp"
#include "files/gmsh/reading/entity_groups.hpp"
#include "files/gmsh/reading/format_line.hpp"
#include "files/gmsh/reading/listed_again.hpp"
#include "files/gmsh/reading/section_order.hpp"
#include "files/gmsh/reading/sections_2.hpp"
#include "files/gmsh/reading/sections_4.hpp"
#include "files/gmsh/reading/text_input.hpp"
#include "files/input/fields.hpp"
#include "files/shares/gather.hpp"
#include "files/shares/line_index.hpp"
#include "files/shares/shares.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace gmsh;

/// Reads the sections after $MeshFormat. If several processes read the file, each reads its share
/// of the nodes and elements, and all other sections.
template <class Input>
class GmshReader {
public:
    GmshReader(Input& in, const FormatLine& format, const ReadOptions& options,
               GrowingMesh& growing, const std::optional<ElementCounts>& counts)
        : in_(&in),
          is_4_(format.is_4),
          options_(&options),
          group_(&growing.group()),
          intake_(growing, options, counts),
          order_(format.is_4) {}

    /// Collective. Returns the number of elements of each kind. `path` is used in notes.
    ElementCounts read(const fs::path& path) {
        while (true) {
            const std::string name = in_->section();
            if (name.empty()) break;
            read_section(name);
        }
        order_.end([this](const std::string& what) { in_->fail(what); });
        intake_.check(Input::has_lines, in_->end_position(), fail_at());
        note_entities_in_several_groups(entities_.in_several(), path.native(), options_->note);
        intake_.add_notes(path.native());
        return intake_.counts();
    }

private:
    [[nodiscard]] auto fail_at() const {
        return [this](const std::string& what, std::uint64_t place) { in_->fail_at(what, place); };
    }

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
        skip_section(name);
    }

    /// Skips a section of unknown content, whose end the first process finds.
    void skip_section(const std::string& name) {
        std::uint64_t end = 0;
        if (group_->is_first()) {
            in_->skip_section(name);
            end = in_->here();
        }
        in_->seek(group_->of_first(end));
    }

    void read_known(SectionKind section) {
        switch (section) {
            case SectionKind::names: return intake_.take_names(*in_);
            case SectionKind::entities: return read_entities_4(*in_, entities_);
            case SectionKind::partitioned_entities:
                return read_partitioned_entities_4(*in_, entities_);
            case SectionKind::nodes:
                is_4_ ? read_nodes_4() : read_nodes_2();
                return intake_.nodes_complete(fail_at());
            case SectionKind::elements:
                is_4_ ? read_elements_4() : read_elements_2();
                return intake_.elements_complete();
            case SectionKind::other: return;
        }
    }

    void read_nodes_2() {
        const std::uint64_t count = read_node_count_2(*in_);
        read_rows(count, Input::row_step(node_bytes_2), [&](std::uint64_t here) {
            intake_.expect_nodes(count, here);
            read_node_rows_2(*in_, here, intake_);
        });
    }

    /// Reads this process's rows of a section without blocks.
    void read_rows(std::uint64_t count, std::uint64_t step, auto&& read) {
        const RowShare mine = share_of_rows(count, *group_);
        const std::uint64_t begin = in_->here();
        in_->seek(begin + mine.first * step);
        read(mine.count);
        in_->end_rows();
        in_->seek(begin + count * step);
    }

    void read_nodes_4() {
        const SectionTotals totals = read_node_totals_4(*in_);
        intake_.expect_nodes(totals.entries, share_of_rows(totals.entries, *group_).count);
        constexpr std::uint64_t tag_step = Input::row_step(NodeBlock::tag_bytes);
        BlockSection section(*in_, *group_, totals,
                             [&](std::uint64_t left) { return read_node_block_4(*in_, left); });
        section.read("nodes", [&](const NodeBlock& block, std::uint64_t rows, std::uint64_t first,
                                  std::uint64_t count) {
            in_->seek(rows + first * tag_step);
            read_node_tags_4(*in_, count, intake_);
            in_->end_rows();
            const std::uint64_t points = rows + block.count * tag_step;
            in_->seek(points + first * Input::row_step(block.point_bytes()));
            read_node_points_4(*in_, block, count, intake_);
            in_->end_rows();
        });
    }

    void read_elements_4() {
        const SectionTotals totals = read_element_totals_4(*in_);
        intake_.expect_elements(totals.entries);
        BlockSection section(*in_, *group_, totals, [&](std::uint64_t left) {
            return read_element_block_4(*in_, left, entities_);
        });
        section.read("elements", [&](const ElementBlock& block, std::uint64_t rows,
                                     std::uint64_t first, std::uint64_t count) {
            in_->seek(rows + first * Input::row_step(block.row_bytes()));
            read_element_rows_4(*in_, block, count, intake_);
            in_->end_rows();
        });
    }

    void read_elements_2() {
        const std::uint64_t count = read_element_count_2(*in_);
        intake_.expect_elements(count);
        Elements2 elements(*in_, intake_);
        if constexpr (Input::has_lines) {
            read_rows(count, 1, [&](std::uint64_t here) { elements.read_lines(here); });
        } else {
            BlockSection section(*in_, *group_, {{}, count}, [&](std::uint64_t left) {
                return read_element_block_2(*in_, left);
            });
            elements.fill([&] {
                section.read("elements", [&](const ElementBlock2& block, std::uint64_t rows,
                                             std::uint64_t first, std::uint64_t here) {
                    in_->seek(rows + first * block.row_bytes());
                    elements.read_rows(block, here);
                });
            });
        }
        remove_listed_again(elements, cell_kind);
        remove_listed_again(elements, facet_kind);
        remove_listed_again(elements, edge_kind);
    }

    template <class I, std::size_t N>
    void remove_listed_again(const Elements2<Input>& elements, const EntityKind<I, N>& kind) {
        const std::vector<ListedRun<N>> runs = gather(*group_, elements.listed(kind));
        intake_.remove_first(kind, count_listed_again(std::span<const ListedRun<N>>(runs),
                                                      static_cast<std::size_t>(group_->rank())));
    }

    Input* in_;
    bool is_4_;
    const ReadOptions* options_;
    const ProcessGroup* group_;
    MeshIntake intake_;
    EntityGroups entities_;
    SectionOrder order_;
};

/// Collective. Reads the file into `growing`, and returns the number of elements of each kind.
ElementCounts read_file(const fs::path& path, const ReadOptions& options, GrowingMesh& growing,
                        const std::optional<ElementCounts>& counts) {
    LineReader lines(path);
    const FormatLine format = read_format_line(lines);
    const auto read = [&](auto&& in) {
        in.end_section("MeshFormat");
        const ElementCounts found = GmshReader(in, format, options, growing, counts).read(path);
        if (counts && found != *counts) {
            throw InputError(
                fmt::format("{}: the file has changed while it was read", path.native()));
        }
        return found;
    };
    if (format.is_binary) {
        ByteReader bytes(path);
        bytes.seek(lines.next_position());
        find_byte_order(bytes);
        return read(BinaryInput(bytes));
    }
    if (!growing.is_share()) return read(TextInput(lines));
    const ProcessGroup& group = growing.group();
    const LineIndex index(group, path, group.of_first(lines.file_size()));
    return read(TextInput(lines, &index));
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
