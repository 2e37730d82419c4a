#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra {

/// A `.vtkhdf` file, version 2.0, with a sequence of meshes, each at a time value. The meshes may
/// have different cells. All functions are collective in the group to which the meshes belong, and
/// throw SystemError on all processes if writing fails.
///
/// Appended data is written immediately to temporary files next to the final path and assembled by
/// commit(), which temporarily needs twice the disk space. Memory: a few slices, independent of the
/// amount of data. The bytes do not depend on the number of processes. Destruction before commit()
/// removes all temporary files.
class MeshSeries {
public:
    /// Throws InputError if the extension is not `.vtkhdf` or the file cannot be written there. The
    /// group must outlive the object.
    MeshSeries(const std::filesystem::path& path, const ProcessGroup& group);
    ~MeshSeries();
    MeshSeries(const MeshSeries&) = delete;
    MeshSeries& operator=(const MeshSeries&) = delete;
    MeshSeries(MeshSeries&&) = delete;
    MeshSeries& operator=(MeshSeries&&) = delete;

    /// Appends the mesh, its data and its fields as in a single file. Throws InputError unless
    /// `time` is finite and greater than all earlier times.
    void append(MeshSource& mesh, double time);

    /// Writes the file to its final path. Requires at least one appended mesh; nothing may be
    /// appended afterwards. Returns a sentence naming the data that was left out, or an empty
    /// string: facets and edges with their markers, group names, and data that not all meshes have.
    [[nodiscard]] std::string commit();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace octetra
