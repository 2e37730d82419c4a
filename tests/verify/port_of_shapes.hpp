#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>

/// Shapes of cells with small integer coordinates, by the rule of bisection and the order of edges
/// of core: a slow definition of a certificate, written after a program in Python.
namespace octetra::test {

using Corner = std::array<std::int64_t, 3>;
using Tetrahedron = std::array<Corner, 4>;
using EndPoints = std::array<Corner, 2>;  ///< of an edge, ascending

inline Point point_of(const Corner& c) {
    return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

inline EndPoints ends(const Tetrahedron& t, std::size_t edge) {
    const auto [a, b] = cell_edges[edge];
    return {std::min(t[a], t[b]), std::max(t[a], t[b])};
}

inline bool is_longer(const EndPoints& e, const EndPoints& f) {
    return longer({point_of(e[0]), point_of(e[1])}, {point_of(f[0]), point_of(f[1])});
}

inline std::int64_t squared(const EndPoints& e) {
    std::int64_t sum = 0;
    for (std::size_t x = 0; x < 3; ++x) sum += (e[1][x] - e[0][x]) * (e[1][x] - e[0][x]);
    return sum;
}

inline Tetrahedron doubled(Tetrahedron t) {
    for (Corner& c : t) {
        for (std::int64_t& x : c) x *= 2;
    }
    return t;
}

inline void bisect(const Tetrahedron& t, const std::set<EndPoints>& selected,
                   std::vector<Tetrahedron>& pieces) {
    std::size_t longest = 6;
    for (std::size_t e = 0; e < 6; ++e) {
        if (!selected.contains(ends(t, e))) continue;
        if (longest == 6 || is_longer(ends(t, e), ends(t, longest))) longest = e;
    }
    if (longest == 6) return pieces.push_back(t);
    const auto [a, b] = cell_edges[longest];
    Corner midpoint;
    for (std::size_t x = 0; x < 3; ++x) midpoint[x] = (t[a][x] + t[b][x]) / 2;
    Tetrahedron half = t;
    half[b] = midpoint;
    bisect(half, selected, pieces);
    half = t;
    half[a] = midpoint;
    bisect(half, selected, pieces);
}

/// The children of a tetrahedron of twice the size, if these edges are bisected: one bit each.
inline std::vector<Tetrahedron> children(const Tetrahedron& t, unsigned edges) {
    const Tetrahedron large = doubled(t);
    std::set<EndPoints> selected;
    for (std::size_t e = 0; e < 6; ++e) {
        if ((edges >> e & 1U) != 0) selected.insert(ends(large, e));
    }
    std::vector<Tetrahedron> pieces;
    bisect(large, selected, pieces);
    return pieces;
}

inline bool is_closed(const Tetrahedron& t, unsigned edges) {
    for (const auto& [a, b, c] : cell_faces) {
        unsigned of_face = 0;
        std::size_t longest = 6;
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [i, j] = cell_edges[e];
            const auto is_corner = [&, &a = a, &b = b, &c = c](std::size_t k) {
                return k == a || k == b || k == c;
            };
            if (!is_corner(i) || !is_corner(j)) continue;
            of_face |= 1U << e;
            if (longest == 6 || is_longer(ends(t, e), ends(t, longest))) longest = e;
        }
        if ((edges & of_face) != 0 && (edges >> longest & 1U) == 0) return false;
    }
    return true;
}

/// The tetrahedron up to translation and scaling.
inline Tetrahedron placed(Tetrahedron t) {
    std::ranges::sort(t);
    const Corner origin = t[0];
    std::int64_t divisor = 0;
    for (Corner& c : t) {
        for (std::size_t x = 0; x < 3; ++x) {
            c[x] -= origin[x];
            divisor = std::gcd(divisor, c[x]);
        }
    }
    for (Corner& c : t) {
        for (std::int64_t& x : c) x /= divisor;
    }
    return t;
}

/// The tetrahedron up to similarity: the least of its lists of squared lengths, without a common
/// divisor.
inline std::array<std::int64_t, 6> similar(Tetrahedron t) {
    std::array<std::int64_t, 6> best{};
    std::ranges::sort(t);
    do {
        std::array<std::int64_t, 6> lengths{};
        std::int64_t divisor = 0;
        for (std::size_t e = 0; e < 6; ++e) {
            lengths[e] = squared(ends(t, e));
            divisor = std::gcd(divisor, lengths[e]);
        }
        for (std::int64_t& l : lengths) l /= divisor;
        if (best[0] == 0 || lengths < best) best = lengths;
    } while (std::ranges::next_permutation(t).found);
    return best;
}

struct Angles {
    double min_dihedral = 180;
    double max_dihedral = 0;
    double min_eta = 1;
    double min_solid = 4 * std::numbers::pi;

    void add(const Angles& other) {
        min_dihedral = std::min(min_dihedral, other.min_dihedral);
        max_dihedral = std::max(max_dihedral, other.max_dihedral);
        min_eta = std::min(min_eta, other.min_eta);
        min_solid = std::min(min_solid, other.min_solid);
    }
};

inline std::int64_t six_volumes(const Tetrahedron& t) {
    const auto d = [&](std::size_t k, std::size_t x) { return t[k][x] - t[0][x]; };
    return d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) -
           d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0)) +
           d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
}

/// By normals of faces, in long double.
inline Angles angles(const Tetrahedron& t) {
    using Real = long double;
    using Vector = std::array<Real, 3>;
    const auto minus = [](const Corner& a, const Corner& b) {
        return Vector{Real(a[0] - b[0]), Real(a[1] - b[1]), Real(a[2] - b[2])};
    };
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Vector& a, const Vector& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    constexpr Real pi = std::numbers::pi_v<Real>;
    std::array<Real, 4> around{};
    Angles found;
    Real squares = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        const auto [p, q] = cell_edges[5 - k];
        const Vector e = minus(t[j], t[i]);
        const Vector m = cross(e, minus(t[p], t[i]));
        const Vector n = cross(e, minus(t[q], t[i]));
        const Vector mn = cross(m, n);
        const Real angle = std::atan2(std::sqrt(dot(mn, mn)), dot(m, n));
        found.min_dihedral = std::min(found.min_dihedral, static_cast<double>(angle * 180 / pi));
        found.max_dihedral = std::max(found.max_dihedral, static_cast<double>(angle * 180 / pi));
        around[i] += angle;
        around[j] += angle;
        squares += dot(e, e);
    }
    const Real volume = dot(minus(t[1], t[0]), cross(minus(t[2], t[0]), minus(t[3], t[0])));
    found.min_solid = static_cast<double>(std::ranges::min(around) - pi);
    found.min_eta =
        static_cast<double>(std::cbrt(432 * volume * volume / (squares * squares * squares)));
    return found;
}

struct PortedCertificate {
    std::size_t shapes = 0;
    std::size_t placements = 0;
    std::uint32_t generations = 0;
    bool is_closed = false;
    Angles bounds;
};

/// Closes the set of shapes of a tetrahedron up to translation and scaling.
inline PortedCertificate ported_certificate(const Tetrahedron& root, std::size_t limit) {
    std::set<Tetrahedron> all{placed(root)};
    std::set<std::array<std::int64_t, 6>> classes;
    std::vector<Tetrahedron> front{placed(root)};
    PortedCertificate found;
    while (!front.empty() && all.size() <= limit) {
        std::vector<Tetrahedron> next;
        for (const Tetrahedron& t : front) {
            classes.insert(similar(t));
            found.bounds.add(angles(t));
            for (unsigned edges = 1; edges < 63; ++edges) {
                if (!is_closed(t, edges)) continue;
                for (const Tetrahedron& piece : children(t, edges)) found.bounds.add(angles(piece));
            }
            for (const Tetrahedron& child : children(t, 63)) {
                if (all.insert(placed(child)).second) next.push_back(placed(child));
            }
        }
        ++found.generations;
        front = std::move(next);
    }
    found.is_closed = front.empty();
    found.shapes = classes.size();
    found.placements = all.size();
    return found;
}

}  // namespace octetra::test
