#include <octetra/verify/certify_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "parts/exchange.hpp"
#include "parts/fetch_vertices.hpp"
#include "shapes/cell_certifier.hpp"
#include "shapes/certificates.hpp"
#include "shapes/root_shape.hpp"

namespace octetra::verify {
namespace {

using shapes::CellCertifier;
using Corners = std::array<Point, 4>;

constexpr std::string_view too_thin =
    "is too thin: floating-point numbers cannot represent its angles, or those of its descendants";

int orientation_of(const Corners& c) { return orientation(c[0], c[1], c[2], c[3]); }

/// The cells of this process, numbered in the whole mesh from `first`.
struct CertifiedShare {
    const IndexVector<CellIndex, CellVertices>* cells = nullptr;
    const IndexVector<VertexIndex, Point>* points = nullptr;
    std::vector<std::uint32_t> numbers{};  ///< of the points, ascending; empty: 0, 1, ...
    std::uint64_t first = 0;
    std::uint32_t index_base = 0;

    [[nodiscard]] Corners corners(CellIndex c) const {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const VertexIndex v = (*cells)[c][k];
            if (numbers.empty()) {
                corners[k] = (*points)[v];
                continue;
            }
            const auto found = std::ranges::lower_bound(numbers, v.value());
            corners[k] = (*points)[VertexIndex{static_cast<std::size_t>(found - numbers.begin())}];
        }
        return corners;
    }
    [[nodiscard]] std::uint64_t number(CellIndex c) const { return first + c.value(); }
    [[nodiscard]] InputError refusal(CellIndex c, std::string_view what) const {
        return InputError(fmt::format("cell {} {}", number(c) + index_base, what));
    }
};

void check_orientation(const CertifiedShare& share) {
    for (CellIndex c{0}; c < share.cells->end_index(); ++c) {
        const int sign = orientation_of(share.corners(c));
        if (sign > 0) continue;
        throw share.refusal(c, sign == 0 ? "is flat: it has no shape to certify"
                                         : "is inverted: its corners are in negative order");
    }
}

Point centroid_of(const Corners& corners) {
    const auto mean = [&](double Point::*x) {
        double sum = 0;
        for (const Point& p : corners) sum += p.*x / 4;
        return sum;
    };
    return {mean(&Point::x), mean(&Point::y), mean(&Point::z)};
}

bool is_worse(const CertifiedCell& a, const CertifiedCell& b) {
    const double angle_a = a.certificate.bounds.min_dihedral;
    const double angle_b = b.certificate.bounds.min_dihedral;
    return angle_a != angle_b ? angle_a < angle_b : a.cell < b.cell;
}

void keep_worst(std::vector<CertifiedCell>& cells, std::size_t count) {
    std::ranges::sort(cells, is_worse);
    if (cells.size() > count) cells.resize(count);
}

void add(ShapeBounds& bounds, const ShapeBounds& more) {
    bounds.min_dihedral = std::min(bounds.min_dihedral, more.min_dihedral);
    bounds.max_dihedral = std::max(bounds.max_dihedral, more.max_dihedral);
    bounds.min_eta = std::min(bounds.min_eta, more.min_eta);
    bounds.min_solid = std::min(bounds.min_solid, more.min_solid);
}

/// A certificate of a share, without the worst cells. Trivially copyable.
struct Summary {
    std::uint64_t cells = 0;
    std::uint64_t closed = 0;
    std::uint64_t ties = 0;
    std::uint64_t near_ties = 0;
    std::uint64_t min_shapes = ~std::uint64_t{0};
    std::uint64_t max_shapes = 0;
    std::uint64_t sum_of_shapes = 0;
    std::uint32_t max_generations = 0;
    std::uint32_t holds_to = ~std::uint32_t{0};
    ShapeBounds bounds;
    decltype(ShapeCertificate::dihedral_histogram) histogram{};

    void add_cell(const CellCertificate& cell) {
        ++cells;
        ties += cell.has_ties ? 1 : 0;
        near_ties += cell.has_near_ties ? 1 : 0;
        min_shapes = std::min(min_shapes, cell.shapes);
        max_shapes = std::max(max_shapes, cell.shapes);
        sum_of_shapes += cell.shapes;
        if (cell.is_closed) {
            ++closed;
            max_generations = std::max(max_generations, cell.generations);
        } else {
            holds_to = std::min(holds_to, cell.generations);
        }
        add(bounds, cell.bounds);
        // As in other histograms, an angle that rounding has put below a limit counts as on it.
        constexpr double tolerance = 1e-9;
        const auto bin = static_cast<std::size_t>(
            cell.bounds.min_dihedral / ShapeCertificate::bin_width + tolerance);
        ++histogram[std::min(bin, histogram.size() - 1)];
    }

    void add_summary(const Summary& other) {
        cells += other.cells;
        closed += other.closed;
        ties += other.ties;
        near_ties += other.near_ties;
        min_shapes = std::min(min_shapes, other.min_shapes);
        max_shapes = std::max(max_shapes, other.max_shapes);
        sum_of_shapes += other.sum_of_shapes;
        max_generations = std::max(max_generations, other.max_generations);
        holds_to = std::min(holds_to, other.holds_to);
        add(bounds, other.bounds);
        for (std::size_t k = 0; k < histogram.size(); ++k) histogram[k] += other.histogram[k];
    }
};

Summary certify_share(const CertifiedShare& share, const CertifyOptions& options,
                      std::vector<CertifiedCell>& worst) {
    shapes::Certificates certificates(options.limit);
    Summary summary;
    constexpr std::uint32_t cells_per_report = 64;
    const std::size_t kept = 2 * options.worst + 1000;
    for (CellIndex c{0}; c < share.cells->end_index(); ++c) {
        if (options.progress && c.value() % cells_per_report == 0) {
            options.progress("shapes", static_cast<double>(c.value()) /
                                           static_cast<double>(share.cells->size()));
        }
        const Corners corners = share.corners(c);
        try {
            const CellCertificate& cell = certificates.of(corners);
            summary.add_cell(cell);
            if (options.worst == 0) continue;
            worst.push_back({share.number(c), centroid_of(corners), cell});
            if (worst.size() >= kept) keep_worst(worst, options.worst);
        } catch (const CellCertifier::TooThin&) {
            throw share.refusal(c, too_thin);
        }
    }
    keep_worst(worst, options.worst);
    return summary;
}

ShapeCertificate combined(const Summary& summary, std::vector<CertifiedCell> worst) {
    ShapeCertificate result{.cells = summary.cells,
                            .closed_cells = summary.closed,
                            .cells_with_ties = summary.ties,
                            .cells_with_near_ties = summary.near_ties,
                            .min_shapes = summary.cells == 0 ? 0 : summary.min_shapes,
                            .max_shapes = summary.max_shapes,
                            .sum_of_shapes = summary.sum_of_shapes,
                            .max_generations = summary.max_generations,
                            .bounds = summary.bounds,
                            .worst = std::move(worst),
                            .dihedral_histogram = summary.histogram};
    if (!result.is_closed()) result.holds_to_generation = summary.holds_to;
    return result;
}

/// Collective.
ShapeCertificate certify(const CertifiedShare& share, const ProcessGroup& group,
                         const CertifyOptions& options) {
    check_orientation(share);
    (void)group.sum(0);  // all cells are oriented before any is certified
    std::vector<CertifiedCell> own_worst;
    const Summary own = certify_share(share, options, own_worst);
    Summary total;
    for (const auto& summary : share_with_all(group, std::vector<Summary>{own})) {
        total.add_summary(summary.front());
    }
    std::vector<CertifiedCell> worst;
    for (const auto& cells : share_with_all(group, own_worst)) {
        worst.insert(worst.end(), cells.begin(), cells.end());
    }
    keep_worst(worst, options.worst);
    return combined(total, std::move(worst));
}

}  // namespace

CellCertificate certify_cell(const std::array<Point, 4>& corners, std::size_t limit) {
    const StandardArithmetic standard;
    if (orientation_of(corners) <= 0) throw InputError("the cell is flat or inverted");
    try {
        return CellCertifier(limit).certify(shapes::root_shape(corners));
    } catch (const CellCertifier::TooThin&) {
        throw InputError(fmt::format("the cell {}", too_thin));
    }
}

ShapeCertificate certify_shapes(const Mesh& mesh, const CertifyOptions& options) {
    const StandardArithmetic standard;
    return certify({.cells = &mesh.cells, .points = &mesh.points, .index_base = mesh.index_base},
                   ProcessGroup::alone(), options);
}

ShapeCertificate certify_shapes(const MeshSlice& mesh, const ProcessGroup& group,
                                const CertifyOptions& options) {
    const StandardArithmetic standard;
    return group.transaction([&] {
        group.check_same("option limit", fmt::format("{}", options.limit));
        group.check_same("option worst", fmt::format("{}", options.worst));
        CertifiedShare share{.cells = &mesh.lists.cells,
                             .first = slice_begin(mesh.totals.cells, group.rank(), group.size()),
                             .index_base = mesh.lists.index_base};
        for (const CellVertices& cell : mesh.lists.cells) {
            for (const VertexIndex v : cell) share.numbers.push_back(v.value());
        }
        std::ranges::sort(share.numbers);
        share.numbers.erase(std::unique(share.numbers.begin(), share.numbers.end()),
                            share.numbers.end());
        const auto points = fetch_points(share.numbers, mesh, group);
        share.points = &points;
        return certify(share, group, options);
    });
}

}  // namespace octetra::verify
