#include "properties/shapes.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <octetra/core/error.hpp>
#include <octetra/generator/clouds.hpp>
#include <octetra/generator/lattices.hpp>

#include "support/meshes.hpp"
#include "tetrahedralise.hpp"  // the generator's own: any complex, not just its solids

namespace octetra::properties {
namespace {

std::size_t points_of(int size) { return 5 + static_cast<std::size_t>(size) / 3; }

/// The Delaunay mesh of `count` points drawn by `point`.
Mesh delaunay(std::size_t count, const std::function<Point()>& point) {
    generator::Complex cloud;
    for (std::size_t i = 0; i < count; ++i) cloud.add(point());
    Mesh mesh = generator::tetrahedralise(cloud, "");
    mesh.facets.clear();
    mesh.facet_markers.clear();
    return mesh;
}

Mesh cloud(Draw& draw, int size) {
    return delaunay(points_of(size), [&] { return Point{draw.unit(), draw.unit(), draw.unit()}; });
}

/// Many points on one sphere or in one plane; some are duplicates, which TetGen omits.
Mesh lattice_points(Draw& draw, int size) {
    const int n = 2 + size / 40;
    const auto whole = [&] { return static_cast<double>(draw.between(0, n)); };
    return delaunay(points_of(size), [&] { return Point{whole(), whole(), whole()}; });
}

Mesh sphere_points(Draw& draw, int size) {
    return delaunay(points_of(size), [&] {
        const double z = 2 * draw.unit() - 1;
        const double angle = 2 * std::numbers::pi * draw.unit();
        const double radius = std::sqrt(1 - z * z);
        return Point{radius * std::cos(angle), radius * std::sin(angle), z};
    });
}

/// Points that become denser towards the origin.
Mesh graded_points(Draw& draw, int size) {
    const auto near_zero = [&] { return std::pow(draw.unit(), 4) * (draw.chance(0.5) ? 1 : -1); };
    return delaunay(points_of(size), [&] { return Point{near_zero(), near_zero(), near_zero()}; });
}

Mesh slivers(Draw& draw, int size) { return generator::slivers(size < 50 ? 2 : 3, draw.any()); }

Mesh lattice(Draw& draw, int size) {
    const int most = 1 + size / 40;
    const auto count = [&] { return static_cast<std::size_t>(draw.between(1, most)); };
    return test::kuhn(count(), count(), count());
}

Mesh shaken_lattice(Draw& draw, int size) {
    const double amount = draw.chance(0.5) ? 0.2 : 0x1p-20;
    return test::perturbed_kuhn(1 + static_cast<std::size_t>(size) / 50, amount, draw.any());
}

Mesh centred_lattice(Draw& /*draw*/, int size) { return generator::bcc(size < 80 ? 1 : 2); }

/// A star-shaped polygon extruded to one to three layers, each of which is a region.
Mesh prism(Draw& draw, int size) {
    const auto corners = static_cast<std::uint32_t>(draw.between(3, 4 + size / 20));
    const auto layers = static_cast<std::uint32_t>(draw.between(1, 3));
    generator::Complex complex;
    std::vector<Point> outline;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5 * draw.unit()) / corners;
        const double radius = 0.5 + draw.unit();
        outline.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    double z = 0;
    for (std::uint32_t layer = 0; layer <= layers; ++layer) {
        for (const Point& p : outline) complex.add({p.x, p.y, z});
        generator::Polygon ring;
        for (std::uint32_t i = 0; i < corners; ++i) ring.push_back(layer * corners + i);
        complex.facets.push_back({.polygons = {ring}, .marker = static_cast<Marker>(layer) + 2});
        const double height = 0.1 + draw.unit();
        if (layer == layers) break;
        complex.regions.push_back({{0, 0, z + height / 2}, static_cast<Marker>(layer) + 1});
        for (std::uint32_t i = 0; i < corners; ++i) {
            const std::uint32_t a = layer * corners + i;
            const std::uint32_t b = layer * corners + (i + 1) % corners;
            complex.facets.push_back({.polygons = {{a, b, b + corners, a + corners}}});
        }
        z += height;
    }
    return generator::tetrahedralise(complex, draw.chance(0.8) ? "pA" : "pAq1.6");
}

struct Shape {
    const char* kind;
    Mesh (*make)(Draw&, int);
};

constexpr std::array<Shape, 9> shapes{{{"cloud", cloud},
                                       {"lattice points", lattice_points},
                                       {"sphere points", sphere_points},
                                       {"graded points", graded_points},
                                       {"slivers", slivers},
                                       {"lattice", lattice},
                                       {"shaken lattice", shaken_lattice},
                                       {"centred lattice", centred_lattice},
                                       {"prism", prism}}};

}  // namespace

NamedMesh draw_shape(Draw& draw, int size) {
    const Shape& shape = shapes[draw.below(shapes.size())];
    try {
        return {shape.kind, shape.make(draw, size)};
    } catch (const InputError&) {
        return {"lattice", lattice(draw, size)};
    }
}

}  // namespace octetra::properties
