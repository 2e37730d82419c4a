#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/mesh.hpp>

#include "files/gmsh/element_types.hpp"
#include "files/gmsh/intake/mesh_intake.hpp"
#include "files/gmsh/reading/blocks.hpp"
#include "files/gmsh/reading/entity_groups.hpp"
#include "files/gmsh/reading/row_batch.hpp"
#include "files/input/growing_mesh.hpp"

/// The sections of version 4.1, text and binary, which have the same numbers in the same order.
/// Input is TextInput or BinaryInput.
namespace octetra::gmsh {

/// Reads the length of a list of tags and the tags. Returns the length and the first tag, or 0 if
/// there is none.
template <class Input>
std::pair<std::uint64_t, std::int32_t> read_tags(Input& in, std::string_view what) {
    const std::uint64_t count = in.number64("the number of tags");
    in.check_count(count, 1, sizeof(std::int32_t), "tags");
    std::int32_t first = 0;
    for (std::uint64_t k = 0; k < count; ++k) {
        const std::int32_t tag = in.integer(what);
        if (k == 0) first = tag;
    }
    return {count, first};
}

/// Reads the rest of an entity, from its coordinates on.
template <class Input>
void read_entity_4(Input& in, std::int32_t dimension, std::int32_t tag, bool is_interface,
                   EntityGroups& groups) {
    const int coordinates = dimension == 0 ? 3 : 6;
    for (int k = 0; k < coordinates; ++k) in.skip_real("a coordinate of an entity");
    const auto [count, first] = read_tags(in, "the tag of a physical group");
    if (dimension > 0) (void)read_tags(in, "the tag of an entity's boundary");
    groups.add(dimension, tag, {first, is_interface}, count);
}

template <class Input>
std::array<std::uint64_t, 4> read_entity_counts(Input& in) {
    std::array<std::uint64_t, 4> counts;
    for (std::uint64_t& count : counts) {
        count = in.number64("the number of entities");
        in.check_count(count, 5, sizeof(std::int32_t) + 4 * sizeof(double), "entities");
    }
    return counts;
}

template <class Input>
void read_entities_4(Input& in, EntityGroups& groups) {
    const auto counts = read_entity_counts(in);
    for (std::int32_t dimension = 0; dimension < 4; ++dimension) {
        for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
            const std::int32_t tag = in.integer("the tag of an entity");
            read_entity_4(in, dimension, tag, false, groups);
        }
    }
}

template <class Input>
void read_partitioned_entities_4(Input& in, EntityGroups& groups) {
    (void)in.number64("the number of partitions");
    const std::uint64_t ghosts = in.number64("the number of ghost entities");
    for (std::uint64_t i = 0; i < ghosts; ++i) {
        (void)in.integer("the tag of a ghost entity");
        (void)in.integer("a partition");
    }
    const auto counts = read_entity_counts(in);
    for (std::int32_t dimension = 0; dimension < 4; ++dimension) {
        for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
            const std::int32_t tag = in.integer("the tag of an entity");
            const std::int32_t parent_dimension = in.integer("the dimension of an entity's parent");
            (void)in.integer("the tag of an entity's parent");
            (void)read_tags(in, "a partition");
            read_entity_4(in, dimension, tag, parent_dimension > dimension, groups);
        }
    }
}

template <class Input>
std::int32_t read_dimension(Input& in) {
    const std::int32_t dimension = in.integer("the dimension of an entity");
    if (dimension >= 0 && dimension <= 3) return dimension;
    in.fail(fmt::format("entities have dimension 0 to 3, not {}", dimension));
}

/// Reads the length of a block of a section in which `left` entries remain.
template <class Input>
std::uint64_t read_block_length(Input& in, std::uint64_t left, std::string_view what) {
    const std::uint64_t count = in.number64("the length of a block");
    if (count <= left) return count;
    in.fail(fmt::format("a block of {} {}, where {} of those announced remain", count, what, left));
}

template <class Input>
SectionTotals read_totals_4(Input& in, std::string_view what, std::size_t numbers,
                            std::size_t bytes) {
    SectionTotals totals;
    totals.blocks = in.number64("the number of blocks");
    totals.entries = in.number64(fmt::format("the number of {}", what));
    in.check_count(totals.entries, numbers, bytes, what);
    (void)in.number64("the least tag");
    (void)in.number64("the largest tag");
    return totals;
}
template <class Input>
SectionTotals read_node_totals_4(Input& in) {
    return read_totals_4(in, "nodes", 4, sizeof(std::uint64_t) + 3 * sizeof(double));
}
template <class Input>
SectionTotals read_element_totals_4(Input& in) {
    return read_totals_4(in, "elements", 2, 2 * sizeof(std::uint64_t));
}

/// A block of nodes of an entity: this is followed by the tags of all nodes, then by their points.
struct NodeBlock {
    std::size_t parameters = 0;  ///< after each point
    std::uint64_t count = 0;

    static constexpr std::size_t tag_bytes = sizeof(std::uint64_t);
    [[nodiscard]] std::size_t point_bytes() const { return (3 + parameters) * sizeof(double); }
    template <class Input>
    [[nodiscard]] std::uint64_t length() const {
        return count * (Input::row_step(tag_bytes) + Input::row_step(point_bytes()));
    }
};

/// `left` is the number of nodes in further blocks.
template <class Input>
NodeBlock read_node_block_4(Input& in, std::uint64_t left) {
    NodeBlock block;
    const std::int32_t dimension = read_dimension(in);
    (void)in.integer("the tag of an entity");
    const bool is_parametric = in.integer("whether a block is parametric") != 0;
    if (is_parametric) block.parameters = static_cast<std::size_t>(dimension);
    block.count = read_block_length(in, left, "nodes");
    return block;
}

template <class Input>
void read_node_tags_4(Input& in, std::uint64_t count, MeshIntake& intake) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t place = in.begin_row("a node's tag");
        intake.take_tag(in.number64("a node's tag"), place, Input::row_step(NodeBlock::tag_bytes));
    }
}

template <class Input>
void read_node_points_4(Input& in, const NodeBlock& block, std::uint64_t count,
                        MeshIntake& intake) {
    for (std::uint64_t i = 0; i < count; ++i) {
        (void)in.begin_row("x");
        intake.take_point(in.point());
        for (std::size_t k = 0; k < block.parameters; ++k) in.skip_real("a parameter of a node");
    }
}

/// A block of elements of an entity, all of one type.
struct ElementBlock {
    Entity entity;
    std::uint64_t type = 0;
    ElementType known{};
    std::uint64_t count = 0;

    [[nodiscard]] std::size_t row_bytes() const {
        return (1 + known.nodes) * sizeof(std::uint64_t);
    }
    template <class Input>
    [[nodiscard]] std::uint64_t length() const {
        return count * Input::row_step(row_bytes());
    }
};

/// `left` is the number of elements in further blocks. An empty block may have any type.
template <class Input>
ElementBlock read_element_block_4(Input& in, std::uint64_t left, const EntityGroups& groups) {
    ElementBlock block;
    const std::uint64_t place = in.begin_row("a block of elements");
    const std::int32_t dimension = read_dimension(in);
    block.entity = groups.find(dimension, in.integer("the tag of an entity"));
    block.type = in.number32("the type of elements");
    block.count = read_block_length(in, left, "elements");
    if (block.count == 0) return block;
    if (const std::string refusal = refusal_of_type(block.type); !refusal.empty()) {
        in.fail_at(refusal, place);
    }
    block.known = *element_type(block.type);
    in.check_count(block.count, 1 + block.known.nodes, block.row_bytes(), "elements");
    return block;
}

template <class Input, class I, std::size_t N>
void keep_rows_4(Input& in, const EntityKind<I, N>& kind, Marker marker, std::uint64_t count,
                 MeshIntake& intake) {
    intake.make_room(kind, count);
    RowBatch batch(in, intake);
    batch.fill([&] {
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t place = in.begin_row("an element");
            auto& nodes = batch.next_row(kind);
            in.row(nodes, "a node of an element");
            if (is_degenerate_line(nodes)) {
                intake.skip_degenerate_line();
                continue;
            }
            batch.add(kind, marker, place, Input::row_step((1 + N) * sizeof(std::uint64_t)));
        }
    });
}

/// Reads `count` rows of a block.
template <class Input>
void read_element_rows_4(Input& in, const ElementBlock& block, std::uint64_t count,
                         MeshIntake& intake) {
    if (block.entity.is_missing) intake.note_missing_entity(count);
    if (!block.entity.is_interface) {
        const Marker marker = block.entity.marker;
        if (block.type == tetrahedron_type)
            return keep_rows_4(in, cell_kind, marker, count, intake);
        if (block.type == triangle_type) return keep_rows_4(in, facet_kind, marker, count, intake);
        if (block.type == line_type) return keep_rows_4(in, edge_kind, marker, count, intake);
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        (void)in.begin_row("a node of an element");
        for (std::uint32_t k = 0; k <= block.known.nodes; ++k) {
            (void)in.number64("a node of an element");
        }
    }
    block.entity.is_interface ? intake.skip_interface(count)
                              : intake.skip(block.known.shape, count);
}

}  // namespace octetra::gmsh
