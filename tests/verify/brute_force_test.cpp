#include <algorithm>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <octetra/verify/verify.hpp>

#include "support/meshes.hpp"
#include "verify/mutations.hpp"
#include "verify/verdicts.hpp"

/// Compares the certificate with the definition: every pair of cells is inspected, in integers.
namespace octetra::verify {
namespace {

using test::codes_of;
using Vector = std::array<std::int64_t, 3>;
using Tetrahedron = std::array<Vector, 4>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
std::int64_t dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
std::int64_t volume(const Tetrahedron& t) {
    return dot(cross(minus(t[1], t[0]), minus(t[2], t[0])), minus(t[3], t[0]));
}

/// The corners of a cell, times eight. Coordinates are small integers or eighths.
Tetrahedron tetrahedron(const Mesh& mesh, const CellVertices& cell) {
    Tetrahedron t;
    for (std::size_t k = 0; k < 4; ++k) {
        const Point& p = mesh.points[cell[k]];
        t[k] = {static_cast<std::int64_t>(8 * p.x), static_cast<std::int64_t>(8 * p.y),
                static_cast<std::int64_t>(8 * p.z)};
    }
    return t;
}

/// Normals of candidate separating planes of two tetrahedra: those of faces, and those along edges
/// of both.
std::vector<Vector> candidate_normals(const Tetrahedron& s, const Tetrahedron& t) {
    std::vector<Vector> normals;
    for (const Tetrahedron* one : {&s, &t}) {
        for (const auto& [i, j, k] : cell_faces) {
            normals.push_back(cross(minus((*one)[j], (*one)[i]), minus((*one)[k], (*one)[i])));
        }
    }
    for (const auto& [i, j] : cell_edges) {
        for (const auto& [k, l] : cell_edges) {
            normals.push_back(cross(minus(s[j], s[i]), minus(t[l], t[k])));
        }
    }
    return normals;
}

/// Two convex bodies have disjoint interiors if and only if some plane separates them; for
/// polyhedra one of the candidates does.
bool interiors_are_disjoint(const Tetrahedron& s, const Tetrahedron& t) {
    for (const Vector& n : candidate_normals(s, t)) {
        if (n == Vector{0, 0, 0}) continue;
        std::array<std::int64_t, 4> of_s;
        std::array<std::int64_t, 4> of_t;
        for (std::size_t k = 0; k < 4; ++k) {
            of_s[k] = dot(n, s[k]);
            of_t[k] = dot(n, t[k]);
        }
        const auto [low_s, high_s] = std::minmax_element(of_s.begin(), of_s.end());
        const auto [low_t, high_t] = std::minmax_element(of_t.begin(), of_t.end());
        if (*high_s <= *low_t || *high_t <= *low_s) return true;
    }
    return false;
}

int sign(std::int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

int side(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    return sign(volume({a, b, c, d}));
}

bool holds(const Tetrahedron& t, const Vector& p) {
    for (std::size_t k = 0; k < 4; ++k) {
        Tetrahedron with_p = t;
        with_p[k] = p;
        if (volume(with_p) < 0) return false;
    }
    return true;
}

/// Returns whether two closed segments meet.
bool segments_meet(const Vector& p, const Vector& q, const Vector& a, const Vector& b) {
    const Vector n = cross(minus(q, p), minus(b, a));
    if (n == Vector{0, 0, 0}) return false;  // parallel: then an end of one lies on the other
    if (dot(n, minus(a, p)) != 0) return false;
    // In the plane with this normal: the ends of each are on different sides of the other.
    const auto turn = [&](const Vector& u, const Vector& v, const Vector& w) {
        return sign(dot(n, cross(minus(v, u), minus(w, u))));
    };
    return turn(p, q, a) * turn(p, q, b) <= 0 && turn(a, b, p) * turn(a, b, q) <= 0;
}

/// Returns whether an edge passes through a triangle from one side to the other.
bool pierces(const Vector& p, const Vector& q, const std::array<Vector, 3>& t) {
    if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) >= 0) return false;
    const int ab = side(p, q, t[0], t[1]);
    const int bc = side(p, q, t[1], t[2]);
    const int ca = side(p, q, t[2], t[0]);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool has(const CellVertices& cell, VertexIndex v) {
    return std::find(cell.begin(), cell.end(), v) != cell.end();
}

/// Returns whether two cells conform: no vertex of one lies in the other unless they share it, no
/// edge of one passes through an edge or face of the other that shares no vertex with it, and
/// interiors are disjoint.
bool conform(const Mesh& mesh, const CellVertices& c, const CellVertices& d) {
    const Tetrahedron s = tetrahedron(mesh, c);
    const Tetrahedron t = tetrahedron(mesh, d);
    for (std::size_t k = 0; k < 4; ++k) {
        if (!has(d, c[k]) && holds(t, s[k])) return false;
    }
    for (const auto& [i, j] : cell_edges) {
        const EdgeVertices edge{c[i], c[j]};
        const auto of_edge = [&](VertexIndex v) { return v == edge[0] || v == edge[1]; };
        for (const auto& [k, l, m] : cell_faces) {
            if (of_edge(d[k]) || of_edge(d[l]) || of_edge(d[m])) continue;
            if (pierces(s[i], s[j], {t[k], t[l], t[m]})) return false;
        }
        for (const auto& [k, l] : cell_edges) {
            if (of_edge(d[k]) || of_edge(d[l])) continue;
            if (segments_meet(s[i], s[j], t[k], t[l])) return false;
        }
    }
    return interiors_are_disjoint(s, t);
}

/// Returns whether the mesh is valid, from all vertices, cells and pairs.
bool is_valid_by_brute_force(const Mesh& mesh) {
    std::vector<char> used(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j] : cell_edges) {
            if (cell[i] == cell[j]) return false;
        }
        if (volume(tetrahedron(mesh, cell)) <= 0) return false;
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        for (std::size_t w = 0; w < v; ++w) {
            if (used[v] == 0 || used[w] == 0) continue;
            if (mesh.points[VertexIndex{v}] == mesh.points[VertexIndex{w}]) return false;
        }
    }
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (CellIndex d{0}; d < mesh.cells.end_index(); ++d) {
            if (c != d && !conform(mesh, mesh.cells[c], mesh.cells[d])) return false;
        }
    }
    return true;
}

/// Appends a cell between any four vertices, in most cases one that crosses others.
void append_random_cell(Mesh& mesh, std::mt19937_64& random) {
    CellVertices cell;
    for (VertexIndex& v : cell) v = VertexIndex{random() % mesh.points.size()};
    const auto six_volumes = volume(tetrahedron(mesh, cell));
    if (six_volumes == 0) return;
    if (six_volumes < 0) std::swap(cell[0], cell[1]);
    for (std::size_t c = mesh.cells.size(); c-- > 0;) {
        const auto common = std::count_if(cell.begin(), cell.end(), [&](VertexIndex v) {
            return has(mesh.cells[CellIndex{c}], v);
        });
        if (common >= 3 || (common >= 2 && random() % 2 == 0)) test::drop_cell(mesh, CellIndex{c});
    }
    mesh.cells.push_back(cell);
}

/// Modifies a mesh at random, or not at all. Coordinates stay small integers or, by successive
/// bisection, eighths.
void mutate(Mesh& mesh, std::mt19937_64& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const VertexIndex v{below(mesh.points.size())};
    const CellIndex c{below(mesh.cells.size())};
    const auto step = [&] { return static_cast<double>(below(9)) - 4; };
    switch (below(12)) {
        case 0:
        case 1:
        case 2: {
            Point& p = mesh.points[v];
            p = {p.x + step(), p.y + step(), p.z + step()};
            break;
        }
        case 3: test::drop_cell(mesh, c); break;
        case 4: test::duplicate_cell(mesh, c); break;
        case 5: test::flip_cell(mesh, c); break;
        case 6: test::replace_corner(mesh, c, below(4), v); break;
        case 7: test::unmerge_vertex(mesh, c, below(4)); break;
        case 8: test::bisect_alone(mesh, c, below(6)); break;
        default: append_random_cell(mesh, random); break;
    }
}

TEST(BruteForce, AgreesWithTheCertificateOnValidAndBrokenMeshes) {
    std::mt19937_64 random(20240);
    int valid = 0;
    int broken = 0;
    for (int round = 0; round < 1500; ++round) {
        // A side of 4 leaves room for halves, and for moves that preserve validity.
        Mesh mesh = round % 2 == 0 ? test::kuhn(2, 2, 1, 4) : test::kuhn(1, 1, 1, 4);
        const std::size_t mutations = 1 + random() % 3;
        for (std::size_t i = 0; i < mutations; ++i) mutate(mesh, random);
        if (round % 5 != 0) test::drop_unused(mesh);
        const Verdict verdict = verify_mesh(mesh);
        const bool expected = is_valid_by_brute_force(mesh);
        ASSERT_EQ(verdict.valid(), expected) << "round " << round << ": " << codes_of(verdict);
        ++(expected ? valid : broken);
    }
    EXPECT_GT(valid, 150);
    EXPECT_GT(broken, 400);
}

/// Two arbitrary cells, which may cross without a vertex of one in the other.
TEST(BruteForce, AgreesWithTheCertificateOnTwoCellsAnywhere) {
    std::mt19937_64 random(7);
    int crossing = 0;
    int apart = 0;
    for (int round = 0; round < 6000; ++round) {
        std::vector<Point> points;
        for (int k = 0; k < 8; ++k) {
            const auto coordinate = [&] { return static_cast<double>(random() % 7); };
            const double x = coordinate();
            const double y = coordinate();
            points.push_back({x, y, coordinate()});
        }
        // With 4 to 8 distinct vertices the cells may share some.
        const std::size_t shared = random() % 4;
        Mesh mesh =
            test::mesh_of(points, {{0, 1, 2, 3}, {4 - shared, 5 - shared, 6 - shared, 7 - shared}});
        test::drop_unused(mesh);
        const Verdict verdict = verify_mesh(mesh);
        const bool expected = is_valid_by_brute_force(mesh);
        ASSERT_EQ(verdict.valid(), expected) << "round " << round << ": " << codes_of(verdict);
        if (verdict.count(Code::boundary_crosses) > 0) ++crossing;
        if (expected) ++apart;
    }
    EXPECT_GT(crossing, 50);
    EXPECT_GT(apart, 50);
}

}  // namespace
}  // namespace octetra::verify
