#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "files/gmsh/binary_input.hpp"
#include "files/gmsh/blocks.hpp"
#include "files/gmsh/entity_groups.hpp"
#include "files/gmsh/format_line.hpp"
#include "files/gmsh/gmsh.hpp"
#include "files/gmsh/group_names.hpp"
#include "files/gmsh/line_input.hpp"
#include "files/gmsh/listed_again.hpp"
#include "files/gmsh/node_tags.hpp"
#include "files/gmsh/section_order.hpp"
#include "files/gmsh/sections_2.hpp"
#include "files/gmsh/sections_4.hpp"
#include "files/gmsh/share_intake.hpp"
#include "files/input/fields.hpp"
#include "files/input/finish_share.hpp"
#include "files/shares/line_index.hpp"
#include "files/shares/shares.hpp"
#include "files/shares/status.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace gmsh;

/// Reads the sections after $MeshFormat. All processes read all sections, each with an input of its
/// own; of nodes and elements, each process reads its share of the rows.
template <class Input>
class GmshShareReader {
public:
    GmshShareReader(Input& in, const FormatLine& format, const fs::path& path,
                    CollectiveStatus& status)
        : in_(&in),
          is_4_(format.is_4),
          path_(&path),
          status_(&status),
          order_(format.is_4),
          intake_(share_.lists) {}

    /// Collective. Reads the whole file.
    [[nodiscard]] std::optional<MeshShare> read() {
        while (true) {
            std::string name;
            status_->attempt([&] { name = in_->section(); });
            if (!status_->all_succeeded()) return std::nullopt;
            if (name.empty()) break;
            if (!read_section(name)) return std::nullopt;
        }
        if (!complete()) return std::nullopt;
        return std::move(share_);
    }

private:
    const ProcessGroup& group() const { return status_->group(); }
    static void refuse(const std::string& what) { throw std::runtime_error(what); }

    // All functions that return bool are collective, and return false on all processes if one has
    // failed.

    bool read_section(const std::string& name) {
        auto section = SectionKind::other;
        status_->attempt([&] { section = order_.begin(name, refuse); });
        if (!status_->all_succeeded()) return false;
        switch (section) {
            case SectionKind::names: {
                status_->attempt([&] {
                    intake_.ignored.names = read_group_names(*in_, names_, intake_.untagged);
                });
                break;
            }
            case SectionKind::entities: {
                status_->attempt([&] { read_entities_4(*in_, entities_); });
                break;
            }
            case SectionKind::partitioned_entities: {
                status_->attempt([&] { read_partitioned_entities_4(*in_, entities_); });
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
        status_->attempt([&] { in_->end_section(name); });
        return status_->all_succeeded();
    }

    /// Skips a section of unknown content, whose end the first process finds.
    bool skip_section(const std::string& name) {
        std::uint64_t behind = 0;
        status_->attempt([&] {
            if (order_.is_noted()) {
                share_.notes.push_back(
                    fmt::format("{}: the section {} is not kept", in_->place(), shown(name)));
            }
            if (!group().is_first()) return;
            in_->skip_section(name);
            behind = in_->here();
        });
        if (!broadcast_from_first(*status_, behind)) return false;
        status_->attempt([&] { in_->seek(behind); });
        return status_->all_succeeded();
    }

    // Nodes

    bool read_nodes_by_rows() {
        std::uint64_t rows = 0;
        status_->attempt([&] {
            node_count_ = read_node_count_2(*in_);
            rows = in_->here();
            constexpr std::uint64_t step = Input::row_step(node_bytes_2);
            const RowShare mine = take_node_share();
            in_->seek(rows + mine.first * step);
            read_node_rows_2(*in_, mine.count, intake_);
            in_->end_rows();
            in_->seek(rows + node_count_ * step);
        });
        return nodes_complete();
    }

    bool read_nodes_by_blocks() {
        BlockStart begin;
        status_->attempt([&] {
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
            in_->seek(at.position);
            const NodeBlock block = read_node_block_4(*in_, node_count_ - at.first_row);
            const std::uint64_t rows = in_->here();
            const std::uint64_t length = block.count * (tag_step + point_step(block));
            return ReadBlock<NodeBlock>{
                block, rows, {rows + length, at.first_row + block.count, at.blocks_left - 1}};
        };
        const auto read_rows = [&](const ReadBlock<NodeBlock>& of, std::uint64_t first,
                                   std::uint64_t count) {
            in_->seek(of.rows + first * tag_step);
            read_node_tags_4(*in_, count, intake_);
            in_->end_rows();
            in_->seek(of.rows + of.block.count * tag_step + first * point_step(of.block));
            read_node_points_4(*in_, of.block, count, intake_);
            in_->end_rows();
        };
        return read_shared_blocks(begin, node_count_, read_head, read_rows) && nodes_complete();
    }

    RowShare take_node_share() {
        const RowShare mine = share_of_rows(node_count_, group());
        share_.first_vertex = mine.first;
        intake_.expect_nodes(mine.count);
        return mine;
    }

    bool nodes_complete() {
        if (!status_->all_succeeded()) return false;
        node_tags_ = NodeTags::make(*status_, intake_.release_tags(), share_.first_vertex);
        if (!node_tags_) return false;
        intake_.set_node_tags(*node_tags_);
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
        status_->attempt([&] {
            const SectionTotals totals = read_element_totals_4(*in_);
            begin = {in_->here(), 0, totals.blocks};
            count = totals.entries;
        });
        const auto step = [](const ElementBlock& block) {
            return Input::row_step(block.row_bytes());
        };
        const auto read_head = [&](const BlockStart& at) {
            in_->seek(at.position);
            const ElementBlock block = read_element_block_4(*in_, count - at.first_row, entities_);
            const std::uint64_t rows = in_->here();
            return ReadBlock<ElementBlock>{
                block,
                rows,
                {rows + block.count * step(block), at.first_row + block.count, at.blocks_left - 1}};
        };
        const auto read_rows = [&](const ReadBlock<ElementBlock>& of, std::uint64_t first,
                                   std::uint64_t rows) {
            in_->seek(of.rows + first * step(of.block));
            read_element_rows_4(*in_, of.block, rows, intake_);
            in_->end_rows();
        };
        return read_shared_blocks(begin, count, read_head, read_rows);
    }

    /// For text files of version 2.
    bool read_element_lines(auto& elements) {
        status_->attempt([&] {
            const std::uint64_t count = read_element_count_2(*in_);
            const std::uint64_t rows = in_->here();
            const RowShare mine = share_of_rows(count, group());
            in_->seek(rows + mine.first);
            elements.read_lines(mine.count);
            in_->end_rows();
            in_->seek(rows + count);
        });
        return status_->all_succeeded();
    }

    /// For binary files of version 2, which have the number of elements, but not that of blocks.
    bool read_element_blocks(auto& elements) {
        BlockStart begin;
        std::uint64_t count = 0;
        status_->attempt([&] {
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
            in_->seek(at.position);
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
            in_->seek(of.rows + first * row_bytes(of.block));
            elements.read_rows(of.block, rows);
        };
        return read_shared_blocks(begin, count, read_head, read_rows);
    }

    template <class I, std::size_t N>
    bool drop_listed_again(const auto& elements, const EntityKind<I, N>& kind) {
        const std::vector<ListedRun<N>> runs = of_each(*status_, elements.listed(kind));
        if (!status_->all_succeeded()) return false;
        const auto removed_count = count_listed_again(std::span<const ListedRun<N>>(runs),
                                                      static_cast<std::size_t>(group().rank()));
        if (!removed_count) return false;
        auto& list = share_.lists.*kind.list;
        auto& markers = share_.lists.*kind.markers;
        list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(*removed_count));
        markers.erase(markers.begin(),
                      markers.begin() + static_cast<std::ptrdiff_t>(*removed_count));
        intake_.ignored.in_another_group += *removed_count;
        return true;
    }

    /// Reads this process's share of a section of blocks with `row_count` rows.
    bool read_shared_blocks(const BlockStart& begin, std::uint64_t row_count, auto&& read_head,
                            auto&& read_rows) {
        if (!status_->all_succeeded()) return false;
        const auto share = share_blocks(*status_, row_count, begin, read_head);
        if (!share) return false;
        status_->attempt([&] {
            read_blocks(share_of_rows(row_count, group()), share->own, read_head, read_rows);
            in_->seek(share->end.position);
        });
        return status_->all_succeeded();
    }

    // Completion

    /// To be called after the last section.
    bool complete() {
        status_->attempt([&] { order_.end(refuse); });
        if (!status_->all_succeeded()) return false;
        MeshFacts counts;
        counts.vertices = node_count_;
        return number(cell_kind, counts) && number(facet_kind, counts) &&
               number(edge_kind, counts) && add_notes() && settle(counts);
    }

    template <class I, std::size_t N>
    bool number(const EntityKind<I, N>& kind, MeshFacts& counts) {
        auto& list = share_.lists.*kind.list;
        counts.*kind.count = group().sum(list.size());
        return node_tags_->number(*status_, list);
    }

    bool add_notes() {
        IgnoredContent& all = intake_.ignored;  // names are equal on all processes
        for (std::uint64_t& count : all.of_shape) count = group().sum(count);
        all.interfaces = group().sum(all.interfaces);
        all.degenerate_lines = group().sum(all.degenerate_lines);
        all.in_another_group = group().sum(all.in_another_group);
        all.of_missing_entities = group().sum(all.of_missing_entities);
        status_->attempt([&] {
            const auto note = [&](const std::string& text) { share_.notes.push_back(text); };
            note_entities_in_several_groups(entities_.in_several(), path_->native(), note);
            note_ignored(all, path_->native(), note);
        });
        return status_->all_succeeded();
    }

    bool settle(const MeshFacts& counts) {
        if (!error_without_cells(counts.cells, counts.facets, intake_.ignored).empty()) {
            return false;  // the first process reports the position
        }
        share_.lists.index_base = 1;
        finish_share(counts, true, group(), share_);
        status_->attempt([&] { share_.facts.group_names = SharedGroupNames(std::move(names_)); });
        return status_->all_succeeded();
    }

    Input* in_;
    bool is_4_;
    const fs::path* path_;
    CollectiveStatus* status_;
    SectionOrder order_;
    MeshShare share_;
    ShareIntake intake_;
    EntityGroups entities_;
    std::vector<GroupName> names_;
    std::uint64_t node_count_ = 0;
    std::optional<NodeTags> node_tags_;
};

}  // namespace

std::optional<MeshShare> read_gmsh_share(const fs::path& path, const ProcessGroup& group) {
    CollectiveStatus status(group);
    std::optional<LineReader> lines;
    FormatLine format;
    status.attempt([&] { format = read_format_line(lines.emplace(path)); });
    if (!status.all_succeeded()) return std::nullopt;
    if (format.is_binary) {
        std::optional<ByteReader> bytes;
        std::optional<BinaryInput> in;
        status.attempt([&] {
            bytes.emplace(path).seek(lines->next_position());
            find_byte_order(*bytes);
            in.emplace(*bytes).end_section("MeshFormat");
        });
        if (!status.all_succeeded()) return std::nullopt;
        return GmshShareReader(*in, format, path, status).read();
    }
    std::uint64_t file_size = lines->file_size();
    if (!broadcast_from_first(status, file_size)) return std::nullopt;
    const auto index = LineIndex::make(status, path, file_size);
    if (!index) return std::nullopt;
    std::optional<LineInput> in;
    status.attempt([&] { in.emplace(*lines, *index).end_section("MeshFormat"); });
    if (!status.all_succeeded()) return std::nullopt;
    return GmshShareReader(*in, format, path, status).read();
}

}  // namespace octetra
