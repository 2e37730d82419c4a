#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra {

/// A `.vtkhdf` file, of version 2.0, with meshes one after the other, each at a time. They may have
/// other cells each. All functions are collective in the group, whose meshes they are, and throw
/// SystemError on all processes where writing fails.
///
/// What is appended is written beside the file's place at once, and put together by commit(): for
/// that time it takes the space on the disk twice. Memory: a few slices, whatever is appended. The
/// bytes do not depend on the number of processes. Destroyed before commit(), it leaves no trace.
class MeshSeries {
public:
    /// Throws InputError where the extension is another, or no file can be put there. The group
    /// must live as long.
    MeshSeries(const std::filesystem::path& path, const ProcessGroup& group);
    ~MeshSeries();
    MeshSeries(const MeshSeries&) = delete;
    MeshSeries& operator=(const MeshSeries&) = delete;
    MeshSeries(MeshSeries&&) = delete;
    MeshSeries& operator=(MeshSeries&&) = delete;

    /// Appends the mesh, its data and its fields, as a single file has them. `time` is finite and
    /// greater than those before, or InputError.
    void append(MeshSource& mesh, double time);

    /// Puts the file in its place. At least one mesh must have been appended; nothing may be any
    /// more. Returns what is left out, in a sentence, or nothing: facets and edges with their
    /// markers, names of groups, and data that not all meshes have.
    [[nodiscard]] std::string commit();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace octetra
