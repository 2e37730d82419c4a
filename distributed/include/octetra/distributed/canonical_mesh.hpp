#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// A distributed mesh whose vertices, cells, facets and tagged edges are numbered in the canonical
/// order, for writing to files. Every process still holds only its part.
class CanonicalMesh {
public:
    /// Collective. Takes the mesh over.
    explicit CanonicalMesh(DistributedMesh mesh);
    /// Collective. The same for a mesh that remains unchanged, and must as long as the result is
    /// used.
    [[nodiscard]] static CanonicalMesh of(const DistributedMesh& mesh);
    ~CanonicalMesh();
    CanonicalMesh(const CanonicalMesh&) = delete;
    CanonicalMesh& operator=(const CanonicalMesh&) = delete;
    CanonicalMesh(CanonicalMesh&&) noexcept;
    CanonicalMesh& operator=(CanonicalMesh&&) noexcept;

    /// Properties of the whole mesh; the same on all processes.
    [[nodiscard]] const MeshFacts& facts() const;

    /// Returns the whole mesh, in slices that the processes exchange: octetra::write_mesh and
    /// write_maps with it are collective, and no process ever holds more than its part and a few
    /// slices.
    [[nodiscard]] MeshSource& whole();

    struct Parts;

private:
    explicit CanonicalMesh(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
    friend std::string write_mesh(CanonicalMesh& mesh, const std::filesystem::path& path);
};

/// Collective. Writes one file, whose contents do not depend on the number of processes and the
/// partition, or for `.pvtu` also one piece for each process. Errors and result are those of
/// octetra::write_mesh.
[[nodiscard]] std::string write_mesh(CanonicalMesh& mesh, const std::filesystem::path& path);

}  // namespace octetra::distributed
