#include "output/write_mesh.hpp"

#include <optional>

#include <octetra/distributed/profile.hpp>

#include "comm/local_failure.hpp"
#include "output/canonical_slices.hpp"
#include "output/check_fields.hpp"
#include "output/own_piece.hpp"

namespace octetra::distributed {

std::string write_mesh(const DistributedMesh& mesh, const Sharing<VertexIndex>& sharing,
                       std::span<const Field> fields, const std::filesystem::path& path,
                       const WriteOptions& options) {
    LocalFailure failure;
    failure.attempt([&] { check_sizes(mesh, fields); });
    failure.agree(mesh.processes);
    check_same(mesh.processes, fields);
    std::optional<CanonicalSlices> slices;
    in_phase(mesh.processes, "number vertices", [&] { slices.emplace(mesh); });
    if (!is_in_pieces(path)) {
        slices->add(fields, sharing);
        return octetra::write_mesh(*slices, path, options);
    }
    OwnPiece piece(mesh, slices->lists(), slices->numbers(), slices->facts());
    piece.add(fields, sharing);
    return write_pieces(piece, mesh.processes, path);
}

}  // namespace octetra::distributed
