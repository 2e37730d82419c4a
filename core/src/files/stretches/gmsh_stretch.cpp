#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "files/gmsh/binary_input.hpp"
#include "files/gmsh/entity_groups.hpp"
#include "files/gmsh/format_line.hpp"
#include "files/gmsh/group_names.hpp"
#include "files/gmsh/section_order.hpp"
#include "files/gmsh/sections_2.hpp"
#include "files/gmsh/sections_4.hpp"
#include "files/input/fields.hpp"
#include "files/stretches/gmsh_blocks.hpp"
#include "files/stretches/gmsh_line_input.hpp"
#include "files/stretches/gmsh_listed_again.hpp"
#include "files/stretches/gmsh_node_tags.hpp"
#include "files/stretches/gmsh_stretch_intake.hpp"
#include "files/stretches/line_index.hpp"
#include "files/stretches/progress.hpp"
#include "files/stretches/readers.hpp"
#include "files/stretches/shares.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace gmsh;

/// Reads the sections after $MeshFormat. All processes read all sections, each with an input of its
/// own; of nodes and elements, each process reads its share of the rows.
template <class Input>
class GmshStretch {
public:
    GmshStretch(Input& in, const FormatLine& format, const fs::path& path, Progress& progress)
        : in_(&in),
          is_4_(format.is_4),
          path_(&path),
          progress_(&progress),
          order_(format.is_4),
          intake_(stretch_.lists) {}

    /// Collective. Reads the whole file.
    [[nodiscard]] std::optional<MeshStretch> read() {
        while (true) {
            std::string name;
            progress_->attempt([&] { name = in_->section(); });
            if (!progress_->all_well()) return std::nullopt;
            if (name.empty()) break;
            if (!read_section(name)) return std::nullopt;
        }
        if (!complete()) return std::nullopt;
        return std::move(stretch_);
    }

private:
    const ProcessGroup& group() const { return progress_->group(); }
    static void refuse(const std::string& what) { throw std::runtime_error(what); }

    // All functions that return bool are collective, and return false on all processes if one has
    // failed.

    bool read_section(const std::string& name) {
        auto section = SectionKind::other;
        progress_->attempt([&] { section = order_.begin(name, refuse); });
        if (!progress_->all_well()) return false;
        switch (section) {
            case SectionKind::names: {
                progress_->attempt([&] {
                    intake_.left_out.names = read_group_names(*in_, names_, intake_.untagged);
                });
                break;
            }
            case SectionKind::entities: {
                progress_->attempt([&] { read_entities_4(*in_, entities_); });
                break;
            }
            case SectionKind::partitioned_entities: {
                progress_->attempt([&] { read_partitioned_entities_4(*in_, entities_); });
                break;
            }
            case SectionKind::nodes: {
                if (!(is_4_ ? read_nodes_by_blocks() : read_nodes_by_rows())) return false;
                break;
            }
            case SectionKind::elements: {
                if (!read_elements()) return false;
                break;
            }
            case SectionKind::other: return skip_section(name);
        }
        progress_->attempt([&] { in_->end_section(name); });
        return progress_->all_well();
    }

    /// Skips a section of unknown content, whose end the first process finds.
    bool skip_section(const std::string& name) {
        std::uint64_t behind = 0;
        progress_->attempt([&] {
            if (order_.is_noted()) {
                stretch_.notes.push_back(
                    fmt::format("{}: the section {} is not kept", in_->place(), shown(name)));
            }
            if (!group().is_first()) return;
            in_->skip_section(name);
            behind = in_->here();
        });
        if (!take_from_first(*progress_, behind)) return false;
        progress_->attempt([&] { in_->go_to(behind); });
        return progress_->all_well();
    }

    // Nodes

    bool read_nodes_by_rows() {
        std::uint64_t rows = 0;
        progress_->attempt([&] {
            node_count_ = read_node_count_2(*in_);
            rows = in_->here();
            constexpr std::uint64_t step = Input::row_step(node_bytes_2);
            const RowShare mine = take_node_share();
            in_->go_to(rows + mine.first * step);
            read_node_rows_2(*in_, mine.count, intake_);
            in_->end_rows();
            in_->go_to(rows + node_count_ * step);
        });
        return nodes_complete();
    }

    bool read_nodes_by_blocks() {
        BlockStart begin;
        progress_->attempt([&] {
            const SectionTotals totals = read_node_totals_4(*in_);
            begin = {in_->here(), 0, totals.blocks};
            node_count_ = totals.entries;
            take_node_share();
        });
        constexpr std::uint64_t tag_step = Input::row_step(NodeBlock::tag_bytes);
        const auto point_step = [](const NodeBlock& block) {
            return Input::row_step(block.point_bytes());
        };
        const auto read_head = [&](const BlockStart& at) {
            in_->go_to(at.place);
            const NodeBlock block = read_node_block_4(*in_, node_count_ - at.first_row);
            const std::uint64_t rows = in_->here();
            const std::uint64_t length = block.count * (tag_step + point_step(block));
            return ReadBlock<NodeBlock>{
                block, rows, {rows + length, at.first_row + block.count, at.blocks_left - 1}};
        };
        const auto read_rows = [&](const ReadBlock<NodeBlock>& of, std::uint64_t first,
                                   std::uint64_t count) {
            in_->go_to(of.rows + first * tag_step);
            read_node_tags_4(*in_, count, intake_);
            in_->end_rows();
            in_->go_to(of.rows + of.block.count * tag_step + first * point_step(of.block));
            read_node_points_4(*in_, of.block, count, intake_);
            in_->end_rows();
        };
        return read_shared_blocks(begin, node_count_, read_head, read_rows) && nodes_complete();
    }

    RowShare take_node_share() {
        const RowShare mine = share_of_rows(node_count_, group());
        stretch_.first_vertex = mine.first;
        intake_.expect_nodes(mine.count);
        return mine;
    }

    bool nodes_complete() {
        if (!progress_->all_well()) return false;
        node_tags_ = NodeTags::make(*progress_, intake_.release_tags(), stretch_.first_vertex);
        if (!node_tags_) return false;
        intake_.know_tags(*node_tags_);
        return true;
    }

    // Elements

    bool read_elements() {
        if (is_4_) return read_elements_4();
        Elements2 elements(*in_, intake_);
        if constexpr (Input::has_lines) {
            if (!read_element_lines(elements)) return false;
        } else {
            if (!read_element_blocks(elements)) return false;
        }
        return drop_listed_again(elements, cell_kind) && drop_listed_again(elements, facet_kind) &&
               drop_listed_again(elements, edge_kind);
    }

    bool read_elements_4() {
        BlockStart begin;
        std::uint64_t count = 0;
        progress_->attempt([&] {
            const SectionTotals totals = read_element_totals_4(*in_);
            begin = {in_->here(), 0, totals.blocks};
            count = totals.entries;
        });
        const auto step = [](const ElementBlock& block) {
            return Input::row_step(block.row_bytes());
        };
        const auto read_head = [&](const BlockStart& at) {
            in_->go_to(at.place);
            const ElementBlock block = read_element_block_4(*in_, count - at.first_row, entities_);
            const std::uint64_t rows = in_->here();
            return ReadBlock<ElementBlock>{
                block,
                rows,
                {rows + block.count * step(block), at.first_row + block.count, at.blocks_left - 1}};
        };
        const auto read_rows = [&](const ReadBlock<ElementBlock>& of, std::uint64_t first,
                                   std::uint64_t rows) {
            in_->go_to(of.rows + first * step(of.block));
            read_element_rows_4(*in_, of.block, rows, intake_);
            in_->end_rows();
        };
        return read_shared_blocks(begin, count, read_head, read_rows);
    }

    /// For text files of version 2.
    bool read_element_lines(auto& elements) {
        progress_->attempt([&] {
            const std::uint64_t count = read_element_count_2(*in_);
            const std::uint64_t rows = in_->here();
            const RowShare mine = share_of_rows(count, group());
            in_->go_to(rows + mine.first);
            elements.read_lines(mine.count);
            in_->end_rows();
            in_->go_to(rows + count);
        });
        return progress_->all_well();
    }

    /// For binary files of version 2, which have the number of elements, but not that of blocks.
    bool read_element_blocks(auto& elements) {
        BlockStart begin;
        std::uint64_t count = 0;
        progress_->attempt([&] {
            count = read_element_count_2(*in_);
            begin = {in_->here(), 0, count};
        });
        const auto row_bytes = [&](const ElementBlock2& block) {
            if (const std::string wrong = refusal_of_type(block.type); !wrong.empty()) {
                refuse(wrong);
            }
            const std::uint64_t numbers = 1 + block.tags + element_type(block.type)->nodes;
            return numbers * sizeof(std::int32_t);
        };
        const auto read_head = [&](const BlockStart& at) {
            in_->go_to(at.place);
            const ElementBlock2 block = read_element_block_2(*in_, at.blocks_left);
            const std::uint64_t rows = in_->here();
            in_->check_count(block.count, 1, row_bytes(block), "elements");
            return ReadBlock<ElementBlock2>{
                block,
                rows,
                {rows + block.count * row_bytes(block), at.first_row + block.count,
                 at.blocks_left - block.count}};
        };
        const auto read_rows = [&](const ReadBlock<ElementBlock2>& of, std::uint64_t first,
                                   std::uint64_t rows) {
            in_->go_to(of.rows + first * row_bytes(of.block));
            elements.read_rows(of.block, rows);
        };
        return read_shared_blocks(begin, count, read_head, read_rows);
    }

    template <class I, std::size_t N>
    bool drop_listed_again(const auto& elements, const EntityKind<I, N>& kind) {
        const std::vector<ListedRun<N>> runs = of_each(*progress_, elements.listed(kind));
        if (!progress_->all_well()) return false;
        const auto to_go = count_listed_again(std::span<const ListedRun<N>>(runs),
                                              static_cast<std::size_t>(group().rank()));
        if (!to_go) return false;
        auto& list = stretch_.lists.*kind.list;
        auto& markers = stretch_.lists.*kind.markers;
        list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(*to_go));
        markers.erase(markers.begin(), markers.begin() + static_cast<std::ptrdiff_t>(*to_go));
        intake_.left_out.in_another_group += *to_go;
        return true;
    }

    /// Reads this process's share of a section of blocks with `row_count` rows.
    bool read_shared_blocks(const BlockStart& begin, std::uint64_t row_count, auto&& read_head,
                            auto&& read_rows) {
        if (!progress_->all_well()) return false;
        const auto share = share_blocks(*progress_, row_count, begin, read_head);
        if (!share) return false;
        progress_->attempt([&] {
            read_blocks(share_of_rows(row_count, group()), share->own, read_head, read_rows);
            in_->go_to(share->end.place);
        });
        return progress_->all_well();
    }

    // Completion

    /// To be called after the last section.
    bool complete() {
        progress_->attempt([&] { order_.end(refuse); });
        if (!progress_->all_well()) return false;
        MeshFacts counts;
        counts.vertices = node_count_;
        return number(cell_kind, counts, stretch_.first_cell) &&
               number(facet_kind, counts, stretch_.first_facet) &&
               number(edge_kind, counts, stretch_.first_edge) && tell_notes() && settle(counts);
    }

    template <class I, std::size_t N>
    bool number(const EntityKind<I, N>& kind, MeshFacts& counts, std::uint64_t& first) {
        auto& list = stretch_.lists.*kind.list;
        counts.*kind.count = group().sum(list.size());
        first = group().sum_before(list.size());
        return node_tags_->number(*progress_, list);
    }

    bool tell_notes() {
        LeftOut& all = intake_.left_out;  // names are equal on all processes
        for (std::uint64_t& count : all.of_shape) count = group().sum(count);
        all.interfaces = group().sum(all.interfaces);
        all.degenerate_lines = group().sum(all.degenerate_lines);
        all.in_another_group = group().sum(all.in_another_group);
        all.of_missing_entities = group().sum(all.of_missing_entities);
        progress_->attempt([&] {
            const auto note = [&](const std::string& text) { stretch_.notes.push_back(text); };
            tell_of_entities(entities_.in_several(), path_->native(), note);
            tell(all, path_->native(), note);
        });
        return progress_->all_well();
    }

    bool settle(const MeshFacts& counts) {
        if (!wrong_without_cells(counts.cells, counts.facets, intake_.left_out).empty()) {
            return false;  // the first process reports the position
        }
        settle_facts(counts, group(), stretch_);
        progress_->attempt(
            [&] { stretch_.facts.group_names = SharedGroupNames(std::move(names_)); });
        return progress_->all_well();
    }

    Input* in_;
    bool is_4_;
    const fs::path* path_;
    Progress* progress_;
    SectionOrder order_;
    MeshStretch stretch_;
    StretchIntake intake_;
    EntityGroups entities_;
    std::vector<GroupName> names_;
    std::uint64_t node_count_ = 0;
    std::optional<NodeTags> node_tags_;
};

}  // namespace

std::optional<MeshStretch> read_gmsh_stretch(const fs::path& path, const ProcessGroup& group) {
    Progress progress(group);
    std::optional<LineReader> lines;
    FormatLine format;
    progress.attempt([&] { format = read_format_line(lines.emplace(path)); });
    if (!progress.all_well()) return std::nullopt;
    if (format.is_binary) {
        std::optional<ByteReader> bytes;
        std::optional<BinaryInput> in;
        progress.attempt([&] {
            bytes.emplace(path).seek(lines->next_position());
            find_byte_order(*bytes);
            in.emplace(*bytes).end_section("MeshFormat");
        });
        if (!progress.all_well()) return std::nullopt;
        return GmshStretch(*in, format, path, progress).read();
    }
    std::uint64_t file_size = lines->file_size();
    if (!take_from_first(progress, file_size)) return std::nullopt;
    const auto index = LineIndex::make(progress, path, file_size);
    if (!index) return std::nullopt;
    std::optional<LineInput> in;
    progress.attempt([&] { in.emplace(*lines, *index).end_section("MeshFormat"); });
    if (!progress.all_well()) return std::nullopt;
    return GmshStretch(*in, format, path, progress).read();
}

}  // namespace octetra
