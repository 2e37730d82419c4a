#include <octetra/distributed/canonical_mesh.hpp>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/profile.hpp>

#include "output/canonical_slices.hpp"
#include "output/own_piece.hpp"

namespace octetra::distributed {

/// A single process that owns the mesh restores its canonical order in place; otherwise slices are
/// exchanged.
struct CanonicalMesh::Parts {
    DistributedMesh own;
    const DistributedMesh* mesh = &own;
    std::unique_ptr<CanonicalSlices> slices;
    Collected collected;
    std::unique_ptr<WholeMesh> whole;

    explicit Parts(DistributedMesh parts) {
        const Phase phase(parts.processes, "number vertices");
        if (parts.processes.size() == 1) {
            collected = collect(std::move(parts));
            whole = std::make_unique<WholeMesh>(collected.mesh, &collected.maps);
        } else {
            own = std::move(parts);
            restore_canonical_order(own);
            slices = std::make_unique<CanonicalSlices>(own);
        }
    }
    struct Borrowed {
        const DistributedMesh* mesh;
    };
    explicit Parts(Borrowed borrowed) : mesh(borrowed.mesh) {
        const Phase phase(mesh->processes, "number vertices");
        slices = std::make_unique<CanonicalSlices>(*mesh);
    }
};

namespace {

/// Collective. Returns make(), which numbers vertices, in a transaction.
auto numbered(const Communicator processes, auto&& make) {
    const Phase phase(processes, "number vertices");
    return processes.transaction(make);
}

}  // namespace

CanonicalMesh::CanonicalMesh(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
CanonicalMesh::CanonicalMesh(DistributedMesh mesh)
    : parts_(numbered(mesh.processes, [&] { return std::make_unique<Parts>(std::move(mesh)); })) {}
CanonicalMesh CanonicalMesh::of(const DistributedMesh& mesh) {
    return CanonicalMesh(
        numbered(mesh.processes, [&] { return std::make_unique<Parts>(Parts::Borrowed{&mesh}); }));
}
CanonicalMesh::~CanonicalMesh() = default;
CanonicalMesh::CanonicalMesh(CanonicalMesh&&) noexcept = default;
CanonicalMesh& CanonicalMesh::operator=(CanonicalMesh&&) noexcept = default;

const MeshFacts& CanonicalMesh::facts() const {
    return parts_->whole ? parts_->whole->facts() : parts_->slices->facts();
}

MeshSource& CanonicalMesh::whole() {
    if (parts_->whole) return *parts_->whole;
    return *parts_->slices;
}

std::string write_mesh(CanonicalMesh& mesh, const std::filesystem::path& path) {
    const CanonicalSlices* slices = mesh.parts_->slices.get();
    if (slices == nullptr) return octetra::write_mesh(mesh.whole(), path);
    return slices->group().transaction([&] {
        if (!is_in_pieces(path)) return octetra::write_mesh(mesh.whole(), path);
        OwnPiece piece(*mesh.parts_->mesh, slices->lists(), slices->numbers(), slices->facts());
        return write_pieces(piece, slices->group(), path);
    });
}

}  // namespace octetra::distributed
