#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "level/incremental/incremental_level.hpp"

namespace octetra::distributed {

/// Has the entities that the level replaces until it is kept.
class IncrementalLevel::MadeLevel final : public MadeChange {
public:
    /// Reads the entities that the level is going to replace.
    explicit MadeLevel(const IncrementalLevel& level)
        : mesh_(level.mesh_),
          adjacency_(level.adjacency_),
          cell_count_(mesh_->cells.size()),
          facet_count_(mesh_->facets.size()),
          tagged_edge_count_(mesh_->edges.size()) {
        for (const auto& note : level.closure_.notes()) {
            cells_.push_back(adjacency_->cells.entry_of(note.cell, mesh_->cells));
        }
        for (const auto& [facet, midpoints] : level.cut_facets_) {
            facets_.push_back(adjacency_->facets.entry_of(facet, mesh_->facets));
        }
        for (const auto& [edge, midpoint] : level.cut_tagged_edges_) {
            tagged_edges_.push_back(adjacency_->edges.entry_of(edge, mesh_->edges));
        }
        for (const CutSharedEdge& cut : level.cut_shared_edges_) {
            const auto& [interface, position] = cut.place;
            shared_edges_.push_back({cut.place, mesh_->interfaces[interface].edges[position]});
        }
        for (const auto& [face, midpoints] : level.cut_shared_faces_) {
            const auto& [interface, position] = face.place;
            shared_faces_.push_back({face.place, mesh_->interfaces[interface].faces[position]});
        }
        for (const Interface& interface : mesh_->interfaces) {
            shared_counts_.push_back({interface.edges.size(), interface.faces.size()});
        }
    }
    ~MadeLevel() override {
        if (appended_ == nullptr) return;
        adjacency_->drop_index();
        adjacency_->cells.restore(cells_, cell_count_, mesh_->cells);
        adjacency_->facets.restore(facets_, facet_count_, mesh_->facets);
        adjacency_->edges.restore(tagged_edges_, tagged_edge_count_, mesh_->edges);
        adjacency_->blocks.truncate(cell_count_);
        adjacency_->cell_to_note.resize(cell_count_);
        adjacency_->new_cells.swap(new_cells_);
        restore_interfaces();
    }
    MadeLevel(const MadeLevel&) = delete;
    MadeLevel& operator=(const MadeLevel&) = delete;
    MadeLevel(MadeLevel&&) = delete;
    MadeLevel& operator=(MadeLevel&&) = delete;

    void make(IncrementalLevel& level) noexcept {
        new_cells_.swap(adjacency_->new_cells);
        appended_ = std::move(level.appended_);
        level.change_lists();
    }
    void keep() noexcept override {
        appended_->keep();
        appended_.reset();
    }

private:
    template <class Vertices>
    struct SharedBefore {
        SharedPosition place;
        Vertices vertices;
    };
    struct SharedCounts {
        std::size_t edges = 0;
        std::size_t faces = 0;
    };

    void restore_interfaces() noexcept {
        for (const auto& [place, vertices] : shared_edges_) {
            mesh_->interfaces[place.interface].edges[place.position] = vertices;
        }
        for (const auto& [place, vertices] : shared_faces_) {
            mesh_->interfaces[place.interface].faces[place.position] = vertices;
        }
        for (std::size_t i = 0; i < shared_counts_.size(); ++i) {
            mesh_->interfaces[i].edges.resize(shared_counts_[i].edges);
            mesh_->interfaces[i].faces.resize(shared_counts_[i].faces);
        }
    }

    DistributedMesh* mesh_;
    Adjacency* adjacency_;
    std::unique_ptr<AppendedMidpoints> appended_;
    std::size_t cell_count_;
    std::size_t facet_count_;
    std::size_t tagged_edge_count_;
    std::vector<SharedCounts> shared_counts_;  ///< by interface
    std::vector<decltype(Adjacency::cells)::Entry> cells_;
    std::vector<decltype(Adjacency::facets)::Entry> facets_;
    std::vector<decltype(Adjacency::edges)::Entry> tagged_edges_;
    std::vector<SharedBefore<EdgeVertices>> shared_edges_;
    std::vector<SharedBefore<FacetVertices>> shared_faces_;
    std::vector<CellIndex> new_cells_;
};

std::unique_ptr<MadeChange> IncrementalLevel::commit_reversibly() {
    auto made = std::make_unique<MadeLevel>(*this);
    made->make(*this);
    return made;
}

}  // namespace octetra::distributed
