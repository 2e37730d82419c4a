#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/meshes.hpp"

/// Meshes of about n cells with one common edge or vertex, with coordinates on a grid of 2^-20.
namespace octetra::test {

inline double on_grid(double x) { return std::round(x * 0x1p20) * 0x1p-20; }
inline Point on_grid(double x, double y, double z) { return {on_grid(x), on_grid(y), on_grid(z)}; }

/// Cells around the edge from (0, 0, -1) to (0, 0, 1), over this fraction of a turn; every
/// `every`-th is omitted. (0: none.)
inline Mesh cells_around_edge(std::size_t n, double turns, std::size_t every) {
    const bool closed = turns == 1;
    std::vector<Point> points{{0, 0, -1}, {0, 0, 1}};
    const std::size_t ring = closed ? n : n + 1;
    for (std::size_t i = 0; i < ring; ++i) {
        const double angle =
            2 * std::numbers::pi * turns * static_cast<double>(i) / static_cast<double>(n);
        points.push_back(on_grid(std::cos(angle), std::sin(angle), 0.25));
    }
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t i = 0; i < n; ++i) {
        if (every != 0 && i % every == 0) continue;
        cells.push_back({0, 1, 2 + i, 2 + (i + 1) % ring});
    }
    return mesh_of(points, cells);
}

/// Cells around that edge whose other corners are at random distances and heights.
inline Mesh rough_cells_around_edge(std::size_t n) {
    Mesh mesh = cells_around_edge(n, 1, 0);
    std::mt19937_64 random(31);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 1024) / 1024;
    };
    for (VertexIndex v{2}; v < mesh.points.end_index(); ++v) {
        Point& p = mesh.points[v];
        const double radius = between(0.5, 1);
        p = on_grid(p.x * radius, p.y * radius, between(-0.5, 0.5));
    }
    return mesh;
}

/// A triangulated sphere joined with an inner point; triangles below `lowest`, and every
/// `every`-th, are omitted. (0: none.)
inline Mesh cells_at_vertex(std::size_t n, double lowest, std::size_t every) {
    const auto rings = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 4)) + 1;
    const std::size_t segments = 2 * rings;
    std::vector<Point> points{{0, 0, 0}, {0, 0, 1}};
    for (std::size_t i = 1; i < rings; ++i) {
        const double theta = std::numbers::pi * static_cast<double>(i) / static_cast<double>(rings);
        for (std::size_t k = 0; k < segments; ++k) {
            const double phi = 2 * std::numbers::pi *
                               (static_cast<double>(k) + (i % 2 == 0 ? 0 : 0.5)) /
                               static_cast<double>(segments);
            points.push_back(on_grid(std::sin(theta) * std::cos(phi),
                                     std::sin(theta) * std::sin(phi), std::cos(theta)));
        }
    }
    points.push_back({0, 0, -1});
    std::vector<std::array<std::size_t, 4>> cells;
    std::size_t triangles = 0;
    const auto append = [&](std::size_t a, std::size_t b, std::size_t c) {
        if (every != 0 && ++triangles % every == 0) return;
        if (std::min({points[a].z, points[b].z, points[c].z}) < lowest) return;
        cells.push_back({0, a, b, c});
    };
    const auto at = [&](std::size_t i, std::size_t k) {
        return 2 + (i - 1) * segments + k % segments;
    };
    for (std::size_t k = 0; k < segments; ++k) {
        append(1, at(1, k), at(1, k + 1));
        append(points.size() - 1, at(rings - 1, k), at(rings - 1, k + 1));
        for (std::size_t i = 1; i + 1 < rings; ++i) {
            // Odd rings are shifted by half a segment.
            const std::size_t ahead = i % 2 == 0 ? 0 : 1;
            append(at(i, k), at(i, k + 1), at(i + 1, k + ahead));
            append(at(i + 1, k), at(i + 1, k + 1), at(i, k + 1 - ahead));
        }
    }
    Mesh mesh = mesh_of(points, cells);
    drop_unused(mesh);
    return mesh;
}

/// A triangulated square joined with a point close above it.
inline Mesh flat_cone(std::size_t n) {
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 2));
    std::vector<Point> points{{0.5, 0.5, 0x1p-10}};
    const double step = 1 / static_cast<double>(side);
    for (std::size_t i = 0; i <= side; ++i) {
        for (std::size_t k = 0; k <= side; ++k) {
            points.push_back(
                on_grid(static_cast<double>(i) * step, static_cast<double>(k) * step, 0));
        }
    }
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t i = 0; i < side; ++i) {
        for (std::size_t k = 0; k < side; ++k) {
            const std::size_t low = 1 + i * (side + 1) + k;
            cells.push_back({0, low, low + 1, low + side + 1});
            cells.push_back({0, low + 1, low + side + 1, low + side + 2});
        }
    }
    return mesh_of(points, cells);
}

struct Hub {
    std::string name;
    Mesh (*make)(std::size_t cells);
};

inline const std::vector<Hub> hubs{
    {"ClosedAroundAnEdge", [](std::size_t n) { return cells_around_edge(n, 1, 0); }},
    {"OpenAroundAnEdge", [](std::size_t n) { return cells_around_edge(n, 0.7, 0); }},
    {"WithGapsAroundAnEdge", [](std::size_t n) { return cells_around_edge(n, 1, 4); }},
    {"ClosedAtAVertex", [](std::size_t n) { return cells_at_vertex(n, -1, 0); }},
    {"OpenAtAVertex", [](std::size_t n) { return cells_at_vertex(n, -0.25, 0); }},
    {"WithGapsAtAVertex", [](std::size_t n) { return cells_at_vertex(n, -1, 7); }},
    {"FlatAtAVertex", flat_cone},
};

}  // namespace octetra::test
