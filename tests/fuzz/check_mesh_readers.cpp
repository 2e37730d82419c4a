#include <algorithm>
#include <bit>
#include <optional>
#include <string>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "fuzz/check_readers.hpp"
#include "support/bits.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::test {
namespace {

namespace fs = std::filesystem;

bool same_bits(const Mesh& a, const Mesh& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    return a == b && bits(a) == bits(b) &&
           std::ranges::equal(a.point_attributes, b.point_attributes, same);
}

/// The mesh, after its checks; nothing if it was refused.
std::optional<Mesh> read(const fs::path& path, const ReadOptions& options) {
    try {
        Mesh mesh = read_mesh(path, options);
        const std::string broken = broken_invariant(mesh, options.only_syntax);
        if (!broken.empty()) throw BrokenPromise("a mesh was read, but " + broken);
        return mesh;
    } catch (const InputError& error) {
        check_message(error.what(), path.parent_path());
        return std::nullopt;
    }
}

void expect_same(const std::optional<Mesh>& found, const Mesh& expected, const char* when) {
    if (!found) throw BrokenPromise(std::string("a mesh is refused ") + when);
    if (!same_bits(*found, expected)) throw BrokenPromise(std::string("another mesh ") + when);
}

template <class I>
void drop_if_all_zero(IndexVector<I, Marker>& markers) {
    if (std::ranges::all_of(markers, [](Marker m) { return m == 0; })) markers.clear();
}

/// The content of a mesh that Medit's format can store.
Mesh as_in_medit(Mesh mesh) {
    mesh.index_base = mesh.points.empty() ? 0 : 1;
    mesh.group_names.clear();
    mesh.attributes_per_point = 0;
    mesh.point_attributes.clear();
    drop_if_all_zero(mesh.point_markers);
    drop_if_all_zero(mesh.regions);
    drop_if_all_zero(mesh.facet_markers);
    drop_if_all_zero(mesh.edge_markers);
    return mesh;
}

/// The content of a mesh that TetGen's files can store.
Mesh as_in_tetgen(Mesh mesh) {
    mesh.group_names.clear();
    mesh.features = {};
    return mesh;
}

void check_written(const Mesh& mesh, const fs::path& folder, bool only_syntax) {
    const ReadOptions options{.only_syntax = only_syntax};
    (void)write_mesh(mesh, folder / "out.ele");
    expect_same(read(folder / "out.ele", options), as_in_tetgen(mesh),
                "when written to TetGen files and read");
    (void)write_mesh(mesh, folder / "out.mesh");
    expect_same(read(folder / "out.mesh", options), as_in_medit(mesh),
                "when written to a Medit file and read");
    (void)write_mesh(mesh, folder / "out.meshb");
    expect_same(read(folder / "out.meshb", options), as_in_medit(mesh),
                "when written to a binary Medit file and read");
}

/// The content of a mesh that Gmsh's format can store.
Mesh as_in_gmsh(Mesh mesh) {
    mesh.point_markers.clear();
    std::vector<GroupName> group_names = std::move(mesh.group_names);
    mesh = as_in_medit(std::move(mesh));
    mesh.features = {};
    mesh.group_names = std::move(group_names);
    return mesh;
}

void check_written_to_msh(const Mesh& mesh, const fs::path& folder, bool only_syntax) {
    const ReadOptions options{.only_syntax = only_syntax};
    for (const bool is_2 : {false, true}) {
        for (const bool is_text : {false, true}) {
            (void)write_mesh(mesh, folder / "out.msh", {.msh = {is_2, is_text}});
            expect_same(read(folder / "out.msh", options), as_in_gmsh(mesh),
                        "when written to a Gmsh file and read");
        }
    }
}

void check_mesh(const fs::path& path) {
    const std::optional<Mesh> mesh = read(path, {});
    const std::optional<Mesh> unchecked = read(path, {.only_syntax = true});
    const std::optional<Mesh> oriented = read(path, {.fix_orientation = true});
    if (mesh) {
        expect_same(unchecked, *mesh, "when only syntax is asked for");
        expect_same(oriented, *mesh, "when inverted cells are reversed");
    }
    if (!unchecked) return;
    check_written(*unchecked, path.parent_path(), !mesh);
    check_written_to_msh(*unchecked, path.parent_path(), !mesh);
}

}  // namespace

void check_tetgen(std::string_view input, const fs::path& folder) {
    for (const std::string extension : {"node", "ele", "face", "edge"}) {
        const fs::path path = folder / ("in." + extension);
        const std::size_t end = std::min(input.find('%'), input.size());
        const std::string_view content = input.substr(0, end);
        const bool is_there = input.data() != nullptr && content != "-";
        fs::remove(path);
        if (is_there) write_file(path, content);
        input = end == input.size() ? std::string_view{} : input.substr(end + 1);
    }
    check_mesh(folder / "in.ele");
}

void check_medit(std::string_view input, const fs::path& folder) {
    write_file(folder / "in.mesh", input);
    check_mesh(folder / "in.mesh");
}

void check_meshb(std::string_view input, const fs::path& folder) {
    write_file(folder / "in.meshb", input);
    check_mesh(folder / "in.meshb");
}

void check_gmsh(std::string_view input, const fs::path& folder) {
    write_file(folder / "in.msh", input);
    check_mesh(folder / "in.msh");
}

}  // namespace octetra::test
