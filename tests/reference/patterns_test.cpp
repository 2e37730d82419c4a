#include <algorithm>
#include <array>
#include <bitset>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bisect.hpp"

/// All bisections of one tetrahedron: all 720 orders of its six edges by length, and all
/// selections. The figures are those of Plaza & Carey, "Local refinement of simplicial grids based
/// on the skeleton", and of an independent exact enumeration.
namespace octetra::reference {
namespace {

using testing::ElementsAre;

/// Corners are vertices 0..3; the midpoint of edge k (as in cell_edges) is vertex 4 + k.
using Tetrahedron = std::array<int, 4>;
using Triangle = std::array<int, 3>;
using Triangulation = std::set<Tetrahedron>;  // each with its vertices ascending
using EdgeSubset = std::bitset<6>;
using LengthOrder = std::array<std::size_t, 6>;  // edge numbers, longest first

constexpr std::array<std::array<std::size_t, 3>, 4> edges_of_face{
    {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};

struct Case {
    EdgeSubset marked;
    std::array<std::size_t, 4> face_longest;
    LengthOrder order;
    std::vector<Tetrahedron> children;  // in the order of the recursion, as are their vertices
    Triangulation triangulation;
};

std::size_t longest_of(std::span<const std::size_t> edges, const LengthOrder& order) {
    for (const std::size_t e : order) {
        if (std::ranges::count(edges, e) == 1) return e;
    }
    return 6;
}

std::vector<BisectedEdge> longest_first(EdgeSubset marked, const LengthOrder& order) {
    std::vector<BisectedEdge> edges;
    for (const std::size_t e : order) {
        if (!marked[e]) continue;
        const auto& [i, j] = cell_edges[e];
        edges.push_back({{VertexIndex{i}, VertexIndex{j}}, VertexIndex{4 + e}});
    }
    return edges;
}

template <std::size_t N>
std::vector<std::array<int, N>> bisected(const std::array<int, N>& vertices, EdgeSubset marked,
                                         const LengthOrder& order) {
    std::array<VertexIndex, N> piece;
    std::ranges::transform(vertices, piece.begin(),
                           [](int v) { return VertexIndex{static_cast<std::size_t>(v)}; });
    std::vector<std::array<VertexIndex, N>> pieces;
    bisect(piece, longest_first(marked, order), pieces);
    std::vector<std::array<int, N>> result;
    for (const auto& p : pieces) {
        std::array<int, N>& q = result.emplace_back();
        std::ranges::transform(p, q.begin(),
                               [](VertexIndex v) { return static_cast<int>(v.value()); });
    }
    return result;
}

Triangulation as_set(std::vector<Tetrahedron> children) {
    for (Tetrahedron& child : children) std::ranges::sort(child);
    return {children.begin(), children.end()};
}

/// All cases, one for each distinct (marked edges, longest edges of the faces) and longest marked
/// edge: the closed selections under every length order.
const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = [] {
        std::vector<Case> found;
        LengthOrder order{0, 1, 2, 3, 4, 5};
        do {
            std::array<std::size_t, 4> face_longest{};
            for (std::size_t f = 0; f < 4; ++f) {
                face_longest[f] = longest_of(edges_of_face[f], order);
            }
            for (unsigned long mask = 0; mask < 64; ++mask) {
                const EdgeSubset marked(mask);
                bool closed = true;
                for (std::size_t f = 0; f < 4; ++f) {
                    const bool touched = std::ranges::any_of(
                        edges_of_face[f], [&](std::size_t e) { return marked[e]; });
                    closed = closed && (!touched || marked[face_longest[f]]);
                }
                if (!closed) continue;
                const auto children = bisected<4>({0, 1, 2, 3}, marked, order);
                found.push_back({marked, face_longest, order, children, as_set(children)});
            }
        } while (std::ranges::next_permutation(order).found);
        return found;
    }();
    return cases;
}

/// The image of vertex v under a rotation or reflection of the tetrahedron.
int moved(int v, const std::array<int, 4>& corners) {
    if (v < 4) return corners[static_cast<std::size_t>(v)];
    const auto& [i, j] = cell_edges[static_cast<std::size_t>(v - 4)];
    const auto [low, high] = std::minmax(corners[i], corners[j]);
    for (std::size_t e = 0; e < 6; ++e) {
        if (cell_edges[e][0] == low && cell_edges[e][1] == high) return 4 + static_cast<int>(e);
    }
    return -1;
}

Triangulation moved(const Triangulation& triangulation, const std::array<int, 4>& corners) {
    std::vector<Tetrahedron> cells;
    for (Tetrahedron cell : triangulation) {
        for (int& v : cell) v = moved(v, corners);
        cells.push_back(cell);
    }
    return as_set(cells);
}

bool is_even(std::array<int, 4> permutation) {
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) inversions += permutation[i] > permutation[j];
    }
    return inversions % 2 == 0;
}

std::vector<std::array<int, 4>> symmetries(bool with_reflections) {
    std::vector<std::array<int, 4>> result;
    std::array<int, 4> corners{0, 1, 2, 3};
    do {
        if (with_reflections || is_even(corners)) result.push_back(corners);
    } while (std::ranges::next_permutation(corners).found);
    return result;
}

/// The number of classes of refined cases for each number of marked edges 1..6, where symmetries
/// map a pair (triangulation, remark) to equivalent ones.
std::array<int, 6> classes(bool with_reflections, auto&& remark_of, auto&& moved_remark) {
    using Remarked = std::pair<Triangulation, int>;
    std::array<std::set<Remarked>, 6> representatives;
    const auto group = symmetries(with_reflections);
    std::set<Remarked> seen;
    for (const Case& c : all_cases()) {
        if (c.marked.none()) continue;
        const Remarked remarked{c.triangulation, remark_of(c)};
        if (!seen.insert(remarked).second) continue;
        Remarked least = remarked;
        for (const auto& corners : group) {
            least = std::min(least, Remarked{moved(remarked.first, corners),
                                             moved_remark(remarked.second, corners)});
        }
        representatives[c.marked.count() - 1].insert(least);
    }
    std::array<int, 6> counts{};
    std::ranges::transform(representatives, counts.begin(),
                           [](const auto& set) { return static_cast<int>(set.size()); });
    return counts;
}

constexpr auto no_remark = [](const Case&) { return 0; };
constexpr auto same_remark = [](int remark, const auto&) { return remark; };

TEST(Patterns, ThereAre684CasesBySelectionLongestEdgesOfTheFacesAndLongestEdge) {
    // If two opposite edges are each the longest of two faces (3 arrangements, 18 selections each),
    // either can be the longest of the cell: 54 cases more than the longest edges of the faces
    // distinguish.
    std::set<std::pair<unsigned long, std::array<std::size_t, 4>>> by_faces;
    std::set<std::tuple<unsigned long, std::array<std::size_t, 4>, std::size_t>> cases;
    for (const Case& c : all_cases()) {
        if (c.marked.none()) continue;
        by_faces.insert({c.marked.to_ulong(), c.face_longest});
        cases.insert({c.marked.to_ulong(), c.face_longest, c.order.front()});
    }
    EXPECT_EQ(cases.size(), 684U);
    EXPECT_EQ(by_faces.size(), 630U);
}

TEST(Patterns, DependOnTheSelectionAndTheLongestEdgesOfTheFacesAlone) {
    std::map<std::pair<unsigned long, std::array<std::size_t, 4>>, Triangulation> known;
    for (const Case& c : all_cases()) {
        const auto [place, fresh] =
            known.try_emplace({c.marked.to_ulong(), c.face_longest}, c.triangulation);
        ASSERT_EQ(place->second, c.triangulation);
    }
}

TEST(Patterns, Make487LabelledTriangulationsCountingTheUnrefinedOne) {
    std::set<Triangulation> triangulations;
    for (const Case& c : all_cases()) triangulations.insert(c.triangulation);
    EXPECT_EQ(triangulations.size(), 487U);
}

TEST(Patterns, AreFiftyUpToRotation) {
    EXPECT_THAT(classes(false, no_remark, same_remark), ElementsAre(1, 3, 9, 16, 15, 6));
}

TEST(Patterns, AreTwentyNineUpToAllSymmetries) {
    EXPECT_THAT(classes(true, no_remark, same_remark), ElementsAre(1, 2, 5, 9, 8, 4));
}

TEST(Patterns, WithTheirLongestMarkedEdgeAreFiftyOneUpToRotation) {
    const auto longest_marked = [](const Case& c) {
        const auto e = std::ranges::find_if(c.order, [&](std::size_t k) { return c.marked[k]; });
        return 4 + static_cast<int>(*e);
    };
    const auto moved_vertex = [](int v, const auto& corners) { return moved(v, corners); };
    EXPECT_THAT(classes(false, longest_marked, moved_vertex), ElementsAre(1, 3, 9, 17, 15, 6));
}

TEST(Patterns, HaveOneChildMoreThanEdgesAndAnotherIfLongestAndOppositeAreSelected) {
    for (const Case& c : all_cases()) {
        const std::size_t longest = c.order.front();
        const bool both = c.marked[longest] && c.marked[5 - longest];  // 5 - e is opposite e
        ASSERT_EQ(c.children.size(), c.marked.count() + 1 + (both ? 1 : 0));
    }
}

/// Twice six times the volume, where corners and midpoints of the unit corner are doubled to
/// integers.
int doubled_volume(const Tetrahedron& cell) {
    const auto position = [](int v) -> std::array<int, 3> {
        constexpr std::array<std::array<int, 3>, 4> corner{
            {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
        if (v < 4) return corner[static_cast<std::size_t>(v)];
        const auto& [i, j] = cell_edges[static_cast<std::size_t>(v - 4)];
        return {(corner[i][0] + corner[j][0]) / 2, (corner[i][1] + corner[j][1]) / 2,
                (corner[i][2] + corner[j][2]) / 2};
    };
    std::array<std::array<int, 3>, 3> m{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) {
            m[r][k] = position(cell[r + 1])[k] - position(cell[0])[k];
        }
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

TEST(Patterns, KeepTheOrientationAndFillTheParentWithHalvesOfHalves) {
    for (const Case& c : all_cases()) {
        int sum = 0;
        for (const Tetrahedron& child : c.children) {
            const int volume = doubled_volume(child);  // 8 for the parent, 4, 2, 1 for descendants
            ASSERT_TRUE(volume == 8 || volume == 4 || volume == 2 || volume == 1) << volume;
            sum += volume;
        }
        ASSERT_EQ(sum, 8);
        if (c.marked.all()) {
            ASSERT_EQ(c.children.size(), 8U);
            for (const Tetrahedron& child : c.children) ASSERT_EQ(doubled_volume(child), 1);
        }
        if (c.marked.count() == 1) {
            for (const Tetrahedron& child : c.children) ASSERT_EQ(doubled_volume(child), 4);
        }
    }
}

TEST(Patterns, OfAllEdgesDoNotAlwaysFanAroundTheMiddleOfLongestAndOpposite) {
    bool some_fan = false;
    bool some_do_not = false;
    for (const Case& c : all_cases()) {
        if (!c.marked.all()) continue;
        const int m = 4 + static_cast<int>(c.order.front());
        const int n = 4 + static_cast<int>(5 - c.order.front());
        const bool fans = std::ranges::all_of(c.triangulation, [&](const Tetrahedron& t) {
            return std::ranges::count(t, m) + std::ranges::count(t, n) == 2;
        });
        (fans ? some_fan : some_do_not) = true;
    }
    EXPECT_TRUE(some_fan);
    EXPECT_TRUE(some_do_not);
}

/// The triangles of a triangulation that lie in face f.
std::set<Triangle> trace(const Triangulation& triangulation, std::size_t f) {
    const auto in_face = [&](int v) {
        if (v < 4) return v != static_cast<int>(f);
        return std::ranges::count(edges_of_face[f], static_cast<std::size_t>(v - 4)) == 1;
    };
    std::set<Triangle> triangles;
    for (const Tetrahedron& cell : triangulation) {
        Triangle triangle{};
        std::size_t count = 0;
        for (const int v : cell) {
            if (in_face(v) && count < 3) triangle[count++] = v;
        }
        if (count == 3) triangles.insert(triangle);
    }
    return triangles;
}

TEST(Patterns, OfTwoCellsThatAgreeOnAFaceMeetThereWhateverTheRest) {
    // Two cells that share a face agree on its marked edges and on its longest edge. If the trace
    // on a face is a function of these, then all pairs of patterns conform. It must also be the
    // bisection of the triangle alone, by which tagged facets are refined.
    std::size_t compared = 0;
    for (const Case& c : all_cases()) {
        for (std::size_t f = 0; f < 4; ++f) {
            Triangle face{};
            std::size_t count = 0;
            for (int v = 0; v < 4; ++v) {
                if (v != static_cast<int>(f)) face[count++] = v;
            }
            EdgeSubset in_face;
            for (const std::size_t e : edges_of_face[f]) in_face[e] = c.marked[e];
            std::set<Triangle> alone;
            for (Triangle piece : bisected<3>(face, in_face, c.order)) {
                std::ranges::sort(piece);
                alone.insert(piece);
            }
            ASSERT_EQ(trace(c.triangulation, f), alone);
            ++compared;
        }
    }
    EXPECT_GT(compared, 10000U);
}

TEST(Patterns, OfATriangleDependOnItsLongestEdgeAndSelectionAlone) {
    std::map<std::tuple<std::size_t, unsigned long>, std::set<Triangle>> known;
    for (const Case& c : all_cases()) {
        EdgeSubset in_face;
        for (const std::size_t e : edges_of_face[3]) in_face[e] = c.marked[e];
        const auto [place, fresh] =
            known.try_emplace({c.face_longest[3], in_face.to_ulong()}, trace(c.triangulation, 3));
        ASSERT_EQ(place->second, trace(c.triangulation, 3));
    }
    EXPECT_EQ(known.size(), 15U);  // 3 longest edges x 5 selections: none, it, +1, +another, all
}

}  // namespace
}  // namespace octetra::reference
