#include "output/write_mesh.hpp"

#include <optional>

#include <octetra/distributed/profile.hpp>

#include "comm/local_failure.hpp"
#include "output/canonical_slices.hpp"
#include "output/check_fields.hpp"
#include "output/own_piece.hpp"

namespace octetra::distributed {
namespace {

/// Collective.
void check_fields(const DistributedMesh& mesh, std::span<const Field> fields) {
    LocalFailure failure;
    failure.attempt([&] { check_sizes(mesh, fields); });
    failure.agree(mesh.processes);
    check_same(mesh.processes, fields);
}

}  // namespace

std::string write_mesh(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                       const Sharing<VertexIndex>& sharing, std::span<const Field> fields,
                       const std::filesystem::path& path, const WriteOptions& options) {
    check_fields(mesh, fields);
    std::optional<CanonicalSlices> slices;
    in_phase(mesh.processes, "number vertices", [&] { slices.emplace(mesh, &numbers); });
    if (!is_in_pieces(path)) {
        slices->add(fields, sharing);
        return octetra::write_mesh(*slices, path, options);
    }
    OwnPiece piece(mesh, slices->lists(), slices->numbers(), slices->facts());
    piece.add(fields, sharing);
    return write_pieces(piece, mesh.processes, path);
}

void append_mesh(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                 const Sharing<VertexIndex>& sharing, std::span<const Field> fields,
                 MeshSeries& series, double time) {
    check_fields(mesh, fields);
    std::optional<CanonicalSlices> slices;
    in_phase(mesh.processes, "number vertices", [&] { slices.emplace(mesh, &numbers); });
    slices->add(fields, sharing);
    series.append(*slices, time);
}

}  // namespace octetra::distributed
