/// Memory for reading and writing a mesh in addition to the mesh itself: peaks of processes that do
/// nothing else, as counted by the kernel.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <octetra/core/files/mesh_files.hpp>

#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace octetra {
namespace {

template <class T>
std::uint64_t bytes_of(const std::vector<T>& v) {
    return v.size() * sizeof(T);
}

std::uint64_t bytes_of(const Mesh& mesh) {
    return bytes_of(mesh.points) + bytes_of(mesh.point_markers) + bytes_of(mesh.point_attributes) +
           bytes_of(mesh.cells) + bytes_of(mesh.regions) + bytes_of(mesh.facets) +
           bytes_of(mesh.facet_markers) + bytes_of(mesh.edges) + bytes_of(mesh.edge_markers);
}

/// Peak resident bytes of a child process that runs `work`.
std::uint64_t peak_of(auto&& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(0);
    }
    rusage usage{};
    int status = 0;
    ::wait4(child, &status, 0, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void report(const std::string& what, std::uint64_t peak, std::uint64_t idle, std::uint64_t mesh) {
    const std::uint64_t used = peak - idle;
    fmt::print("{:<14} {:8.1f} MB peak, {:8.1f} MB in the mesh: {:.2f} times\n", what,
               static_cast<double>(used) * 1e-6, static_cast<double>(mesh) * 1e-6,
               static_cast<double>(used) / static_cast<double>(mesh));
}

void measure() {
    const test::TemporaryFolder folder;
    std::uint64_t mesh_bytes = 0;
    int to_parent[2];
    if (::pipe(to_parent) != 0) return;
    // The mesh is made in a separate process, so that the peak of this one stays low.
    (void)peak_of([&] {
        Mesh mesh = test::kuhn(56, 56, 55, 1.0 / 3);
        test::list_boundary(mesh);
        mesh.regions.assign(mesh.cells.size(), 3);
        (void)write_mesh(mesh, folder / "a.ele");
        (void)write_mesh(mesh, folder / "a.mesh");
        const std::uint64_t bytes = bytes_of(mesh);
        if (::write(to_parent[1], &bytes, sizeof bytes) != sizeof bytes) ::_exit(1);
    });
    if (::read(to_parent[0], &mesh_bytes, sizeof mesh_bytes) != sizeof mesh_bytes) return;

    const std::uint64_t idle = peak_of([] {});
    for (const std::string name : {"a.ele", "a.mesh"}) {
        report("read " + name, peak_of([&] { (void)read_mesh(folder / name); }), idle, mesh_bytes);
    }
    for (const std::string name : {"b.ele", "b.mesh", "b.vtu"}) {
        const auto peak = peak_of([&] {
            const Mesh mesh = read_mesh(folder / "a.ele");
            (void)write_mesh(mesh, folder / name);
        });
        report("write " + name, peak, idle, mesh_bytes);
    }
}

}  // namespace
}  // namespace octetra

int main() { octetra::measure(); }
