#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/repeated_cells.hpp>

#include "files/checks/cell_check.hpp"
#include "files/gmsh/element_types.hpp"
#include "files/gmsh/intake/group_names.hpp"
#include "files/gmsh/intake/ignored.hpp"
#include "files/gmsh/intake/node_numbers.hpp"
#include "files/gmsh/intake/node_tags.hpp"
#include "files/gmsh/intake/position_runs.hpp"
#include "files/input/growing_mesh.hpp"

namespace octetra::gmsh {

/// The number of elements of each kind.
struct ElementCounts {
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;

    friend bool operator==(const ElementCounts&, const ElementCounts&) = default;
};

/// The first erroneous row of a batch.
struct RowError {
    std::size_t row = 0;
    std::string_view what;  ///< empty if no row is erroneous
};

/// Builds a mesh, or a process's share of it, from the nodes and elements of a file of any version:
/// maps node tags to vertices, keeps the supported kinds of elements, counts the rest, and checks.
/// Errors in an entry are returned as text (empty for none), because only the caller knows its
/// position.
class MeshIntake {
public:
    /// `counts` is the number of elements of each kind, required if the mesh is streamed.
    MeshIntake(GrowingMesh& growing, const ReadOptions& options,
               const std::optional<ElementCounts>& counts);

    /// Reads the names of physical groups.
    template <class Input>
    void take_names(Input& in) {
        ignored_.names = read_group_names(in, growing_->mesh.group_names, untagged_);
    }

    /// `count`: the number of nodes of the file; `here`: of those that this process reads.
    void expect_nodes(std::uint64_t count, std::uint64_t here) {
        growing_->expect_points(count, 0, false, here);
    }
    /// Tags and points arrive in the same order, but not always alternately. `place` is the
    /// position of the tag.
    void take_tag(std::uint64_t tag, std::uint64_t place, std::uint64_t step) {
        nodes_.add(tag);
        node_positions_.add(place, step);
    }
    void take_point(const Point& point) {
        growing_->mesh.points.push_back(point);
        growing_->point_complete();
    }
    /// Collective. Calls fail(what, place) if a tag occurs twice; of a share, throws.
    void nodes_complete(auto&& fail) {
        growing_->points_complete();
        if (growing_->is_share()) {
            nodes_ = tags_.emplace(growing_->group(), nodes_).provisional();
            return;
        }
        if (const auto repeated = nodes_.complete()) {
            fail(describe(*repeated), node_positions_.of(repeated->node));
        }
    }

    void expect_elements(std::uint64_t count);
    /// Reserves memory for `count` more elements of a kind.
    template <class I, std::size_t N>
    void make_room(const EntityKind<I, N>& kind, std::uint64_t count);
    static constexpr std::size_t most_at_once = 128;
    /// Takes at most `most_at_once` elements of a supported kind, given by the tags of their nodes.
    /// `place` is the position of the first row; rows are `step` bytes or lines long.
    template <class I, std::size_t N>
    [[nodiscard]] RowError take(const EntityKind<I, N>& kind,
                                std::span<const std::array<std::uint64_t, N>> rows, Marker marker,
                                std::uint64_t place, std::uint64_t step);
    /// Count elements that are ignored: of other shapes, between partitions, or repeated for
    /// another group.
    void skip(Shape shape, std::uint64_t count) { ignored_.add(shape, count); }
    void skip_degenerate_line() { ++ignored_.degenerate_lines; }
    void skip_interface(std::uint64_t count) { ignored_.interfaces += count; }
    void skip_in_another_group() { ++ignored_.in_another_group; }
    void note_missing_entity(std::uint64_t count) { ignored_.of_missing_entities += count; }
    /// Removes the first `count` elements of a kind, which are repeated for another group.
    template <class I, std::size_t N>
    void remove_first(const EntityKind<I, N>& kind, std::uint64_t count);
    /// Collective.
    void elements_complete();

    /// Collective. Checks properties of the whole mesh; of a share, only that there are cells if
    /// there are other elements. Calls fail(what, place) for an error. `has_lines`:
    /// positions are line numbers, so messages may name further ones. `end_position` is the end of
    /// the file.
    using Fail = std::function<void(const std::string& what, std::uint64_t place)>;
    void check(bool has_lines, std::uint64_t end_position, const Fail& fail);
    /// Passes notes on ignored and modified entities to the options, for the file of this name.
    void add_notes(const std::string& path) const;

    [[nodiscard]] ElementCounts counts() const;

private:
    /// The elements of a kind read so far.
    struct Taken {
        std::uint64_t count = 0;
        PositionRuns places;
    };
    template <class I, std::size_t N>
    Taken& taken(const EntityKind<I, N>& /*kind*/) {
        return N == 4 ? cells_ : N == 3 ? facets_ : edges_;
    }
    [[nodiscard]] static std::string describe(const NodeNumbers::Repeated& repeated);
    template <std::size_t N>
    [[nodiscard]] RowError find_nodes(std::span<const std::array<std::uint64_t, N>> rows,
                                      std::span<std::array<VertexIndex, N>> found);
    [[nodiscard]] RowError check_entities(std::span<CellVertices> cells);
    [[nodiscard]] static RowError check_entities(std::span<const FacetVertices> facets);
    template <class I, std::size_t N>
    void append(const EntityKind<I, N>& kind, std::span<const std::array<VertexIndex, N>> vertices,
                Marker marker);
    template <class I, std::size_t N>
    void complete(const EntityKind<I, N>& kind);

    GrowingMesh* growing_;
    const ReadOptions* options_;
    std::optional<ElementCounts> expected_;
    NodeNumbers nodes_;             // of a share, once complete: provisional numbers
    std::optional<NodeTags> tags_;  // of a share
    PositionRuns node_positions_;
    Taken cells_;
    Taken facets_;
    Taken edges_;
    CellCheck cell_check_;
    std::optional<RepeatedCells> repeated_cells_;
    IgnoredContent ignored_;
    UntaggedGroups untagged_;
    std::string missing_;  // message about a missing node, referred to by the result of take()
};

}  // namespace octetra::gmsh
