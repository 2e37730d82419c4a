#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "files/gmsh/mesh_intake.hpp"

/// The sections of versions 2 to 2.2, text and binary.
namespace octetra::gmsh {

template <class Input>
void read_nodes_2(Input& in, MeshIntake& intake) {
    const std::uint64_t count = in.count_line("the number of nodes");
    constexpr std::size_t row = sizeof(std::int32_t) + 3 * sizeof(double);
    in.check_count(count, 4, row, "nodes");
    intake.expect_nodes(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t place = in.begin_row("a node");
        intake.take_tag(in.number32("a node's number"), place, Input::row_step(row));
        const double x = in.coordinate("x");
        const double y = in.coordinate("y");
        intake.take_point({x, y, in.coordinate("z")});
    }
}

/// Reads the elements of version 2: each has its physical group first among its tags, then its
/// entity.
template <class Input>
class Elements2 {
public:
    Elements2(Input& in, MeshIntake& intake) : in_(&in), intake_(&intake) {}

    void read() {
        const std::uint64_t count = in_->count_line("the number of elements");
        in_->check_count(count, 4, 2 * sizeof(std::int32_t), "elements");
        intake_->expect_elements(count);
        if constexpr (Input::has_lines) {
            for (std::uint64_t i = 0; i < count; ++i) {
                place_ = in_->begin_row("an element");
                (void)in_->number32("an element's number");
                const std::uint64_t type = in_->number32("an element's type");
                read_element(type, in_->number32("the number of tags"));
            }
        } else {
            for (std::uint64_t left = count; left > 0;) left -= read_block(left);
        }
    }

private:
    /// Of a binary file: elements of one type, with one number of tags.
    std::uint64_t read_block(std::uint64_t left) {
        const std::uint64_t begin = in_->begin_row("elements");
        const std::uint64_t type = in_->number32("the type of elements");
        const std::uint64_t count = in_->number32("the number of elements");
        const std::uint64_t tags = in_->number32("the number of tags");
        if (count == 0 || count > left) {
            in_->fail_at(fmt::format("{} elements, where {} are left of all", count, left), begin);
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            place_ = in_->begin_row("an element");
            (void)in_->integer("an element's number");
            read_element(type, tags);
        }
        return count;
    }

    void read_element(std::uint64_t type, std::uint64_t tags) {
        physical_ = elementary_ = 0;
        for (std::uint64_t k = 0; k < tags; ++k) {
            const std::int32_t tag = in_->integer("a tag");
            if (k == 0) physical_ = tag;
            if (k == 1) elementary_ = tag;
        }
        step_ = Input::row_step((1 + tags) * sizeof(std::int32_t));
        if (type == tetrahedron_type) return keep(cell_kind, last_cell_);
        if (type == triangle_type) return keep(facet_kind, last_facet_);
        if (type == line_type) return keep(edge_kind, last_edge_);
        if (const std::string refusal = MeshIntake::refusal(type); !refusal.empty()) {
            in_->fail_at(refusal, place_);
        }
        const ElementType known = *element_type(type);
        for (std::uint32_t k = 0; k < known.nodes; ++k) (void)in_->number32("a node's number");
        intake_->skip(known.shape, 1);
    }

    template <std::size_t N>
    struct Last {
        std::array<std::uint64_t, N> nodes{};
        std::int32_t physical = 0;
        std::int32_t elementary = 0;
    };

    template <class I, std::size_t N>
    void keep(const EntityKind<I, N>& kind, Last<N>& last) {
        std::array<std::uint64_t, N> nodes;
        for (std::uint64_t& node : nodes) node = in_->number32("a node's number");
        if (is_again(nodes, last)) return intake_->skip_in_another_group();
        const std::string_view wrong =
            intake_->take<I, N>(kind, nodes, physical_, place_,
                                step_ + (Input::has_lines ? 0 : N * sizeof(std::int32_t)));
        if (!wrong.empty()) in_->fail_at(wrong, place_);
        last = {nodes, physical_, elementary_};
    }

    /// An element of an entity that is in several groups is listed for each of them, its vertices
    /// turned round where the group has the entity reversed.
    template <std::size_t N>
    bool is_again(std::array<std::uint64_t, N> nodes, const Last<N>& last) const {
        if (physical_ == last.physical || elementary_ != last.elementary) return false;
        auto last_nodes = last.nodes;
        std::ranges::sort(nodes);
        std::ranges::sort(last_nodes);
        return nodes == last_nodes;
    }

    Input* in_;
    MeshIntake* intake_;
    // Of the element that is read:
    std::uint64_t place_ = 0;
    std::uint64_t step_ = 0;
    std::int32_t physical_ = 0;
    std::int32_t elementary_ = 0;
    // Of the one before:
    Last<4> last_cell_;
    Last<3> last_facet_;
    Last<2> last_edge_;
};

}  // namespace octetra::gmsh
