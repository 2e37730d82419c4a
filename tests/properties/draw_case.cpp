#include "properties/draw_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/reference/refine.hpp>

#include "properties/draw_mesh.hpp"
#include "support/refinement.hpp"

namespace octetra::properties {
namespace {

using distributed::PartitionMethod;
using distributed::Synchronisation;

CellIndex any_cell(const Mesh& mesh, Draw& draw) {
    return CellIndex{draw.below(mesh.cells.size())};
}

double extent(const Mesh& mesh) {
    const auto [low, high] = std::ranges::minmax(mesh.points, {}, &Point::x);
    return high.x - low.x;
}

/// An expression that marks some cells.
std::string some_expression(const Mesh& mesh, Draw& draw) {
    const Corners corners = test::corners_of(mesh, any_cell(mesh, draw));
    const Point p = centroid(corners);
    const std::array<std::string, 6> tests{
        fmt::format("x < {}", p.x),       fmt::format("y >= {} or region == 1", p.y),
        fmt::format("not z > {}", p.z),   fmt::format("volume > {}", volume(corners)),
        "min_dihedral < 40 or eta > 0.8", "longest > 1.7 * shortest"};
    const std::string& one = tests[draw.below(tests.size())];
    const std::string& other = tests[draw.below(tests.size())];
    return draw.chance(0.5) ? one : fmt::format("({}) and ({})", one, other);
}

double longest_side(const Corners& corners) {
    double length = 0;
    for (const auto& [i, j] : cell_edges) {
        length = std::max(length, std::sqrt(squared_length({corners[i], corners[j]})));
    }
    return length;
}

std::vector<GlobalCell> some_numbers(const Mesh& mesh, Draw& draw) {
    std::set<GlobalCell> cells;
    const int count = draw.between(1, draw.chance(0.7) ? 2 : 12);
    for (int i = 0; i < count; ++i) cells.insert(GlobalCell{any_cell(mesh, draw).value()});
    return {cells.begin(), cells.end()};
}

/// A sphere about a vertex, as large as a cell at it or as half the mesh.
Sphere some_sphere(const Mesh& mesh, Draw& draw) {
    const Corners corners = test::corners_of(mesh, any_cell(mesh, draw));
    const double radius = draw.chance(0.7) ? longest_side(corners) : extent(mesh) / 2;
    return {corners[0], radius};
}

Box some_box(const Mesh& mesh, Draw& draw) {
    const Point a = mesh.points[mesh.cells[any_cell(mesh, draw)][0]];
    const Point b = mesh.points[mesh.cells[any_cell(mesh, draw)][1]];
    return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
            {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

/// Usually random, so that the border is everywhere.
std::vector<int> some_partition(const Mesh& mesh, int ranks, Draw& draw) {
    const int parts = draw.chance(0.5) ? ranks : draw.between(1, ranks);
    const auto by = [&](PartitionMethod method) {
        return distributed::partition_cells(mesh, parts, {.method = method, .seed = draw.any()});
    };
    switch (draw.below(10)) {
        case 0: return by(PartitionMethod::lepp);
        case 1: return by(PartitionMethod::dual);
        case 2: return by(PartitionMethod::block);
        case 3: {  // a single cell among cells of another rank
            std::vector<int> parts_of_cells(mesh.cells.size(), ranks - 1);
            parts_of_cells[any_cell(mesh, draw).value()] = 0;
            return parts_of_cells;
        }
        default: return by(PartitionMethod::random);
    }
}

int most_levels(std::size_t cells) { return cells < 8 ? 4 : cells < 50 ? 3 : cells < 250 ? 2 : 1; }

// ---- tags
// -----------------------------------------------------------------------------------------

bool has_ties(const Corners& corners) {
    std::set<double> lengths;
    for (const auto& [i, j] : cell_edges) lengths.insert(squared_length({corners[i], corners[j]}));
    return lengths.size() < 6;
}

/// Flatter by orders of magnitude than the cells of lattices and clouds.
bool is_sliver(const Corners& corners) {
    return volume(corners) < 1e-4 * std::pow(longest_side(corners), 3);
}

bool any_cell_is(const Mesh& mesh, bool (*is)(const Corners&)) {
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (is(test::corners_of(mesh, c))) return true;
    }
    return false;
}

/// The number of components, where cells that share this many vertices are connected.
std::size_t pieces(const Mesh& mesh, std::size_t shared_vertices) {
    std::vector<std::size_t> piece(mesh.cells.size());
    for (std::size_t c = 0; c < piece.size(); ++c) piece[c] = c;
    const auto shared = [&](std::size_t c, std::size_t d) {
        std::size_t count = 0;
        for (const VertexIndex v : mesh.cells[CellIndex{c}]) {
            count += static_cast<std::size_t>(std::ranges::count(mesh.cells[CellIndex{d}], v));
        }
        return count;
    };
    for (std::size_t c = 0; c < piece.size(); ++c) {
        for (std::size_t d = 0; d < c; ++d) {
            if (piece[c] == piece[d] || shared(c, d) < shared_vertices) continue;
            const std::size_t joined = piece[d];
            std::ranges::replace(piece, joined, piece[c]);
        }
    }
    return std::set<std::size_t>(piece.begin(), piece.end()).size();
}

bool is_refused(const Case& c) {
    try {
        if (c.closure == Closure::regular) {
            (void)reference::refine_regularly(c.mesh, c.selection, c.levels);
        } else {
            (void)reference::refine(c.mesh, c.selection, c.scheme, c.levels);
        }
        return false;
    } catch (const InputError&) {
        return true;
    }
}

double largest_coordinate(const Mesh& mesh) {
    double largest = 0;
    for (const Point& p : mesh.points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest;
}

}  // namespace

void add_criterion(Selection& selection, const Mesh& mesh, Draw& draw) {
    switch (draw.below(8)) {
        case 0: selection.all = true; return;
        case 1: selection.spheres.push_back(some_sphere(mesh, draw)); return;
        case 2: selection.boxes.push_back(some_box(mesh, draw)); return;
        case 3: selection.regions.push_back(draw.between(0, 3)); return;
        case 4: selection.random = RandomShare{draw.unit() * draw.unit(), draw.any()}; return;
        case 5: {
            const Corners corners = test::corners_of(mesh, any_cell(mesh, draw));
            selection.max_volume = volume(corners) * (0.25 + draw.unit());
            return;
        }
        case 6: selection.where.emplace_back(some_expression(mesh, draw)); return;
        default: selection.cells = some_numbers(mesh, draw);
    }
}

Case draw_case(Draw& draw, int size, int ranks, bool exact) {
    NamedMesh drawn = exact ? draw_exact_mesh(draw, size) : draw_mesh(draw, size);
    Case c{.kind = std::move(drawn.kind), .mesh = std::move(drawn.mesh)};
    add_criterion(c.selection, c.mesh, draw);
    if (draw.chance(0.2)) add_criterion(c.selection, c.mesh, draw);
    if (!c.selection.all && draw.chance(0.1)) {
        c.selection.narrowed_by.push_back({.where = {Expression(some_expression(c.mesh, draw))}});
    }
    if (exact) {
        for (Sphere& sphere : c.selection.spheres) sphere.radius = std::ceil(sphere.radius);
    }
    c.scheme = std::array{Scheme::eight, Scheme::four, Scheme::two}[draw.below(3)];
    c.levels = draw.between(1, most_levels(c.mesh.cells.size()));
    c.synchronisation = draw.chance(0.5) ? Synchronisation::neighbour : Synchronisation::gateway;
    c.cell_to_rank = some_partition(c.mesh, ranks, draw);
    c.seed = draw.any();
    return draw.chance(0.3) ? regular(std::move(c)) : c;
}

const std::vector<std::string>& all_tags() {
    static const std::vector<std::string> tags{
        "ties",     "slivers",      "in pieces",   "joined at edges or vertices only",
        "far off",  "tiny or huge", "regions",     "facets",
        "one cell", "empty ranks",  "many levels", "refused for rounding",
        "regular"};
    return tags;
}

std::vector<std::string> tags_of(const Case& c, int ranks) {
    const Mesh& mesh = c.mesh;
    const double size = extent(mesh);
    const double far = largest_coordinate(mesh);
    const std::set<int> used(c.cell_to_rank.begin(), c.cell_to_rank.end());
    const std::size_t through_vertices = pieces(mesh, 1);
    const std::vector<bool> is{any_cell_is(mesh, has_ties),
                               any_cell_is(mesh, is_sliver),
                               through_vertices > 1,
                               pieces(mesh, 3) > through_vertices,
                               far > 100 * size && far > 100,
                               far < 1e-6 || far > 1e16,
                               !mesh.regions.empty(),
                               !mesh.facets.empty(),
                               mesh.cells.size() == 1,
                               used.size() < static_cast<std::size_t>(ranks),
                               c.levels > 2,
                               is_refused(c),
                               c.closure == Closure::regular};
    std::vector<std::string> tags;
    for (std::size_t i = 0; i < is.size(); ++i) {
        if (is[i]) tags.push_back(all_tags()[i]);
    }
    return tags;
}

}  // namespace octetra::properties
