#include <octetra/distributed/predicted_cells.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <octetra/core/standard_arithmetic.hpp>

#include "mark/selection_bounds.hpp"

namespace octetra::distributed {
namespace {

double children_per_level(Scheme scheme) {
    switch (scheme) {
        case Scheme::eight: return 8;
        case Scheme::four: return 4;
        case Scheme::two: return 2;
    }
    return 1;
}

Point middle(const Point& p, const Point& q) {
    return {p.x / 2 + q.x / 2, p.y / 2 + q.y / 2, p.z / 2 + q.z / 2};
}

/// Returns eight subcells of equal volume.
std::array<Corners, 8> eighths(const Corners& corners) {
    const auto& [a, b, c, d] = corners;
    const Point ab = middle(a, b);
    const Point ac = middle(a, c);
    const Point ad = middle(a, d);
    const Point bc = middle(b, c);
    const Point bd = middle(b, d);
    const Point cd = middle(c, d);
    return {{{a, ab, ac, ad},
             {ab, b, bc, bd},
             {ac, bc, c, cd},
             {ad, bd, cd, d},
             {ac, bd, ab, bc},
             {ac, bd, bc, cd},
             {ac, bd, cd, ad},
             {ac, bd, ad, ab}}};
}

/// The spheres and boxes of a selection, which mark cells by position alone.
class Bodies {
public:
    explicit Bodies(const Selection& selection) {
        all_.spheres = selection.spheres;
        all_.boxes = selection.boxes;
        for (const Sphere& sphere : selection.spheres) each_.push_back({.spheres = {sphere}});
        for (const Box& box : selection.boxes) each_.push_back({.boxes = {box}});
    }
    [[nodiscard]] bool may_intersect(const Corners& corners) const {
        return may_be_marked(all_, box_of(corners));
    }
    /// Returns whether one body contains the cell: bodies are convex, so it suffices to test the
    /// corners.
    [[nodiscard]] bool contain(const Corners& corners) const {
        return std::ranges::any_of(each_, [&](const Selection& body) {
            return std::ranges::all_of(corners, [&](const Point& p) {
                return marks(body, {p, p, p, p}, 0, GlobalCell{0});
            });
        });
    }
    [[nodiscard]] bool empty() const { return each_.empty(); }
    /// Returns the bounds of all bodies.
    [[nodiscard]] SelectionBounds bounds() const { return SelectionBounds(all_); }
    [[nodiscard]] bool have(const Corners& corners) const {
        return marks(all_, corners, 0, GlobalCell{0});
    }
    /// Returns the fraction of a cell that is inside any body, from 8^depth samples.
    [[nodiscard]] double fraction_inside(const Corners& corners, int depth) const {
        if (depth == 0) return have(corners) ? 1 : 0;
        double sum = 0;
        for (const Corners& piece : eighths(corners)) sum += fraction_inside(piece, depth - 1);
        return sum / 8;
    }

private:
    Selection all_;
    std::vector<Selection> each_;
};

/// Returns the sampling depth for `cut` cells, such that sampling takes less time than processing
/// the other cells.
int depth_for(std::uint64_t cut, std::uint64_t cells) {
    constexpr int most = 5;
    const std::uint64_t samples = std::max(cells / 4, std::uint64_t{1} << 15U);
    int depth = 0;
    for (std::uint64_t n = 8 * cut; n <= samples && depth < most; n *= 8) ++depth;
    return depth;
}

/// Accumulates predictions of several criteria: for each cell, the largest one counts.
class Prediction {
public:
    Prediction(const CellsToWeigh& cells, Scheme scheme, int levels)
        : cells_(&cells),
          children_per_level_(children_per_level(scheme)),
          levels_(levels),
          full_(std::min(std::pow(children_per_level_, levels), max_children)),
          expected_(cells.count(), 1) {}

    void add_at_random(double share) {
        const double of_all = std::pow(1 + share * (children_per_level_ - 1), levels_);
        std::ranges::fill(expected_, static_cast<float>(std::min(of_all, full_)));
    }

    void add_tagged(const Selection& selection) {
        if (selection.regions.empty() && selection.cells.empty()) return;
        Selection by_tag;
        by_tag.cells = selection.cells;
        by_tag.regions = selection.regions;
        for (std::size_t i = 0; i < cells_->count(); ++i) {
            const Marker region = cells_->regions.empty() ? 0 : cells_->regions[i];
            if (marks(by_tag, {}, region, GlobalCell{cells_->first_number + i})) expect(i, full_);
        }
    }

    void add_larger_than(double limit) {
        for (std::size_t i = 0; i < cells_->count(); ++i) {
            const double times = volume(cells_->corners(i)) / limit;
            double cells = 1;
            while (cells < times && cells < full_) cells *= children_per_level_;
            expect(i, cells);
        }
    }

    /// Adds the cells that are inside a single body. Returns the cells that are perhaps partly
    /// inside, whose fractions remain to be computed.
    [[nodiscard]] std::vector<std::size_t> add_wholly_inside(const Bodies& bodies) {
        std::vector<std::uint8_t> beyond;  // of each point, as corners are scattered in memory
        beyond.reserve(cells_->points.size());
        const SelectionBounds bounds = bodies.bounds();
        for (const Point& p : cells_->points) beyond.push_back(bounds.sides_beyond(p));
        std::vector<std::size_t> cut;
        for (std::size_t i = 0; i < cells_->count(); ++i) {
            const auto& [a, b, c, d] = cells_->cells[i];
            if ((beyond[a.value()] & beyond[b.value()] & beyond[c.value()] & beyond[d.value()]) !=
                0) {
                continue;
            }
            const Corners corners = cells_->corners(i);
            if (!bodies.may_intersect(corners)) continue;
            if (bodies.contain(corners)) {
                expect(i, full_);
            } else {
                cut.push_back(i);
            }
        }
        return cut;
    }
    void add_partly_inside(const Bodies& bodies, const std::vector<std::size_t>& cut, int depth) {
        for (const std::size_t i : cut) {
            expect(i, full_ * bodies.fraction_inside(cells_->corners(i), depth));
        }
    }

    /// Collective. Returns whether the predictions of all cells of all processes are equal.
    [[nodiscard]] bool is_even() const {
        std::uint64_t most = 0;
        std::uint64_t most_complement = 0;
        for (const float cells : expected_) {
            const std::uint64_t bits = std::bit_cast<std::uint32_t>(cells);  // ordered as floats
            most = std::max(most, bits);
            most_complement = std::max(most_complement, complement - bits);
        }
        most = cells_->processes.max(most);
        return most <= complement - cells_->processes.max(most_complement);
    }
    [[nodiscard]] std::vector<float> expected() && { return std::move(expected_); }

private:
    static constexpr double max_children = 1e9;  // few meshes have more
    static constexpr std::uint64_t complement = 0xffff'ffff;

    void expect(std::size_t i, double cells) {
        expected_[i] = std::max(expected_[i], static_cast<float>(std::min(cells, full_)));
    }

    const CellsToWeigh* cells_;
    double children_per_level_;
    int levels_;
    double full_;  ///< the number for a cell that is marked in all levels
    std::vector<float> expected_;
};

}  // namespace

CellsToWeigh cells_to_weigh(const Mesh& mesh) {
    return {.processes = {},
            .first_number = 0,
            .cells = {mesh.cells.data(), mesh.cells.size()},
            .points = {mesh.points.data(), mesh.points.size()},
            .regions = mesh.regions};
}

std::vector<float> predicted_cells(const CellsToWeigh& cells, const Selection& selection,
                                   Scheme scheme, int levels) {
    const StandardArithmetic standard;
    if (selection.all || levels < 1) return {};
    return cells.processes.transaction([&]() -> std::vector<float> {
        Prediction prediction(cells, scheme, levels);
        if (selection.random) prediction.add_at_random(selection.random->fraction);
        prediction.add_tagged(selection);
        if (selection.max_volume) prediction.add_larger_than(*selection.max_volume);
        const Bodies bodies(selection);
        if (!bodies.empty()) {
            const std::vector<std::size_t> cut = prediction.add_wholly_inside(bodies);
            std::array<std::uint64_t, 2> counts{cut.size(), cells.count()};
            cells.processes.sum(std::span(counts));
            prediction.add_partly_inside(bodies, cut, depth_for(counts[0], counts[1]));
        }
        if (prediction.is_even()) return {};
        return std::move(prediction).expected();
    });
}

std::vector<float> predicted_cells(const Mesh& mesh, const Selection& selection, Scheme scheme,
                                   int levels) {
    const StandardArithmetic standard;
    return predicted_cells(cells_to_weigh(mesh), selection, scheme, levels);
}

}  // namespace octetra::distributed
