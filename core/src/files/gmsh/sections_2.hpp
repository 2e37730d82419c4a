#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "files/gmsh/element_types.hpp"
#include "files/gmsh/wrong_row.hpp"
#include "files/input/growing_mesh.hpp"

/// The sections of versions 2 to 2.2, text and binary. An Input is a TextInput or has its
/// functions; an Intake is a MeshIntake, or has.
namespace octetra::gmsh {

inline constexpr std::size_t node_bytes_2 = sizeof(std::int32_t) + 3 * sizeof(double);

template <class Input>
std::uint64_t read_node_count_2(Input& in) {
    const std::uint64_t count = in.count_line("the number of nodes");
    in.check_count(count, 4, node_bytes_2, "nodes");
    return count;
}

template <class Input, class Intake>
void read_node_rows_2(Input& in, std::uint64_t count, Intake& intake) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t place = in.begin_row("a node");
        intake.take_tag(in.number32("a node's number"), place, Input::row_step(node_bytes_2));
        const double x = in.coordinate("x");
        const double y = in.coordinate("y");
        intake.take_point({x, y, in.coordinate("z")});
    }
}

template <class Input, class Intake>
void read_nodes_2(Input& in, Intake& intake) {
    const std::uint64_t count = read_node_count_2(in);
    intake.expect_nodes(count);
    read_node_rows_2(in, count, intake);
}

/// Of a binary file: elements of one type, with one number of tags.
struct ElementBlock2 {
    std::uint64_t type = 0;
    std::uint64_t count = 0;
    std::uint64_t tags = 0;
};

/// `left`: elements of which no block has come.
template <class Input>
ElementBlock2 read_element_block_2(Input& in, std::uint64_t left) {
    const std::uint64_t begin = in.begin_row("elements");
    ElementBlock2 block;
    block.type = in.number32("the type of elements");
    block.count = in.number32("the number of elements");
    block.tags = in.number32("the number of tags");
    if (block.count == 0 || block.count > left) {
        in.fail_at(fmt::format("{} elements, where {} are left of all", block.count, left), begin);
    }
    return block;
}

template <class Input>
std::uint64_t read_element_count_2(Input& in) {
    const std::uint64_t count = in.count_line("the number of elements");
    in.check_count(count, 4, 2 * sizeof(std::int32_t), "elements");
    return count;
}

/// Of elements of a kind that are kept, what is needed to know one that is listed again.
template <std::size_t N>
struct ListedElement {
    std::array<std::uint64_t, N> nodes{};
    std::int32_t physical = 0;
    std::int32_t elementary = 0;
    bool is_there = false;
};

/// Do both mean the same element of the same entity? Its vertices are turned round where a group
/// has the entity reversed.
template <std::size_t N>
bool is_same_element(const ListedElement<N>& a, const ListedElement<N>& b) {
    if (!a.is_there || !b.is_there || a.elementary != b.elementary) return false;
    auto nodes = a.nodes;
    auto other_nodes = b.nodes;
    std::ranges::sort(nodes);
    std::ranges::sort(other_nodes);
    return nodes == other_nodes;
}

/// What of the elements of a kind tells whether those before or behind are listed again.
template <std::size_t N>
struct ListedRun {
    ListedElement<N> first;    ///< that is kept
    ListedElement<N> last;     ///< that is kept
    std::uint64_t kept = 0;    ///< of all
    std::uint64_t alike = 0;   ///< kept ones at the beginning that are the same element
    std::uint64_t others = 0;  ///< of these, listed in other groups and not kept
    std::array<std::int32_t, 6> groups_of_others{};  ///< as many as there is room for

    void keep(const ListedElement<N>& one) {
        if (kept == 0) first = one;
        if (kept == alike && is_same_element(one, first)) ++alike;
        ++kept;
        last = one;
    }
    void leave_out(std::int32_t group) {
        if (kept != alike) return;
        if (others < groups_of_others.size()) groups_of_others[others] = group;
        ++others;
    }
};

/// Reads the elements of version 2: each has its physical group first among its tags, then its
/// entity. An element of an entity that is in several groups is listed for each of them.
template <class Input, class Intake>
class Elements2 {
public:
    Elements2(Input& in, Intake& intake) : in_(&in), intake_(&intake) {}

    void read() {
        const std::uint64_t count = read_element_count_2(*in_);
        intake_->expect_elements(count);
        if constexpr (Input::has_lines) {
            read_lines(count);
        } else {
            for (std::uint64_t left = count; left > 0;) {
                const ElementBlock2 block = read_element_block_2(*in_, left);
                read_rows(block, block.count);
                left -= block.count;
            }
        }
    }

    /// So many elements of a text file.
    void read_lines(std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            place_ = in_->begin_row("an element");
            (void)in_->number32("an element's number");
            const std::uint64_t type = in_->number32("an element's type");
            read_element(type, in_->number32("the number of tags"));
        }
    }
    /// So many of a block of a binary file.
    void read_rows(const ElementBlock2& block, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            place_ = in_->begin_row("an element");
            (void)in_->integer("an element's number");
            read_element(block.type, block.tags);
        }
    }

    [[nodiscard]] const ListedRun<4>& listed(const EntityKind<CellIndex, 4>& /*kind*/) const {
        return cells_;
    }
    [[nodiscard]] const ListedRun<3>& listed(const EntityKind<FacetIndex, 3>& /*kind*/) const {
        return facets_;
    }
    [[nodiscard]] const ListedRun<2>& listed(const EntityKind<EdgeIndex, 2>& /*kind*/) const {
        return edges_;
    }

private:
    void read_element(std::uint64_t type, std::uint64_t tags) {
        physical_ = elementary_ = 0;
        for (std::uint64_t k = 0; k < tags; ++k) {
            const std::int32_t tag = in_->integer("a tag");
            if (k == 0) physical_ = tag;
            if (k == 1) elementary_ = tag;
        }
        step_ = Input::row_step((1 + tags) * sizeof(std::int32_t));
        if (type == tetrahedron_type) return keep(cell_kind, cells_);
        if (type == triangle_type) return keep(facet_kind, facets_);
        if (type == line_type) return keep(edge_kind, edges_);
        if (const std::string refusal = refusal_of_type(type); !refusal.empty()) {
            in_->fail_at(refusal, place_);
        }
        const ElementType known = *element_type(type);
        for (std::uint32_t k = 0; k < known.nodes; ++k) (void)in_->number32("a node's number");
        intake_->skip(known.shape, 1);
    }

    template <class I, std::size_t N>
    void keep(const EntityKind<I, N>& kind, ListedRun<N>& run) {
        ListedElement<N> one{{}, physical_, elementary_, true};
        for (std::uint64_t& node : one.nodes) node = in_->number32("a node's number");
        if (physical_ != run.last.physical && is_same_element(one, run.last)) {
            run.leave_out(physical_);
            return intake_->skip_in_another_group();
        }
        const std::uint64_t step = step_ + (Input::has_lines ? 0 : N * sizeof(std::int32_t));
        const WrongRow wrong =
            intake_->take(kind, std::span<const std::array<std::uint64_t, N>>(&one.nodes, 1),
                          physical_, place_, step);
        if (!wrong.what.empty()) in_->fail_at(wrong.what, place_);
        run.keep(one);
    }

    Input* in_;
    Intake* intake_;
    // Of the element that is read:
    std::uint64_t place_ = 0;
    std::uint64_t step_ = 0;
    std::int32_t physical_ = 0;
    std::int32_t elementary_ = 0;
    ListedRun<4> cells_;
    ListedRun<3> facets_;
    ListedRun<2> edges_;
};

}  // namespace octetra::gmsh
