#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "files/gmsh/entity_groups.hpp"
#include "files/gmsh/mesh_intake.hpp"

/// The sections of version 4.1, text and binary: the same numbers in the same order.
namespace octetra::gmsh {

/// Reads a list of tags behind its length. Returns the length, and the first of them, or 0.
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

/// The rest of an entity, from its coordinates on.
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

/// The length of a block of a section of which so many entries are left.
template <class Input>
std::uint64_t read_block_length(Input& in, std::uint64_t left, std::string_view what) {
    const std::uint64_t count = in.number64("the length of a block");
    if (count <= left) return count;
    in.fail(fmt::format("a block of {} {}, where {} are left of all that were announced", count,
                        what, left));
}

template <class Input>
void read_node_block_4(Input& in, std::int32_t dimension, bool is_parametric, std::uint64_t count,
                       MeshIntake& intake) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t place = in.begin_row("a node's tag");
        intake.take_tag(in.number64("a node's tag"), place, Input::row_step(sizeof(std::uint64_t)));
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        const double x = in.coordinate("x");
        const double y = in.coordinate("y");
        intake.take_point({x, y, in.coordinate("z")});
        if (!is_parametric) continue;
        for (std::int32_t k = 0; k < dimension; ++k) in.skip_real("a parameter of a node");
    }
}

template <class Input>
void read_nodes_4(Input& in, MeshIntake& intake) {
    std::uint64_t blocks = in.number64("the number of blocks");
    const std::uint64_t total = in.number64("the number of nodes");
    in.check_count(total, 4, sizeof(std::uint64_t) + 3 * sizeof(double), "nodes");
    (void)in.number64("the least tag");
    (void)in.number64("the largest tag");
    intake.expect_nodes(total);
    std::uint64_t left = total;
    for (; blocks > 0; --blocks) {
        const std::int32_t dimension = read_dimension(in);
        (void)in.integer("the tag of an entity");
        const bool is_parametric = in.integer("whether a block is parametric") != 0;
        const std::uint64_t count = read_block_length(in, left, "nodes");
        read_node_block_4(in, dimension, is_parametric, count, intake);
        left -= count;
    }
    if (left > 0) in.fail(fmt::format("{} of the {} nodes announced are missing", left, total));
}

template <class Input, class I, std::size_t N>
void keep_block_4(Input& in, const EntityKind<I, N>& kind, Marker marker, std::uint64_t count,
                  MeshIntake& intake) {
    intake.make_room(kind, count);
    std::array<std::uint64_t, 1 + N> row;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t place = in.begin_row("an element");
        in.row(row, "a node of an element");
        const std::string_view wrong = intake.take<I, N>(
            kind, std::span(row).template last<N>(), marker, place, Input::row_step(sizeof row));
        if (!wrong.empty()) in.fail_at(wrong, place);
    }
}

template <class Input>
void skip_block_4(Input& in, const ElementType& type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
        for (std::uint32_t k = 0; k <= type.nodes; ++k) (void)in.number64("a node of an element");
    }
}

template <class Input>
void read_element_block_4(Input& in, std::uint64_t left, std::uint64_t& count,
                          const EntityGroups& groups, MeshIntake& intake) {
    const std::uint64_t place = in.begin_row("a block of elements");
    const std::int32_t dimension = read_dimension(in);
    const Entity entity = groups.find(dimension, in.integer("the tag of an entity"));
    const std::uint64_t type = in.number32("the type of elements");
    count = read_block_length(in, left, "elements");
    if (const std::string refusal = MeshIntake::refusal(type); !refusal.empty() && count > 0) {
        in.fail_at(refusal, place);
    }
    if (count == 0) return;
    const ElementType known = *element_type(type);
    in.check_count(count, 1 + known.nodes, (1 + known.nodes) * sizeof(std::uint64_t), "elements");
    if (entity.is_interface) {
        skip_block_4(in, known, count);
        return intake.skip_interface(count);
    }
    if (type == tetrahedron_type) return keep_block_4(in, cell_kind, entity.marker, count, intake);
    if (type == triangle_type) return keep_block_4(in, facet_kind, entity.marker, count, intake);
    if (type == line_type) return keep_block_4(in, edge_kind, entity.marker, count, intake);
    skip_block_4(in, known, count);
    intake.skip(known.shape, count);
}

template <class Input>
void read_elements_4(Input& in, const EntityGroups& groups, MeshIntake& intake) {
    std::uint64_t blocks = in.number64("the number of blocks");
    const std::uint64_t total = in.number64("the number of elements");
    in.check_count(total, 2, 2 * sizeof(std::uint64_t), "elements");
    (void)in.number64("the least tag");
    (void)in.number64("the largest tag");
    intake.expect_elements(total);
    std::uint64_t left = total;
    for (; blocks > 0; --blocks) {
        std::uint64_t count = 0;
        read_element_block_4(in, left, count, groups, intake);
        left -= count;
    }
    if (left > 0) in.fail(fmt::format("{} of the {} elements announced are missing", left, total));
}

}  // namespace octetra::gmsh
