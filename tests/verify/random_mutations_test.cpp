#include <cstdlib>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <octetra/reference/refine.hpp>
#include <octetra/verify/compare.hpp>
#include <octetra/verify/verify.hpp>

#include "support/meshes.hpp"
#include "verify/mutations.hpp"
#include "verify/together.hpp"
#include "verify/verdicts.hpp"

/// Random changes of a refined mesh: none may pass unless the mesh is unchanged.
/// RC_PARAMS="seed=..." repeats a failure, RC_PARAMS="max_success=..." sets the number of cases.
namespace octetra::verify {
namespace {

/// A refined mesh with all its claims.
struct Case {
    Mesh coarse;
    Request request;
    reference::Refinement fine;
};

Case make_case(int kind, std::uint64_t seed) {
    Case c;
    c.coarse = kind % 2 == 0 ? test::kuhn(2, 1, 1) : test::perturbed_kuhn(1, 0.2, seed % 1000);
    test::list_boundary(c.coarse);
    c.coarse.regions.assign(c.coarse.cells.size(), 1);
    c.coarse.regions.front() = 2;
    c.coarse.point_markers.assign(c.coarse.points.size(), 4);
    c.request.selection =
        kind % 3 == 0 ? Selection{.all = true} : Selection{.random = RandomShare{0.3, seed}};
    c.request.scheme = kind % 5 == 0 ? Scheme::two : Scheme::eight;
    c.request.levels = 1 + kind % 2;
    c.fine = reference::refine(c.coarse, c.request.selection, c.request.scheme, c.request.levels);
    return c;
}

/// Makes one change, drawn by rapidcheck. Returns its name.
std::string mutate(Mesh& mesh) {
    const auto below = [](std::size_t n) { return *rc::gen::inRange<std::size_t>(0, n); };
    const VertexIndex v{below(mesh.points.size())};
    const VertexIndex w{below(mesh.points.size())};
    const CellIndex c{below(mesh.cells.size())};
    const CellIndex d{below(mesh.cells.size())};
    const std::size_t corner = below(4);
    const auto step = [&] { return (static_cast<double>(below(9)) - 4) * 0x1p-6; };
    switch (below(17)) {
        case 0: {
            const Point p = mesh.points[v];
            test::move_vertex(mesh, v, {p.x + step(), p.y + step(), p.z + step()});
            return "move";
        }
        case 1: test::shift_by_an_ulp(mesh, v); return "ulp";
        case 2: std::swap(mesh.points[v], mesh.points[w]); return "swap points";
        case 3: test::drop_cell(mesh, c); return "drop";
        case 4: test::duplicate_cell(mesh, c); return "duplicate";
        case 5: test::flip_cell(mesh, c); return "flip";
        case 6: test::replace_corner(mesh, c, corner, w); return "replace corner";
        case 7: test::unmerge_vertex(mesh, c, corner); return "unmerge";
        case 8: test::bisect_alone(mesh, c, below(6)); return "bisect alone";
        case 9: {
            const auto [i, j] = cell_edges[below(6)];
            test::bisect_edge(mesh, mesh.cells[c][i], mesh.cells[c][j]);
            return "bisect edge";
        }
        case 10: std::swap(mesh.cells[c][corner], mesh.cells[d][corner]); return "swap corners";
        case 11: mesh.regions[c] = *rc::gen::inRange(0, 4); return "region";
        case 12:
            mesh.facet_markers[FacetIndex{below(mesh.facets.size())}] = *rc::gen::inRange(0, 7);
            return "facet marker";
        case 13: {
            const FacetIndex f{below(mesh.facets.size())};
            test::erase(mesh.facets, f);
            test::erase(mesh.facet_markers, f);
            return "drop facet";
        }
        case 14: mesh.point_markers[v] = *rc::gen::inRange(0, 6); return "vertex marker";
        case 15: std::swap(mesh.cells[c], mesh.cells[d]); return "swap cells";
        default: {  // merges two vertices
            for (CellVertices& cell : mesh.cells) {
                std::replace(cell.begin(), cell.end(), v, w);
            }
            return "merge vertices";
        }
    }
}

TEST(RandomMutations, DoNotPassUnlessTheMeshIsTheSame) {
    ::setenv("RC_PARAMS", "max_success=400", 0);  // what the user has set stays
    const bool holds = rc::check("none passes unless equivalent", [] {
        Case c = make_case(*rc::gen::inRange(0, 30), *rc::gen::arbitrary<std::uint64_t>());
        Mesh mutated = c.fine.mesh;
        const int count = *rc::gen::inRange(1, 3);
        for (int i = 0; i < count; ++i) RC_TAG(mutate(mutated));
        const bool same = compare(c.fine.mesh, mutated).likeness != Likeness::different;
        const Verdict verdict = verify_refinement(c.coarse, mutated, {.request = c.request});
        RC_CLASSIFY(same, "still the same mesh");
        if (verdict.valid() != same) RC_FAIL("verdict: " + test::codes_of(verdict));

        const int size = *rc::gen::inRange(2, 9);
        Verdict together;
        test::run_together(size, [&](const ProcessGroup& group) {
            Verdict of_one = verify_refinement(verify::distribute_slices(c.coarse, group),
                                               verify::distribute_slices(mutated, group), group,
                                               {.request = c.request});
            if (group.is_first()) together = std::move(of_one);
        });
        RC_ASSERT(test::verdict_text(together) == test::verdict_text(verdict));
    });
    EXPECT_TRUE(holds);
}

}  // namespace
}  // namespace octetra::verify
