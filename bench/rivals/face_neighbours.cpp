#include "rivals/face_neighbours.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <octetra/core/error.hpp>

namespace octetra::rivals {
namespace {

using Neighbours = IndexVector<CellIndex, std::array<CellIndex, 4>>;

/// The key of an edge whose lower vertex is a.
std::uint64_t key(VertexIndex a, VertexIndex b) {
    return std::uint64_t{a.value()} << 32U | b.value();
}

/// A face of a cell, in the bucket of its smallest vertex.
struct Face {
    std::uint64_t rest = 0;  // the key of the other vertices
    CellIndex cell;
    std::uint8_t position = 0;
};

std::array<VertexIndex, 3> sorted_face(const CellVertices& cell, std::size_t position) {
    const auto& [i, j, k] = cell_faces[position];
    std::array<VertexIndex, 3> face{cell[i], cell[j], cell[k]};
    std::ranges::sort(face);
    return face;
}

/// The faces of all cells, grouped by bucket, and the end of each bucket.
struct FaceBuckets {
    std::vector<Face> faces;
    IndexVector<VertexIndex, std::size_t> ends;

    explicit FaceBuckets(const Mesh& mesh)
        : faces(4 * mesh.cells.size()), ends(mesh.points.size(), 0) {
        for_each_face(mesh, [&](const auto& face, CellIndex, std::size_t) { ++ends[face[0]]; });
        std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), std::size_t{0});
        for_each_face(mesh, [&](const auto& face, CellIndex c, std::size_t position) {
            faces[ends[face[0]]++] = {key(face[1], face[2]), c,
                                      static_cast<std::uint8_t>(position)};
        });
    }

private:
    static void for_each_face(const Mesh& mesh, auto&& found) {
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) found(sorted_face(mesh.cells[c], k), c, k);
        }
    }
};

void join(const Face& f, const Face& g, Neighbours& neighbours) {
    neighbours[f.cell][f.position] = g.cell;
    neighbours[g.cell][g.position] = f.cell;
}

}  // namespace

Neighbours face_neighbours(const Mesh& mesh) {
    Neighbours neighbours(mesh.cells.size());
    FaceBuckets buckets(mesh);
    auto first = buckets.faces.begin();
    for (const std::size_t end_of_bucket : buckets.ends) {
        const auto end = buckets.faces.begin() + static_cast<std::ptrdiff_t>(end_of_bucket);
        std::sort(first, end, [](const Face& f, const Face& g) { return f.rest < g.rest; });
        while (first != end) {
            const auto second = first + 1;
            if (second == end || second->rest != first->rest) {
                first = second;
                continue;
            }
            join(*first, *second, neighbours);
            first = second + 1;
            if (first != end && first->rest == second->rest) {
                throw InputError("three cells have a face in common");
            }
        }
    }
    return neighbours;
}

}  // namespace octetra::rivals
