#include "properties/simpler.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <octetra/core/orientation.hpp>
#include <octetra/verify/verify.hpp>

#include "properties/histories/simpler_steps.hpp"
#include "properties/one_level.hpp"
#include "properties/submesh.hpp"

namespace octetra::properties {
namespace {

using Simplifications = std::vector<std::function<Case()>>;
using Shared = std::shared_ptr<const Case>;

void add(Simplifications& all, const Shared& from, const std::function<void(Case&)>& change) {
    all.emplace_back([from, change] {
        Case c = *from;
        change(c);
        return c;
    });
}

void drop_cells(Selection& selection, std::size_t begin, std::size_t end) {
    std::vector<GlobalCell> cells;
    for (const GlobalCell cell : selection.cells) {
        const auto number = static_cast<std::size_t>(cell);
        if (number < begin) cells.push_back(cell);
        if (number >= end) cells.push_back(GlobalCell{number - (end - begin)});
    }
    selection.cells = std::move(cells);
}

void drop_cells(Case& c, std::size_t begin, std::size_t end) {
    std::vector<char> keep(c.mesh.cells.size(), 1);
    std::fill(keep.begin() + static_cast<std::ptrdiff_t>(begin),
              keep.begin() + static_cast<std::ptrdiff_t>(end), char{0});
    c.mesh = submesh(c.mesh, keep);
    const auto at = [&](std::size_t i) {
        return c.cell_to_rank.begin() + static_cast<std::ptrdiff_t>(i);
    };
    c.cell_to_rank.erase(at(begin), at(end));
    drop_cells(c.selection, begin, end);
    for (Step& step : c.steps) drop_cells(step.selection, begin, end);
}

/// Calls `visit` with halves of the range, then quarters and so on, down to single items.
void for_each_chunk(std::size_t count, const std::function<void(std::size_t, std::size_t)>& visit) {
    for (std::size_t length = count / 2; length > 0; length /= 2) {
        for (std::size_t begin = 0; begin < count; begin += length) {
            visit(begin, std::min(begin + length, count));
        }
    }
}

void add_fewer_cells(Simplifications& all, const Shared& c) {
    for_each_chunk(c->mesh.cells.size(), [&](std::size_t begin, std::size_t end) {
        add(all, c, [=](Case& r) { drop_cells(r, begin, end); });
    });
}

void add_fewer_criteria(Simplifications& all, const Shared& c) {
    const Selection& s = c->selection;
    const bool by_number_alone = !s.all && s.spheres.empty() && s.boxes.empty() &&
                                 s.regions.empty() && !s.random && !s.max_volume &&
                                 s.where.empty() && s.narrowed_by.empty();
    if (by_number_alone) {
        for_each_chunk(s.cells.size(), [&](std::size_t begin, std::size_t end) {
            add(all, c, [=](Case& r) {
                auto& cells = r.selection.cells;
                cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(begin),
                            cells.begin() + static_cast<std::ptrdiff_t>(end));
            });
        });
        return;
    }
    add(all, c, [](Case& r) {  // the cells marked at the first level
        Selection by_number;
        for (CellIndex i{0}; i < r.mesh.cells.end_index(); ++i) {
            if (is_marked(r, i)) by_number.cells.push_back(GlobalCell{i.value()});
        }
        r.selection = std::move(by_number);
    });
    if (!s.cells.empty()) add(all, c, [](Case& r) { r.selection.cells.clear(); });
    if (!s.spheres.empty()) add(all, c, [](Case& r) { r.selection.spheres.clear(); });
    if (!s.boxes.empty()) add(all, c, [](Case& r) { r.selection.boxes.clear(); });
    if (!s.regions.empty()) add(all, c, [](Case& r) { r.selection.regions.clear(); });
    if (s.random) add(all, c, [](Case& r) { r.selection.random.reset(); });
    if (s.max_volume) add(all, c, [](Case& r) { r.selection.max_volume.reset(); });
    if (!s.where.empty()) add(all, c, [](Case& r) { r.selection.where.clear(); });
    if (!s.narrowed_by.empty()) add(all, c, [](Case& r) { r.selection.narrowed_by.clear(); });
}

void add_fewer_ranks(Simplifications& all, const Shared& c) {
    const int last = c->cell_to_rank.empty() ? 0 : std::ranges::max(c->cell_to_rank);
    for (int to = 0; to < last; ++to) {
        add(all, c, [=](Case& r) { std::ranges::replace(r.cell_to_rank, last, to); });
    }
    for (std::size_t i = 0; i < c->cell_to_rank.size(); ++i) {
        if (c->cell_to_rank[i] > 0) add(all, c, [=](Case& r) { r.cell_to_rank[i] = 0; });
    }
}

void add_fewer_marks(Simplifications& all, const Shared& c) {
    const Mesh& mesh = c->mesh;
    if (!mesh.regions.empty()) add(all, c, [](Case& r) { r.mesh.regions.clear(); });
    if (!mesh.point_markers.empty()) add(all, c, [](Case& r) { r.mesh.point_markers.clear(); });
    if (mesh.attributes_per_point > 0) {
        add(all, c, [](Case& r) {
            r.mesh.attributes_per_point = 0;
            r.mesh.point_attributes.clear();
        });
    }
    if (!mesh.facets.empty()) {
        add(all, c, [](Case& r) {
            r.mesh.facets.clear();
            r.mesh.facet_markers.clear();
        });
    }
    if (!mesh.edges.empty()) {
        add(all, c, [](Case& r) {
            r.mesh.edges.clear();
            r.mesh.edge_markers.clear();
        });
    }
    if (mesh.index_base != 0) add(all, c, [](Case& r) { r.mesh.index_base = 0; });
}

bool is_valid(const Mesh& mesh) {
    for (const auto& [i, j, k, l] : mesh.cells) {
        const auto& p = mesh.points;
        if (orientation(p[i], p[j], p[k], p[l]) <= 0) return false;
    }
    return verify::verify_mesh(mesh).valid();
}

/// Rounds coordinates to this number of binary digits, if the mesh stays valid.
void round_coordinates(Case& c, int digits) {
    Mesh rounded = c.mesh;
    const auto round_one = [&](double& x) {
        int exponent = 0;
        x = std::ldexp(std::round(std::ldexp(std::frexp(x, &exponent), digits)), exponent - digits);
    };
    for (Point& p : rounded.points) {
        round_one(p.x);
        round_one(p.y);
        round_one(p.z);
    }
    if (is_valid(rounded)) c.mesh = std::move(rounded);
}

/// Scales by a power of two, so that the largest coordinate is about 1.
void add_usual_size(Simplifications& all, const Shared& c) {
    double largest = 0;
    for (const Point& p : c->mesh.points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const int exponent = std::ilogb(largest);
    if (std::abs(exponent) < 60) return;
    add(all, c, [=](Case& r) {
        for (Point& p : r.mesh.points) {
            p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent),
                 std::ldexp(p.z, -exponent)};
        }
    });
}

void add_rounder_coordinates(Simplifications& all, const Shared& c) {
    for (const int digits : {2, 4, 8, 16, 26}) {
        Case rounded = *c;
        round_coordinates(rounded, digits);
        if (rounded.mesh == c->mesh) continue;
        all.emplace_back([rounded] { return rounded; });
        return;
    }
}

}  // namespace

Simplifications simplifications(const Case& c) {
    const auto shared = std::make_shared<const Case>(c);
    Simplifications all;
    add_fewer_cells(all, shared);
    for (std::vector<Step>& steps : simpler_steps(c.steps)) {
        add(all, shared, [steps = std::move(steps)](Case& r) { r.steps = steps; });
    }
    if (c.levels > 1) add(all, shared, [](Case& r) { --r.levels; });
    add_fewer_criteria(all, shared);
    if (c.scheme != Scheme::eight) add(all, shared, [](Case& r) { r.scheme = Scheme::eight; });
    if (c.closure != Closure::longest_edge) {
        add(all, shared, [](Case& r) { r.closure = Closure::longest_edge; });
    }
    if (c.synchronisation != distributed::Synchronisation::neighbour) {
        add(all, shared,
            [](Case& r) { r.synchronisation = distributed::Synchronisation::neighbour; });
    }
    add_fewer_ranks(all, shared);
    add_fewer_marks(all, shared);
    add_usual_size(all, shared);
    if (c.mesh.cells.size() < 20) add_rounder_coordinates(all, shared);
    return all;
}

Case simplest(Case c, const std::function<Trial(const Case&)>& attempt) {
    Simplifications ways = simplifications(c);
    std::size_t way = 0;
    // A simplification that fails is often followed by a similar one that does, so the search
    // continues from the current position; it ends after a full cycle without a failure.
    for (std::size_t held = 0; held < ways.size();) {
        way %= ways.size();
        Case simpler = ways[way]();
        const Trial trial = attempt(simpler);
        if (trial == Trial::not_made) break;
        if (trial == Trial::holds) {
            ++held;
            ++way;
            continue;
        }
        c = std::move(simpler);
        ways = simplifications(c);
        held = 0;
    }
    return c;
}

}  // namespace octetra::properties
