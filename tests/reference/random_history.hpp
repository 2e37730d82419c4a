#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <octetra/reference/history.hpp>

#include "support/meshes.hpp"
#include "support/tagged_meshes.hpp"

/// Small meshes that are refined and coarsened at random. Cells are marked by their coordinates, so
/// that numbering has no influence.
namespace octetra::reference {

/// All points of these meshes, multiplied by this scale, are integers of less than 40 bits.
inline constexpr double random_history_scale = 0x1p36;

/// A call of refined() or of coarsened().
struct Call {
    bool coarsens = false;
    CellMarks marked;
    Scheme scheme = Scheme::eight;
    History before;
    History after;
};

/// A lattice full of ties, a perturbed lattice, or a shell, with tags and attributes.
inline Mesh random_input(std::uint64_t seed) {
    Mesh mesh = test::tagged(seed % 3 == 0   ? test::kuhn(2, 2, 1)
                             : seed % 3 == 1 ? test::perturbed_kuhn(2, 0.25, seed)
                                             : test::shell(6, seed));
    mesh.attributes_per_point = 2;
    for (const Point& p : mesh.points) {
        mesh.point_attributes.push_back(p.x - p.y);
        mesh.point_attributes.push_back(p.z / 3);
    }
    return mesh;
}

/// Selects about this number of cells.
inline Selection about(double count, const Mesh& mesh, std::uint64_t seed) {
    const double share = std::clamp(count / static_cast<double>(mesh.cells.size()), 0.0, 1.0);
    return {.random = RandomShare{share, seed}};
}

inline Scheme random_scheme(std::mt19937_64& random) {
    constexpr std::array schemes{Scheme::eight, Scheme::four, Scheme::two};
    return schemes[random() % 3];
}

inline Call random_refinement(const History& before, std::mt19937_64& random) {
    const Refinement present = replay(before).back();
    Call call{.scheme = random_scheme(random), .before = before};
    const auto count = static_cast<double>(1 + random() % 4);
    call.marked = marked_cells(present, about(count, present.mesh, random()));
    call.after = refined(before, call.marked, call.scheme);
    return call;
}

/// All cells, none, a ball of them, or all but a few.
inline Selection random_cells_to_coarsen(const Mesh& present, std::mt19937_64& random) {
    const auto up_to = [&](double most) { return static_cast<double>(random() % 64) / 63 * most; };
    const std::uint64_t kind = random() % 10;
    if (kind == 0) return {.all = true};
    if (kind == 1) return {};
    if (kind > 5) {
        auto points = present.points;
        std::ranges::sort(points, std::less<>{});
        return {.spheres = {{points[VertexIndex{random() % points.size()}], 0.25 + up_to(1)}}};
    }
    const auto cells = static_cast<double>(present.cells.size());
    const std::uint64_t seed = random();  // argument evaluation is unordered
    return about(cells - 1 - up_to(0.1 * cells), present, seed);
}

inline Call random_coarsening(const History& before, std::mt19937_64& random) {
    const Refinement present = replay(before).back();
    Call call{.coarsens = true, .before = before};
    call.marked = marked_cells(present, random_cells_to_coarsen(present.mesh, random));
    call.after = coarsened(before, call.marked);
    return call;
}

/// Eight calls, the first two of which refine.
inline std::vector<Call> random_calls(const Mesh& input, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<Call> calls;
    History history{input, {}};
    for (int i = 0; i < 8; ++i) {
        const bool refines = i < 2 || random() % 2 == 0;
        calls.push_back(refines ? random_refinement(history, random)
                                : random_coarsening(history, random));
        history = calls.back().after;
    }
    return calls;
}

/// The calls that coarsen.
inline std::vector<Call> random_coarsenings(std::uint64_t seed) {
    std::vector<Call> calls = random_calls(random_input(seed), seed);
    std::erase_if(calls, [](const Call& call) { return !call.coarsens; });
    return calls;
}

}  // namespace octetra::reference
