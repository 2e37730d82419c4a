/// `counted_cases CASE` refines a small mesh on one process, so that callgrind counts the
/// instructions of counted(): without those for making the mesh and the pattern tables, which a
/// program makes once.

#include <array>
#include <cstdio>
#include <string_view>

#include <octetra/distributed/refine.hpp>

#include "level/tuning.hpp"
#include "support/meshes.hpp"

namespace octetra {
namespace {

struct CountedCase {
    std::string_view name;
    std::size_t cubes = 0;  ///< on each side
    double radius = 0;      ///< of a sphere about the middle; 0: all cells
    int levels = 1;
    double incremental_below = 0;  ///< see Tuning
};

constexpr std::array<CountedCase, 4> cases{{
    {.name = "uniform", .cubes = 12},
    // Twelve cells of 24,576, and then those within the same radius: few at each level.
    {.name = "incremental", .cubes = 16, .radius = 0.04, .levels = 3, .incremental_below = 0.125},
    {.name = "full_sweep", .cubes = 8, .radius = 0.25, .levels = 3},
    // 380 cells of 48,000, in a full sweep with a local edge set.
    {.name = "local_sweep", .cubes = 20, .radius = 0.125},
}};

distributed::DistributedMesh lattice(std::size_t n) {
    Mesh mesh = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    const std::vector<int> parts(mesh.cells.size(), 0);
    return distributed::distribute({}, std::move(mesh), parts);
}

}  // namespace

/// Counted by callgrind under this name; so it is never inlined.
[[gnu::noinline]] void counted(distributed::DistributedMesh& mesh, const Selection& selection,
                               int levels, const distributed::Tuning& tuning) {
    (void)distributed::refine(mesh, selection, {.levels = levels}, tuning);
}

namespace {

int run(const CountedCase& chosen) {
    auto mesh = lattice(1);
    (void)distributed::refine(mesh, {.all = true}, {});  // makes the tables
    mesh = lattice(chosen.cubes);
    Selection selection{.all = chosen.radius <= 0};
    if (chosen.radius > 0) selection.spheres.push_back({{0.5, 0.5, 0.5}, chosen.radius});
    counted(mesh, selection, chosen.levels, {.incremental_below = chosen.incremental_below});
    std::printf("%zu cells\n", mesh.cells.size());
    return 0;
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    for (const auto& one : octetra::cases) {
        if (argc == 2 && one.name == argv[1]) return octetra::run(one);
    }
    std::fprintf(stderr, "usage: counted_cases uniform|incremental|full_sweep|local_sweep\n");
    return 2;
}
