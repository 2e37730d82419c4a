#include "chosen_cells.hpp"

#include <algorithm>

#include "adjacency.hpp"

namespace octetra::distributed {
namespace {

class Choice {
public:
    Choice(const DistributedMesh& mesh, const Selection& selection)
        : mesh_(&mesh),
          selection_(&selection),
          by_place_only_(selection.cells.empty() && selection.regions.empty() &&
                         !selection.random && !selection.max_volume) {}

    void judge(CellIndex c, std::size_t root) {
        ++chosen_.judged;
        const Lineage& lineage = mesh_->cell_lineage;
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh_->points[mesh_->cells[c][k]];
        // Most cells are far away, which is found sooner than their centroids.
        if (by_place_only_ && !may_be_chosen(*selection_, box_of(corners))) return;
        const Marker region = lineage.markers.empty() ? 0 : lineage.markers[root];
        if (chooses(*selection_, corners, region, GlobalCell{lineage.roots[root]})) {
            chosen_.cells.push_back(c);
        }
    }

    void judge_all() {
        const Lineage& lineage = mesh_->cell_lineage;
        for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
            for (CellIndex c{lineage.first[r]}; c < CellIndex{lineage.first[r + 1]}; ++c) {
                judge(c, r);
            }
        }
    }

    void judge_new(const Adjacency& adjacency) {
        for (const CellIndex c : adjacency.new_cells) {
            judge(c, adjacency.cells.root_of(c, mesh_->cell_lineage));
        }
    }

    void judge_blocks(const Adjacency& adjacency) {
        const auto& boxes = adjacency.blocks.boxes();
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            if (by_place_only_ && !may_be_chosen(*selection_, boxes[b])) continue;
            const std::size_t begin = b * CellBlocks::size;
            const std::size_t end = std::min(begin + CellBlocks::size, mesh_->cells.size());
            adjacency.cells.for_each_root(CellIndex{begin}, CellIndex{end}, mesh_->cell_lineage,
                                          [&](CellIndex c, std::size_t root) { judge(c, root); });
        }
    }

    [[nodiscard]] ChosenCells take() && {
        chosen_.count = chosen_.cells.size();
        return std::move(chosen_);
    }

private:
    const DistributedMesh* mesh_;
    const Selection* selection_;
    bool by_place_only_;
    ChosenCells chosen_;
};

}  // namespace

ChosenCells choose_cells(const DistributedMesh& mesh, const Selection& selection, bool only_new) {
    if (selection.all) return {.all = true, .count = mesh.cells.size(), .judged = 0};
    Choice choice(mesh, selection);
    if (mesh.adjacency == nullptr) {
        choice.judge_all();
    } else if (only_new) {
        choice.judge_new(*mesh.adjacency);
    } else {
        choice.judge_blocks(*mesh.adjacency);
    }
    return std::move(choice).take();
}

}  // namespace octetra::distributed
