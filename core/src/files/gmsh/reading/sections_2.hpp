#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "files/gmsh/element_types.hpp"
#include "files/gmsh/intake/mesh_intake.hpp"
#include "files/gmsh/reading/listed_again.hpp"
#include "files/gmsh/reading/row_batch.hpp"
#include "files/input/byte_reader.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/in_order.hpp"

/// The sections of versions 2 to 2.2, text and binary. Input is TextInput or BinaryInput.
namespace octetra::gmsh {

template <class Input>
std::uint64_t read_node_count_2(Input& in) {
    const std::uint64_t count = in.count_line("the number of nodes");
    in.check_count(count, 4, node_bytes_2, "nodes");
    return count;
}

template <class Input>
void read_node_rows_2(Input& in, std::uint64_t count, MeshIntake& intake) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t place = in.begin_row("a node");
        intake.take_tag(in.number32("a node's number"), place, Input::row_step(node_bytes_2));
        intake.take_point(in.point());
    }
}

/// A block of a binary file: elements of one type with the same number of tags.
struct ElementBlock2 {
    std::uint64_t type = 0;
    std::uint64_t count = 0;
    std::uint64_t tags = 0;

    /// The length of an element; 0 for a type that is not known, whose elements are refused.
    [[nodiscard]] std::uint64_t row_bytes() const {
        const auto known = element_type(type);
        return known ? (1 + tags + known->nodes) * sizeof(std::int32_t) : 0;
    }
    template <class Input>
    [[nodiscard]] std::uint64_t length() const {
        return count * row_bytes();
    }
};

/// `left` is the number of elements in further blocks.
template <class Input>
ElementBlock2 read_element_block_2(Input& in, std::uint64_t left) {
    const std::uint64_t begin = in.begin_row("elements");
    ElementBlock2 block;
    block.type = in.number32("the type of elements");
    block.count = in.number32("the number of elements");
    block.tags = in.number32("the number of tags");
    if (block.count == 0 || block.count > left) {
        in.fail_at(fmt::format("a block of {} elements, where {} remain", block.count, left),
                   begin);
    }
    return block;
}

template <class Input>
std::uint64_t read_element_count_2(Input& in) {
    const std::uint64_t count = in.count_line("the number of elements");
    in.check_count(count, 4, 2 * sizeof(std::int32_t), "elements");
    return count;
}

/// Reads the elements of version 2. The first tag of an element is its physical group, the second
/// its entity. An element of an entity in several groups is listed once for each of them.
template <class Input>
class Elements2 {
public:
    Elements2(Input& in, MeshIntake& intake) : in_(&in), intake_(&intake), batch_(in, intake) {}

    /// Reads `count` elements of a text file.
    void read_lines(std::uint64_t count) {
        fill([&] {
            for (std::uint64_t i = 0; i < count; ++i) {
                place_ = in_->begin_row("an element");
                (void)in_->number32("an element's number");
                const std::uint64_t type = in_->number32("an element's type");
                read_element(type, in_->number32("the number of tags"));
            }
        });
    }
    /// Calls read_blocks(), which calls read_rows() for the rows of each block of a binary file.
    void fill(auto&& read_blocks) {
        batch_.fill(read_blocks);
        cells_.store_last_nodes();
        facets_.store_last_nodes();
        edges_.store_last_nodes();
    }
    void read_rows(const ElementBlock2& block, std::uint64_t count) requires(!Input::has_lines) {
        const auto add_rows_of = [&](const auto& kind, auto& of) {
            intake_->make_room(kind, count);
            std::uint64_t one_by_one =
                0;  // elements to read singly after a failed read_uniform_rows()
            for (std::uint64_t left = count; left > 0;) {
                if (one_by_one == 0) {
                    const std::uint64_t read = read_uniform_rows(kind, of, block.tags, left);
                    left -= read;
                    if (read > 0) continue;
                    one_by_one = MeshIntake::most_at_once;
                }
                --one_by_one;
                --left;
                place_ = in_->begin_row("an element");
                if (read_at_once(kind, of, block.tags)) continue;
                (void)in_->integer("an element's number");
                read_element(block.type, block.tags);
            }
        };
        if (block.type == tetrahedron_type) return add_rows_of(cell_kind, cells_);
        if (block.type == triangle_type) return add_rows_of(facet_kind, facets_);
        for (std::uint64_t i = 0; i < count; ++i) {
            place_ = in_->begin_row("an element");
            (void)in_->integer("an element's number");
            read_element(block.type, block.tags);
        }
    }

    [[nodiscard]] const ListedRun<4>& listed(const EntityKind<CellIndex, 4>& /*kind*/) const {
        return cells_.run;
    }
    [[nodiscard]] const ListedRun<3>& listed(const EntityKind<FacetIndex, 3>& /*kind*/) const {
        return facets_.run;
    }
    [[nodiscard]] const ListedRun<2>& listed(const EntityKind<EdgeIndex, 2>& /*kind*/) const {
        return edges_.run;
    }

private:
    template <std::size_t N>
    struct OfKind {
        ListedRun<N> run;
        /// The nodes of the last kept element, in the batch. Copying them for each element would
        /// stall on the recent store.
        const std::array<std::uint64_t, N>* last_nodes = nullptr;

        void store_last_nodes() {
            if (last_nodes != nullptr) run.last.nodes = *std::exchange(last_nodes, nullptr);
        }
    };

    /// Reads the next rows of a binary file, at most `left`, as many as fit into the batch, if all
    /// have the groups of the last row. Returns their number, or 0 if any row differs.
    template <class I, std::size_t N>
    std::uint64_t read_uniform_rows(const EntityKind<I, N>& kind, OfKind<N>& of, std::size_t tags,
                                    std::uint64_t left) {
        const ListedRun<N>& run = of.run;
        if (tags < 2) return 0;
        const std::size_t size = (1 + tags + N) * sizeof(std::int32_t);
        auto rows = batch_.next_rows(kind, run.last.physical, in_->begin_row("an element"), size);
        if (rows.empty()) return 0;
        of.store_last_nodes();  // they are in slots that are overwritten below
        rows = rows.first(std::min<std::uint64_t>(rows.size(), left));
        const std::byte* row = in_->peek(rows.size() * size);
        if (row == nullptr) return 0;
        const bool swaps_bytes = in_->swaps_bytes();
        const auto number = [&](std::size_t k) {
            return number_at<std::int32_t>(row + k * sizeof(std::int32_t), swaps_bytes);
        };
        std::int32_t negative = 0;
        std::int32_t unlike = 0;
        for (auto& nodes : rows) {
            for (std::size_t k = 0; k < N; ++k) {
                const std::int32_t node = number(1 + tags + k);
                negative |= node;
                nodes[k] = static_cast<std::uint64_t>(node);
            }
            unlike |= (number(1) ^ run.last.physical) | (number(2) ^ run.last.elementary);
            row += size;
        }
        if (negative < 0 || unlike != 0) return 0;
        in_->pass(rows.size() * size);
        of.run.kept += rows.size();
        of.last_nodes = &batch_.add_rows(kind, rows.size());
        return rows.size();
    }
    /// Reads a whole row of a binary file at once. Returns false and consumes nothing if the row is
    /// incomplete or has an error, which reading it number by number then reports.
    template <class I, std::size_t N>
    bool read_at_once(const EntityKind<I, N>& kind, OfKind<N>& of, std::size_t tags) {
        const std::size_t size = (1 + tags + N) * sizeof(std::int32_t);
        const std::byte* const row = in_->peek(size);
        if (row == nullptr) return false;
        const auto number = [&](std::size_t k) {
            return number_at<std::int32_t>(row + k * sizeof(std::int32_t), in_->swaps_bytes());
        };
        auto& nodes = next_row(kind, of);
        std::int32_t negative = 0;
        for (std::size_t k = 0; k < N; ++k) {
            const std::int32_t node = number(1 + tags + k);
            negative |= node;
            nodes[k] = static_cast<std::uint64_t>(node);
        }
        if (negative < 0) return false;
        physical_ = tags > 0 ? number(1) : 0;
        elementary_ = tags > 1 ? number(2) : 0;
        in_->pass(size);
        keep(kind, nodes, size, of);
        return true;
    }
    void read_element(std::uint64_t type, std::uint64_t tags) {
        physical_ = elementary_ = 0;
        for (std::uint64_t k = 0; k < tags; ++k) {
            const std::int32_t tag = in_->integer("a tag");
            if (k == 0) physical_ = tag;
            if (k == 1) elementary_ = tag;
        }
        tags_ = tags;
        if (type == tetrahedron_type) return read_nodes(cell_kind, cells_);
        if (type == triangle_type) return read_nodes(facet_kind, facets_);
        if (type == line_type) return read_nodes(edge_kind, edges_);
        if (const std::string refusal = refusal_of_type(type); !refusal.empty()) {
            in_->fail_at(refusal, place_);
        }
        const ElementType known = *element_type(type);
        for (std::uint32_t k = 0; k < known.nodes; ++k) (void)in_->number32("a node's number");
        intake_->skip(known.shape, 1);
    }

    template <class I, std::size_t N>
    void read_nodes(const EntityKind<I, N>& kind, OfKind<N>& of) {
        auto& nodes = next_row(kind, of);
        for (std::uint64_t& node : nodes) node = in_->number32("a node's number");
        keep(kind, nodes, Input::row_step((1 + tags_ + N) * sizeof(std::int32_t)), of);
    }
    template <class I, std::size_t N>
    std::array<std::uint64_t, N>& next_row(const EntityKind<I, N>& kind, OfKind<N>& of) {
        if (!batch_.is_of(kind)) of.store_last_nodes();
        return batch_.next_row(kind);
    }
    /// Adds the next row of the batch unless it repeats the last element for another group.
    template <class I, std::size_t N>
    void keep(const EntityKind<I, N>& kind, const std::array<std::uint64_t, N>& nodes,
              std::uint64_t step, OfKind<N>& of) {
        if (is_degenerate_line(nodes)) return intake_->skip_degenerate_line();
        ListedRun<N>& run = of.run;
        if (physical_ != run.last.physical) {
            of.store_last_nodes();
            if (is_same_element({nodes, physical_, elementary_, true}, run.last)) {
                run.count_repetition(physical_);
                return intake_->skip_in_another_group();
            }
        }
        run.keep(nodes, physical_, elementary_);
        of.last_nodes = &batch_.add(kind, physical_, place_, step);
    }

    Input* in_;
    MeshIntake* intake_;
    RowBatch<Input> batch_;
    // The element being read:
    std::uint64_t place_ = 0;
    std::uint64_t tags_ = 0;
    std::int32_t physical_ = 0;
    std::int32_t elementary_ = 0;
    OfKind<4> cells_;
    OfKind<3> facets_;
    OfKind<2> edges_;
};

}  // namespace octetra::gmsh
