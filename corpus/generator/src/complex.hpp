#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

/// A piecewise linear complex, the input of TetGen. Points are numbered from 0.
namespace octetra::generator {

/// A ring of points; the last is joined to the first.
using Polygon = std::vector<std::uint32_t>;

/// A planar facet: the region bounded by its polygons, without the holes, each given by an interior
/// point.
struct PlaneFacet {
    std::vector<Polygon> polygons = {};
    std::vector<Point> holes = {};
    Marker marker = 1;
};

/// An edge of the complex that the mesh must contain.
struct Ridge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    Marker marker = 1;
};

/// A part of the volume, given by an interior point.
struct Region {
    Point seed;
    Marker tag = 0;
};

struct Complex {
    std::vector<Point> points;
    std::vector<PlaneFacet> facets;
    std::vector<Ridge> ridges;
    std::vector<Region> regions;  ///< all regions; if empty, the mesh has no region tags

    /// Appends a point, and returns its number.
    std::uint32_t add(const Point& point) {
        points.push_back(point);
        return static_cast<std::uint32_t>(points.size() - 1);
    }
};

}  // namespace octetra::generator
