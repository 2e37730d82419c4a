/// `counted_cases CASE` refines a small mesh on one process, for callgrind to count what counted()
/// takes: not the making of the mesh, nor the pattern tables, which a program makes but once.

#include <array>
#include <cstdio>
#include <string_view>

#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

struct CountedCase {
    std::string_view name;
    std::size_t cubes = 0;  ///< a side
    double radius = 0;      ///< of a sphere about the middle; 0: all cells
    int levels = 1;
    double sparse_below = 0;  ///< see DistributedMesh
};

constexpr std::array<CountedCase, 4> cases{{
    {.name = "uniform", .cubes = 12},
    // Twelve cells of 24,576, and then what is nearer to the middle than they are: few at each
    // level.
    {.name = "sparse", .cubes = 16, .radius = 0.04, .levels = 3, .sparse_below = 0.125},
    {.name = "dense", .cubes = 8, .radius = 0.25, .levels = 3},
    // 380 cells of 48,000, the dense way all the same: few have to be numbered.
    {.name = "near", .cubes = 20, .radius = 0.125},
}};

distributed::DistributedMesh lattice(std::size_t n) {
    Mesh mesh = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    const std::vector<int> parts(mesh.cells.size(), 0);
    return distributed::distribute({}, std::move(mesh), parts);
}

}  // namespace

/// What callgrind counts, by this name; so it is never inlined.
[[gnu::noinline]] void counted(distributed::DistributedMesh& mesh, const Selection& selection,
                               int levels) {
    (void)distributed::refine(mesh, selection, {.levels = levels});
}

namespace {

int run(const CountedCase& chosen) {
    auto mesh = lattice(1);
    (void)distributed::refine(mesh, {.all = true}, {});  // makes the tables
    mesh = lattice(chosen.cubes);
    mesh.sparse_below = chosen.sparse_below;
    Selection selection{.all = chosen.radius <= 0};
    if (chosen.radius > 0) selection.spheres.push_back({{0.5, 0.5, 0.5}, chosen.radius});
    counted(mesh, selection, chosen.levels);
    std::printf("%zu cells\n", mesh.cells.size());
    return 0;
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    for (const auto& one : octetra::cases) {
        if (argc == 2 && one.name == argv[1]) return octetra::run(one);
    }
    std::fprintf(stderr, "usage: counted_cases uniform|sparse|dense|near\n");
    return 2;
}
