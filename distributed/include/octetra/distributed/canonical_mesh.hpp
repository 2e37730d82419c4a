#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// A distributed mesh whose vertices, cells, facets and tagged edges are numbered in the canonical
/// order: what is written to files. Every process still holds only its part.
class CanonicalMesh {
public:
    /// Collective.
    explicit CanonicalMesh(DistributedMesh mesh);
    /// The same, of a mesh that stays as it is, and must as long as this is used.
    [[nodiscard]] static CanonicalMesh of(const DistributedMesh& mesh);
    ~CanonicalMesh();
    CanonicalMesh(const CanonicalMesh&) = delete;
    CanonicalMesh& operator=(const CanonicalMesh&) = delete;
    CanonicalMesh(CanonicalMesh&&) noexcept;
    CanonicalMesh& operator=(CanonicalMesh&&) noexcept;

    /// The same on all processes.
    [[nodiscard]] const MeshFacts& facts() const;

    /// The whole mesh, in slices that its processes exchange: octetra::write_mesh and write_maps
    /// with it are collective, and no process ever holds more than its part and a few slices.
    [[nodiscard]] MeshSource& whole();

    struct Parts;

private:
    explicit CanonicalMesh(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
    friend std::string write_mesh(CanonicalMesh& mesh, const std::filesystem::path& path);
};

/// Collective. Writes one file, the same whatever the number of processes and the partition, or, of
/// a `.pvtu`, each process's part as a piece. Errors and result as octetra::write_mesh.
[[nodiscard]] std::string write_mesh(CanonicalMesh& mesh, const std::filesystem::path& path);

}  // namespace octetra::distributed
