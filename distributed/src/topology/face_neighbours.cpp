#include "topology/face_neighbours.hpp"

#include <algorithm>

#include "partition/inner_faces.hpp"

namespace octetra::distributed {
namespace {

/// Returns the position of the vertex of a cell that the face does not have.
std::size_t opposite(const CellVertices& cell, const FacetVertices& face) {
    for (std::size_t i = 0; i < 4; ++i) {
        if (std::ranges::find(face, cell[i]) == face.end()) return i;
    }
    return 0;
}

FaceNeighbours inner_neighbours(const DistributedMesh& mesh) {
    FaceNeighbours neighbours(mesh.cells.size());
    const int rank = mesh.processes.rank();
    for_each_inner_face(mesh, [&](const FacetVertices& face, CellIndex a, CellIndex b) {
        neighbours[a][opposite(mesh.cells[a], face)] = {rank, b};
        neighbours[b][opposite(mesh.cells[b], face)] = {rank, a};
    });
    return neighbours;
}

/// The faces that only one cell of this process has, searchable by their vertices.
class OuterFaces {
public:
    OuterFaces(const DistributedMesh& mesh, const FaceNeighbours& neighbours) {
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            for (std::uint8_t f = 0; f < 4; ++f) {
                if (!neighbours[c][f].is_boundary()) continue;
                const auto [i, j, k] = cell_faces[f];
                const CellVertices& cell = mesh.cells[c];
                faces_.emplace_back(sorted({cell[i], cell[j], cell[k]}), BoundaryFace{c, f});
            }
        }
        std::ranges::sort(faces_, {}, &Entry::first);
    }
    [[nodiscard]] const BoundaryFace& find(const FacetVertices& face) const {
        return std::ranges::lower_bound(faces_, sorted(face), {}, &Entry::first)->second;
    }

private:
    using Entry = std::pair<FacetVertices, BoundaryFace>;
    static FacetVertices sorted(FacetVertices face) {
        std::ranges::sort(face);
        return face;
    }
    std::vector<Entry> faces_;
};

}  // namespace

FaceNeighbours find_face_neighbours(const DistributedMesh& mesh) {
    FaceNeighbours neighbours = inner_neighbours(mesh);
    std::vector<int> ranks;
    std::vector<std::vector<BoundaryFace>> shared;
    std::vector<std::vector<CellIndex>> cells;
    if (!mesh.interfaces.empty()) {
        const OuterFaces outer(mesh, neighbours);
        for (const Interface& interface : mesh.interfaces) {
            ranks.push_back(interface.rank);
            auto& faces = shared.emplace_back();
            auto& outbox = cells.emplace_back();
            for (const FacetVertices& face : interface.faces) {
                faces.push_back(outer.find(face));
                outbox.push_back(faces.back().cell);
            }
        }
    }
    cells = mesh.processes.exchange_with(ranks, cells);
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        for (std::size_t k = 0; k < cells[i].size(); ++k) {
            const auto& [cell, face] = shared[i][k];
            neighbours[cell][face] = {ranks[i], cells[i][k]};
        }
    }
    return neighbours;
}

std::vector<BoundaryFace> find_boundary(const DistributedMesh& mesh) {
    FaceNeighbours neighbours = inner_neighbours(mesh);
    if (!mesh.interfaces.empty()) {
        const OuterFaces outer(mesh, neighbours);
        for (const Interface& interface : mesh.interfaces) {
            for (const FacetVertices& face : interface.faces) {
                const auto [cell, f] = outer.find(face);
                neighbours[cell][f].rank = interface.rank;
            }
        }
    }
    std::vector<BoundaryFace> boundary;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::uint8_t f = 0; f < 4; ++f) {
            if (neighbours[c][f].is_boundary()) boundary.push_back({c, f});
        }
    }
    return boundary;
}

}  // namespace octetra::distributed
