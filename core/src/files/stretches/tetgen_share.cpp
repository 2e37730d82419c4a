#include <array>
#include <string_view>

#include <octetra/core/huge_pages.hpp>

#include "files/input/fields.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/input/line_reader.hpp"
#include "files/stretches/readers.hpp"
#include "files/stretches/shares.hpp"
#include "files/stretches/status.hpp"
#include "files/tetgen/lines.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;
using namespace tetgen;

/// The entries of a file, after its header.
struct Body {
    FileRange bytes;
    std::uint32_t is_there = 0;
    std::uint32_t has_adjacent_cells = 0;  ///< for facets and edges
};

/// The facts that the first process reads at the beginning of each file.
struct TetgenPlan {
    NodeHead node;
    EleHead ele;
    ListHead face;
    ListHead edge;
    Body points;
    Body cells;
    Body facets;
    Body edges;
    std::uint64_t index_base = 0;
};

Body body_behind_head(const LineReader& reader) {
    return {{reader.next_position(), reader.file_size()}, 1, 0};
}

/// Reads the header of a `.face` or `.edge` file, if there is one.
template <std::size_t N>
ListHead plan_list(const fs::path& path, Body& body) {
    if (!is_there(path)) return {};
    LineReader reader(path);
    const ListHead head = read_list_head(reader, N);
    body = body_behind_head(reader);
    if (head.count == 0 || !reader.next()) return head;
    Fields fields(reader);
    for (std::size_t k = 0; k < 1 + N + head.markers; ++k) (void)fields.text();
    body.has_adjacent_cells = ends_with_adjacent_cells<N>(fields, head) ? 1 : 0;
    return head;
}

TetgenPlan tetgen_plan(const fs::path& path) {
    TetgenPlan plan;
    LineReader node(companion(path, ".node"));
    plan.node = read_node_head(node);
    plan.points = body_behind_head(node);
    if (plan.node.count > 0 && node.next()) {
        plan.index_base = Fields(node).unsigned_integer("the entry's number") == 1 ? 1 : 0;
    }
    LineReader ele(companion(path, ".ele"));
    plan.ele = read_ele_head(ele);
    plan.cells = body_behind_head(ele);
    plan.face = plan_list<3>(companion(path, ".face"), plan.facets);
    plan.edge = plan_list<2>(companion(path, ".edge"), plan.edges);
    return plan;
}

/// Reads this process's share of a file's entries by read_entry(fields, reader); each entry has
/// `field_count` fields. Entry numbers must be consecutive. Returns the first one, if there is any.
std::optional<std::uint64_t> read_share(const fs::path& path, const FileRange& share,
                                        std::size_t field_count, auto&& read_entry) {
    LineReader reader(path, share.begin, share.end);
    std::optional<std::uint64_t> first;
    for (std::uint64_t i = 0; reader.next(); ++i) {
        Fields fields(reader);
        const std::uint64_t number = fields.unsigned_integer("the entry's number");
        if (!first) first = number;
        if (number != *first + i) reader.fail("the numbers do not follow each other");
        read_entry(fields, reader);
        fields.expect_end(field_count);
    }
    return first;
}

/// Reads this process's share of each file.
class TetgenShares {
public:
    TetgenShares(const fs::path& path, const TetgenPlan& plan, const ProcessGroup& group)
        : path_(&path), plan_(&plan), group_(&group) {}

    void read(Mesh& lists) {
        read_points(lists);
        read_cells(lists);
        read_list("face", ".face", facet_kind, plan_->face, plan_->facets, lists, facets_);
        read_list("edge", ".edge", edge_kind, plan_->edge, plan_->edges, lists, edges_);
    }

    /// Collective. Returns false on all processes if the number of entries differs from the
    /// announced one, or if they are not in order.
    [[nodiscard]] bool number(MeshShare& mesh_share) const {
        bool are_consistent = true;
        const auto number = [&](std::size_t read, std::uint64_t announced,
                                std::optional<std::uint64_t> found) {
            const std::uint64_t first = number_share(*group_, read, announced, are_consistent);
            if (found && *found != first + plan_->index_base) are_consistent = false;
            return first;
        };
        const Mesh& lists = mesh_share.lists;
        mesh_share.first_vertex = number(lists.points.size(), plan_->node.count, points_);
        mesh_share.first_cell = number(lists.cells.size(), plan_->ele.count, cells_);
        mesh_share.first_facet = number(lists.facets.size(), plan_->face.count, facets_);
        mesh_share.first_edge = number(lists.edges.size(), plan_->edge.count, edges_);
        return group_->sum(are_consistent ? 0 : 1) == 0;
    }

private:
    using FirstNumber = std::optional<std::uint64_t>;

    [[nodiscard]] FileRange share_of(const fs::path& file, const Body& body) const {
        return share_of_lines(file, body.bytes, group_->rank(), group_->size());
    }
    [[nodiscard]] NumberedVertices numbers() const {
        return {plan_->index_base, plan_->node.count};
    }

    void read_points(Mesh& lists) {
        const fs::path file = companion(*path_, ".node");
        const NodeHead& head = plan_->node;
        const FileRange share = share_of(file, plan_->points);
        const std::size_t room = room_for(head.count, share.size(), plan_->points.bytes.size());
        lists.attributes_per_point = head.attributes;
        reserve_in_huge_pages(lists.points, room);
        reserve_in_huge_pages(lists.point_attributes, room * head.attributes);
        reserve_in_huge_pages(lists.point_markers, room * head.markers);
        points_ = read_share(file, share, head.field_count(),
                             [&](Fields& fields, auto&) { read_point(fields, head, lists); });
    }

    void read_cells(Mesh& lists) {
        const fs::path file = companion(*path_, ".ele");
        const EleHead& head = plan_->ele;
        const FileRange share = share_of(file, plan_->cells);
        const std::size_t room = room_for(head.count, share.size(), plan_->cells.bytes.size());
        reserve_in_huge_pages(lists.cells, room);
        reserve_in_huge_pages(lists.regions, room * head.attributes);
        const auto read_cell = [&](Fields& fields, const LineReader& reader) {
            const CellVertices cell = read_vertices<4>(fields, reader, numbers());
            for (const auto& [i, j] : cell_edges) {
                if (cell[i] == cell[j]) reader.fail("the cell has the same vertex twice");
            }
            lists.cells.push_back(cell);
            read_region(fields, head, lists);
        };
        cells_ = read_share(file, share, head.field_count(), read_cell);
    }

    template <class I, std::size_t N>
    void read_list(std::string_view name, std::string_view extension, const EntityKind<I, N>& kind,
                   const ListHead& head, const Body& body, Mesh& lists, FirstNumber& first) {
        if (body.is_there == 0) return;
        const fs::path file = companion(*path_, extension);
        const FileRange share = share_of(file, body);
        const std::size_t room = room_for(head.count, share.size(), body.bytes.size());
        reserve_in_huge_pages(lists.*kind.list, room);
        reserve_in_huge_pages(lists.*kind.markers, room * head.markers);
        const bool has_adjacent_cells = body.has_adjacent_cells == 1;
        first = read_share(
            file, share, 1 + N + head.markers, [&](Fields& fields, const LineReader& reader) {
                read_tagged(fields, reader, name, kind, head, numbers(), false, lists);
                if (has_adjacent_cells) skip_adjacent_cells<N>(fields);
            });
    }

    const fs::path* path_;
    const TetgenPlan* plan_;
    const ProcessGroup* group_;
    FirstNumber points_;
    FirstNumber cells_;
    FirstNumber facets_;
    FirstNumber edges_;
};

MeshFacts facts_of(const TetgenPlan& plan) {
    MeshFacts facts;
    facts.vertices = plan.node.count;
    facts.cells = plan.ele.count;
    facts.facets = plan.face.count;
    facts.edges = plan.edge.count;
    facts.attributes_per_point = plan.node.attributes;
    facts.index_base = static_cast<std::uint32_t>(plan.index_base);
    facts.first_midpoint = facts.vertices;
    facts.has_point_markers = plan.node.markers * plan.node.count > 0;
    facts.has_regions = plan.ele.attributes * plan.ele.count > 0;
    facts.has_facet_markers = plan.face.markers * plan.face.count > 0;
    facts.has_edge_markers = plan.edge.markers * plan.edge.count > 0;
    return facts;
}

}  // namespace

std::optional<MeshShare> read_tetgen_share(const fs::path& path, const ProcessGroup& group) {
    CollectiveStatus status(group);
    TetgenPlan plan;
    status.attempt([&] {
        if (group.is_first()) plan = tetgen_plan(path);
    });
    if (!broadcast_from_first(status, plan)) return std::nullopt;

    MeshShare mesh_share;
    mesh_share.facts = facts_of(plan);
    mesh_share.lists.index_base = mesh_share.facts.index_base;
    TetgenShares shares(path, plan, group);
    status.attempt([&] {
        shares.read(mesh_share.lists);
        const auto note_on = [&](std::string_view name, const Body& body) {
            if (body.has_adjacent_cells == 0) return;
            const fs::path file = companion(path, fmt::format(".{}", name));
            mesh_share.notes.push_back(note_on_adjacent_cells(file, name));
        };
        note_on("face", plan.facets);
        note_on("edge", plan.edges);
    });
    if (!status.all_succeeded() || !shares.number(mesh_share)) return std::nullopt;
    return mesh_share;
}

}  // namespace octetra
