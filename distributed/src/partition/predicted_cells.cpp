#include <octetra/distributed/predicted_cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace octetra::distributed {
namespace {

double cells_of_one(Scheme scheme) {
    switch (scheme) {
        case Scheme::eight: return 8;
        case Scheme::four: return 4;
        case Scheme::two: return 2;
    }
    return 1;
}

Corners corners_of(const Mesh& mesh, CellIndex c) {
    const auto& [i, j, k, l] = mesh.cells[c];
    return {mesh.points[i], mesh.points[j], mesh.points[k], mesh.points[l]};
}

Point middle(const Point& p, const Point& q) {
    return {p.x / 2 + q.x / 2, p.y / 2 + q.y / 2, p.z / 2 + q.z / 2};
}

/// Eight pieces of equal volume.
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

/// What spheres and boxes mark, by place alone.
class Bodies {
public:
    explicit Bodies(const Selection& selection) {
        bodies_.spheres = selection.spheres;
        bodies_.boxes = selection.boxes;
    }
    [[nodiscard]] bool empty() const { return bodies_.spheres.empty() && bodies_.boxes.empty(); }
    [[nodiscard]] bool have(const Corners& corners) const {
        return marks(bodies_, corners, 0, GlobalCell{0});
    }
    /// How much of a cell they have, by 8^depth samples.
    [[nodiscard]] double share_of(const Corners& corners, int depth) const {
        if (depth == 0) return have(corners) ? 1 : 0;
        double sum = 0;
        for (const Corners& piece : eighths(corners)) sum += share_of(piece, depth - 1);
        return sum / 8;
    }

private:
    Selection bodies_;
};

/// The cells at which it is worth to look closer: those that the bodies have, and those at these.
std::vector<CellIndex> cells_near(const Bodies& bodies, const Mesh& mesh) {
    IndexVector<VertexIndex, std::uint8_t> near(mesh.points.size(), 0);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (!bodies.have(corners_of(mesh, c))) continue;
        for (const VertexIndex v : mesh.cells[c]) near[v] = 1;
    }
    std::vector<CellIndex> cells;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const auto is_near = [&](VertexIndex v) { return near[v] == 1; };
        if (std::ranges::any_of(mesh.cells[c], is_near)) cells.push_back(c);
    }
    return cells;
}

/// So many samples of each cell that they are about as many as the mesh has cells.
int depth_for(std::size_t cells, const Mesh& mesh) {
    constexpr int most = 5;
    const std::size_t samples = std::max(mesh.cells.size(), std::size_t{1} << 15U);
    int depth = 0;
    for (std::size_t n = 8 * cells; n <= samples && depth < most; n *= 8) ++depth;
    return depth;
}

/// Of several criteria that expect something of a cell, the one that expects most counts.
class Prediction {
public:
    Prediction(const Mesh& mesh, Scheme scheme, int levels)
        : mesh_(&mesh),
          of_one_(cells_of_one(scheme)),
          levels_(levels),
          full_(std::min(std::pow(of_one_, levels), most_of_one)),
          cells_(mesh.cells.size(), 1) {}

    void add_by_lot(double share) {
        const double of_all = std::pow(1 + share * (of_one_ - 1), levels_);
        std::ranges::fill(cells_, static_cast<float>(std::min(of_all, full_)));
    }

    void add_tagged(const Selection& selection) {
        if (selection.regions.empty() && selection.cells.empty()) return;
        Selection by_tag;
        by_tag.cells = selection.cells;
        by_tag.regions = selection.regions;
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
            const Marker region = mesh_->regions.empty() ? 0 : mesh_->regions[c];
            if (marks(by_tag, {}, region, GlobalCell{c.value()})) expect(c, full_);
        }
    }

    void add_larger_than(double limit) {
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
            const double times = volume(corners_of(*mesh_, c)) / limit;
            double cells = 1;
            while (cells < times && cells < full_) cells *= of_one_;
            expect(c, cells);
        }
    }

    void add_inside(const Bodies& bodies) {
        if (bodies.empty()) return;
        const std::vector<CellIndex> near = cells_near(bodies, *mesh_);
        const int depth = depth_for(near.size(), *mesh_);
        for (const CellIndex c : near) {
            expect(c, full_ * bodies.share_of(corners_of(*mesh_, c), depth));
        }
    }

    [[nodiscard]] std::vector<float> cells() && {
        const auto [least, most] = std::ranges::minmax(cells_);
        if (least == most) return {};
        return std::move(cells_);
    }

private:
    static constexpr double most_of_one = 1e9;  // no mesh has many more

    void expect(CellIndex c, double cells) {
        cells_[c.value()] = std::max(cells_[c.value()], static_cast<float>(std::min(cells, full_)));
    }

    const Mesh* mesh_;
    double of_one_;
    int levels_;
    double full_;  ///< what a cell becomes that is marked in all levels
    std::vector<float> cells_;
};

}  // namespace

std::vector<float> predicted_cells(const Mesh& mesh, const Selection& selection, Scheme scheme,
                                   int levels) {
    if (selection.all || levels < 1 || mesh.cells.empty()) return {};
    Prediction prediction(mesh, scheme, levels);
    if (selection.random) prediction.add_by_lot(selection.random->fraction);
    prediction.add_tagged(selection);
    if (selection.max_volume) prediction.add_larger_than(*selection.max_volume);
    prediction.add_inside(Bodies(selection));
    return std::move(prediction).cells();
}

}  // namespace octetra::distributed
