#include "level/marked_cells.hpp"

#include <algorithm>

#include <octetra/core/check_selection.hpp>

#include "level/incremental/adjacency.hpp"

namespace octetra::distributed {
namespace {

class Marking {
public:
    Marking(const DistributedMesh& mesh, const Selection& selection)
        : mesh_(&mesh),
          selection_(&selection),
          reach_(selection),
          is_geometric_(selection.cells.empty() && selection.regions.empty() && !selection.random &&
                        !selection.max_volume) {}

    void test_all() {
        const auto beyond = sides_beyond();
        const AncestorMap& ancestors = mesh_->cell_ancestors;
        for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
            for (CellIndex c{ancestors.first[r]}; c < CellIndex{ancestors.first[r + 1]}; ++c) {
                const auto& [v0, v1, v2, v3] = mesh_->cells[c];
                if (!is_geometric_ || (beyond[v0] & beyond[v1] & beyond[v2] & beyond[v3]) == 0) {
                    test(c, r);
                }
            }
        }
        marked_.tested = mesh_->cells.size();
    }

    void test_new(const Adjacency& adjacency) {
        for (const CellIndex c : adjacency.new_cells) {
            test(c, adjacency.cells.root_of(c));
        }
    }

    void test_blocks(const Adjacency& adjacency) {
        const auto& boxes = adjacency.blocks.boxes();
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            const CellIndex begin{b * CellBlocks::size};
            const CellIndex end{std::min((b + 1) * CellBlocks::size, mesh_->cells.size())};
            if (reach_.is_wholly_inside(boxes[b])) {
                for (CellIndex c = begin; c < end; ++c) marked_.cells.push_back(c);
            } else if (!is_geometric_ || may_be_reached(boxes[b])) {
                for (CellIndex c = begin; c < end; ++c) test(c, adjacency.cells.root_of(c));
            }
        }
    }

    [[nodiscard]] MarkedCells take() && {
        marked_.count = marked_.cells.size();
        return std::move(marked_);
    }

private:
    [[nodiscard]] Corners corners_of(CellIndex c) const {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh_->points[mesh_->cells[c][k]];
        return corners;
    }

    /// Returns the sides for all vertices, or nothing if the selection is not purely geometric.
    [[nodiscard]] IndexVector<VertexIndex, std::uint8_t> sides_beyond() const {
        IndexVector<VertexIndex, std::uint8_t> sides;
        if (!is_geometric_) return sides;
        sides.reserve(mesh_->points.size());
        for (const Point& p : mesh_->points) sides.push_back(reach_.sides_beyond(p));
        return sides;
    }

    [[nodiscard]] bool may_be_reached(const Box& box) const {
        return !reach_.is_out_of_reach(box) && may_be_marked(*selection_, box);
    }

    void test(CellIndex c, std::size_t root) {
        ++marked_.tested;
        const Corners corners = corners_of(c);
        const Box box = box_of(corners);
        if (is_geometric_ && reach_.is_out_of_reach(box)) return;
        if (reach_.is_wholly_inside(box)) {
            marked_.cells.push_back(c);
        } else {
            test_exactly(c, root, corners);
        }
    }

    void test_exactly(CellIndex c, std::size_t root, const Corners& corners) {
        const AncestorMap& ancestors = mesh_->cell_ancestors;
        const Marker region = ancestors.markers.empty() ? 0 : ancestors.markers[root];
        if (marks(*selection_, corners, region, GlobalCell{ancestors.roots[root]})) {
            marked_.cells.push_back(c);
        }
    }

    const DistributedMesh* mesh_;
    const Selection* selection_;
    SelectionBounds reach_;
    bool is_geometric_;
    MarkedCells marked_;
};

}  // namespace

MarkedCells mark_cells(const DistributedMesh& mesh, const Selection& selection, bool only_new) {
    check(selection);
    if (selection.all) return {.all = true, .count = mesh.cells.size(), .tested = 0};
    Marking marking(mesh, selection);
    if (mesh.adjacency == nullptr) {
        marking.test_all();
    } else if (only_new) {
        marking.test_new(*mesh.adjacency);
    } else {
        marking.test_blocks(*mesh.adjacency);
    }
    return std::move(marking).take();
}

}  // namespace octetra::distributed
