#include "output/write_mesh.hpp"

#include <octetra/distributed/profile.hpp>

#include "output/canonical_slices.hpp"
#include "output/check_fields.hpp"
#include "output/own_piece.hpp"

namespace octetra::distributed {
namespace {

/// Collective, within a transaction. Checks the fields and numbers the vertices.
CanonicalSlices slices_for(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                           std::span<const Field> fields) {
    check_sizes(mesh, fields);
    check_same(mesh.processes, fields);
    const Phase phase(mesh.processes, "number vertices");
    return CanonicalSlices(mesh, &numbers);
}

}  // namespace

std::string write_mesh(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                       const Sharing<VertexIndex>& sharing, std::span<const Field> fields,
                       const std::filesystem::path& path, const WriteOptions& options) {
    return mesh.processes.transaction([&] {
        CanonicalSlices slices = slices_for(mesh, numbers, fields);
        if (!is_in_pieces(path)) {
            slices.add(fields, sharing);
            return octetra::write_mesh(slices, path, options);
        }
        OwnPiece piece(mesh, slices.lists(), slices.numbers(), slices.facts());
        piece.add(fields, sharing);
        return write_pieces(piece, mesh.processes, path);
    });
}

void append_mesh(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                 const Sharing<VertexIndex>& sharing, std::span<const Field> fields,
                 MeshSeries& series, double time) {
    mesh.processes.transaction([&] {
        CanonicalSlices slices = slices_for(mesh, numbers, fields);
        slices.add(fields, sharing);
        series.append(slices, time);
    });
}

}  // namespace octetra::distributed
