#include <array>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/verify/certify_shapes.hpp>
#include <octetra/verify/verify.hpp>

#include "verify/port_of_shapes.hpp"
#include "verify/verdicts.hpp"

/// Adaptive refinement by the rules of docs/shapes.md, in integers, against the certificates of its
/// cells.
namespace octetra::verify {
namespace {

using test::Corner;
using test::EndPoints;
using test::Tetrahedron;

constexpr int most_generations = 10;

std::array<EndPoints, 6> edges_of(const Tetrahedron& t) {
    std::array<EndPoints, 6> edges;
    for (std::size_t e = 0; e < 6; ++e) edges[e] = test::ends(t, e);
    return edges;
}

Corner midpoint(const EndPoints& e) {
    return {(e[0][0] + e[1][0]) / 2, (e[0][1] + e[1][1]) / 2, (e[0][2] + e[1][2]) / 2};
}

EndPoints edge(const Corner& a, const Corner& b) { return {std::min(a, b), std::max(a, b)}; }

struct Leaf {
    std::size_t root;
    Tetrahedron cell;
    Tetrahedron parent;  ///< of a transition cell: the regular cell; otherwise the cell itself
    bool is_transition;
};

/// A mesh as a function of its input and the bisected edges of regular cells.
class RegularMesh {
public:
    explicit RegularMesh(std::vector<Tetrahedron> roots) : roots_(std::move(roots)) {}

    std::vector<Leaf> leaves() {
        std::vector<Leaf> found;
        for (std::size_t root = 0; root < roots_.size(); ++root) {
            visit(roots_[root], [&](const Tetrahedron& cell, std::size_t bisected) {
                if (bisected == 6) return;
                std::vector<Tetrahedron> pieces;
                test::bisect(cell, bisected_, pieces);
                for (const Tetrahedron& piece : pieces) {
                    found.push_back({root, piece, cell, bisected > 0});
                }
            });
        }
        return found;
    }

    void refine(const std::vector<Leaf>& marked) {
        for (const Leaf& leaf : marked) {
            add(leaf.parent);
            if (!leaf.is_transition) continue;
            for (const Tetrahedron& child : children(leaf.parent)) {
                if (std::ranges::is_permutation(child, leaf.cell)) add(child);
            }
        }
        while (add_by_rules()) {
        }
    }

private:
    void add(const Tetrahedron& cell) {
        for (const EndPoints& e : edges_of(cell)) bisected_.insert(e);
    }

    const std::vector<Tetrahedron>& children(const Tetrahedron& cell) {
        std::vector<Tetrahedron>& found = children_[cell];
        if (found.empty()) {
            const auto edges = edges_of(cell);
            test::bisect(cell, {edges.begin(), edges.end()}, found);
        }
        return found;
    }

    void visit(const Tetrahedron& cell, const auto& see) {
        std::size_t bisected = 0;
        for (const EndPoints& e : edges_of(cell)) bisected += bisected_.count(e);
        see(cell, bisected);
        if (bisected < 6) return;
        for (const Tetrahedron& child : children(cell)) visit(child, see);
    }

    /// Returns whether a face that has an edge of the set has its longest edge in the set; and
    /// whether an edge of the face's division into four is in the set.
    bool add_by_rules() {
        std::set<EndPoints> more;
        for (const Tetrahedron& root : roots_) {
            visit(root, [&](const Tetrahedron& cell, std::size_t bisected) {
                if (bisected == 0 || bisected == 6) return;
                for (const auto& [a, b, c] : cell_faces) {
                    std::array<EndPoints, 3> face{edge(cell[a], cell[b]), edge(cell[a], cell[c]),
                                                  edge(cell[b], cell[c])};
                    std::ranges::sort(face, test::is_longer);
                    const auto is_bisected = [&](const EndPoints& e) {
                        return bisected_.contains(e);
                    };
                    if (std::ranges::any_of(face, is_bisected)) more.insert(face[0]);
                    if (std::ranges::any_of(divided(face), is_bisected)) {
                        for (const EndPoints& e : edges_of(cell)) more.insert(e);
                    }
                }
            });
        }
        const std::size_t before = bisected_.size();
        bisected_.merge(more);
        return bisected_.size() > before;
    }

    /// The edges of a face's division into four; its longest edge is the first.
    static std::vector<EndPoints> divided(const std::array<EndPoints, 3>& face) {
        std::vector<EndPoints> edges;
        for (const EndPoints& e : face) {
            edges.push_back(edge(e[0], midpoint(e)));
            edges.push_back(edge(midpoint(e), e[1]));
        }
        const Corner m = midpoint(face[0]);
        edges.push_back(edge(m, midpoint(face[1])));
        edges.push_back(edge(m, midpoint(face[2])));
        for (const Corner& corner : face[1]) {
            if (corner != face[0][0] && corner != face[0][1]) edges.push_back(edge(m, corner));
        }
        return edges;
    }

    std::vector<Tetrahedron> roots_;
    std::set<EndPoints> bisected_;
    std::map<Tetrahedron, std::vector<Tetrahedron>> children_;
};

/// Six cells around the diagonal of a distorted cube.
std::vector<Tetrahedron> distorted_cube(std::mt19937& random, int distortion) {
    constexpr std::int64_t side = 32;
    std::uniform_int_distribution<std::int64_t> shift(-distortion, distortion);
    std::array<Corner, 8> corners;
    for (std::size_t k = 0; k < 8; ++k) {
        for (std::size_t x = 0; x < 3; ++x) {
            const std::int64_t at = (k >> x & 1U) != 0 ? side : 0;
            corners[k][x] = (at + shift(random)) * (std::int64_t{1} << most_generations);
        }
    }
    std::vector<Tetrahedron> cells;
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
        Tetrahedron cell{corners[0]};
        std::size_t k = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            k |= std::size_t{1} << axes[i];
            cell[i + 1] = corners[k];
        }
        if (test::six_volumes(cell) < 0) std::swap(cell[2], cell[3]);
        cells.push_back(cell);
    } while (std::ranges::next_permutation(axes).found);
    return cells;
}

/// Cells to mark: at random, or those near a corner.
std::vector<Leaf> some_of(const std::vector<Leaf>& leaves, bool at_corner, std::mt19937& random) {
    if (at_corner) return {leaves.front(), leaves.back()};
    std::vector<Leaf> marked;
    std::ranges::sample(leaves, std::back_inserter(marked), 2, random);
    return marked;
}

class RegularRefinement : public testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(RegularRefinement, MakesNoCellWorseThanTheCertificateOfItsRoot) {
    const auto [distortion, at_corner] = GetParam();
    std::mt19937 random(7);
    const std::vector<Tetrahedron> roots = distorted_cube(random, distortion);
    std::vector<ShapeBounds> bounds;
    for (const Tetrahedron& root : roots) {
        std::array<Point, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = test::point_of(root[k]);
        const CellCertificate certificate = certify_cell(corners);
        ASSERT_TRUE(certificate.is_closed);
        bounds.push_back(certificate.bounds);
    }
    RegularMesh mesh(roots);
    std::size_t transition_cells = 0;
    for (int step = 0; step < 6; ++step) {
        mesh.refine(some_of(mesh.leaves(), at_corner, random));
        for (const Leaf& leaf : mesh.leaves()) {
            if (leaf.is_transition) ++transition_cells;
            const test::Angles found = test::angles(leaf.cell);
            const ShapeBounds& bound = bounds[leaf.root];
            ASSERT_GE(found.min_dihedral, bound.min_dihedral);
            ASSERT_LE(found.max_dihedral, bound.max_dihedral);
            ASSERT_GE(found.min_eta, bound.min_eta);
            ASSERT_GE(found.min_solid, bound.min_solid);
        }
    }
    EXPECT_GT(transition_cells, 100U);
}

/// The cells as a mesh; cells with equal corners share vertices.
Mesh mesh_of(const std::vector<Tetrahedron>& cells) {
    Mesh mesh;
    std::map<Corner, VertexIndex> numbers;
    for (const Tetrahedron& cell : cells) {
        CellVertices vertices;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [known, is_new] = numbers.try_emplace(cell[k], mesh.points.end_index());
            if (is_new) mesh.points.push_back(test::point_of(cell[k]));
            vertices[k] = known->second;
        }
        mesh.cells.push_back(vertices);
    }
    return mesh;
}

/// The whole mesh as a mesh; positively oriented.
Mesh mesh_of(const std::vector<Leaf>& leaves) {
    std::vector<Tetrahedron> cells;
    for (const Leaf& leaf : leaves) {
        cells.push_back(leaf.cell);
        if (test::six_volumes(cells.back()) < 0) std::swap(cells.back()[2], cells.back()[3]);
    }
    return mesh_of(cells);
}

TEST_P(RegularRefinement, IsVerifiedUntilATransitionCellIsBisected) {
    const auto [distortion, at_corner] = GetParam();
    std::mt19937 random(11);
    const std::vector<Tetrahedron> roots = distorted_cube(random, distortion);
    const Mesh coarse = mesh_of(roots);
    const VerifyOptions regular{.closure = Closure::regular};
    RegularMesh mesh(roots);
    for (int step = 0; step < 4; ++step) {
        mesh.refine(some_of(mesh.leaves(), at_corner, random));
        const Verdict verdict = verify_refinement(coarse, mesh_of(mesh.leaves()), regular);
        EXPECT_EQ(test::codes_of(verdict), "") << step;
        EXPECT_EQ(test::check_named(verdict, "regular closure").status, Status::passed);
    }
    // The bisection of all cells at an edge between two midpoints is a refinement, but not a
    // regular one.
    const std::vector<Leaf> leaves = mesh.leaves();
    std::vector<EndPoints> inner;
    for (const Leaf& leaf : leaves) {
        const auto is_corner = [&](const Corner& c) {
            return std::ranges::find(leaf.parent, c) != leaf.parent.end();
        };
        for (const EndPoints& e : edges_of(leaf.cell)) {
            if (leaf.is_transition && !is_corner(e[0]) && !is_corner(e[1])) inner.push_back(e);
        }
    }
    ASSERT_FALSE(inner.empty());
    std::vector<Tetrahedron> pieces;
    const EndPoints bisected = inner[random() % inner.size()];
    for (const Leaf& leaf : leaves) test::bisect(leaf.cell, {bisected}, pieces);
    for (Tetrahedron& piece : pieces) {
        if (test::six_volumes(piece) < 0) std::swap(piece[2], piece[3]);
    }
    EXPECT_EQ(test::codes_of(verify_refinement(coarse, mesh_of(pieces), {})), "");
    const std::string codes = test::codes_of(verify_refinement(coarse, mesh_of(pieces), regular));
    EXPECT_NE(codes.find("bisected_transition_cell"), std::string::npos) << codes;
}

INSTANTIATE_TEST_SUITE_P(Meshes, RegularRefinement,
                         testing::Combine(testing::Values(0, 3, 8), testing::Bool()));

}  // namespace
}  // namespace octetra::verify
