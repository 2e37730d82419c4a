#include "select/background_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <octetra/core/cell_quantities.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/mesh_state.hpp"
#include "output/check_fields.hpp"
#include "select/background_cells.hpp"
#include "select/boxes_of_others.hpp"

namespace octetra::distributed {
namespace {

const BackgroundCells& find_background(const Term& term, std::span<const Background> backgrounds) {
    std::vector<std::string> names;
    for (const Background& background : backgrounds) {
        if (background.name() == term.name) return background.cells();
        names.push_back(background.name());
    }
    throw InputError(fmt::format("{}: there is no such background mesh{}{}", text_of(term),
                                 names.empty() ? "" : "; there are ", fmt::join(names, ", ")));
}

/// Returns a point in units of 2^exponent. Beyond the limit, all distances to the background mesh
/// are equal up to rounding, and within it no product of them overflows.
Point in_unit(const Point& p, int exponent) {
    constexpr double limit = 0x1p400;
    const Point scaled = scaled_by(p, exponent);
    return {std::clamp(scaled.x, -limit, limit), std::clamp(scaled.y, -limit, limit),
            std::clamp(scaled.z, -limit, limit)};
}

struct CloserQuery {
    Point point;
    ClosestValue bound;  ///< a point of the background that is not closer is of no use
};

/// Collective. Replaces the values at points by those of closer points that others have.
void ask_others(const Communicator& processes, const BackgroundCells& cells,
                const std::vector<Point>& points, std::vector<ClosestValue>& closest) {
    const BoxesOfOthers others(lists_of_all(processes, cells.boxes(most_boxes)), processes.rank());
    const auto size = static_cast<std::size_t>(processes.size());
    std::vector<std::vector<CloserQuery>> queries(size);
    std::vector<std::vector<std::uint32_t>> asked(size);  // the points of the queries
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double bound = others.bound(points[i], closest[i].squared);
        others.for_each_within(points[i], slightly_more(bound), [&](std::size_t r) {
            queries[r].push_back({points[i], closest[i]});
            asked[r].push_back(static_cast<std::uint32_t>(i));
        });
    }
    std::vector<std::vector<ClosestValue>> answers(size);
    const auto received = processes.all_to_all(queries);
    for (std::size_t r = 0; r < size; ++r) {
        for (const auto& [point, bound] : received[r]) {
            answers[r].push_back(cells.closest(point, bound));
        }
    }
    const auto replies = processes.all_to_all(answers);
    for (std::size_t r = 0; r < size; ++r) {
        for (std::size_t i = 0; i < asked[r].size(); ++i) {
            ClosestValue& least = closest[asked[r][i]];
            if (replies[r][i] < least) least = replies[r][i];
        }
    }
}

/// Returns the cells of a background mesh with the values of their corners.
std::vector<BackgroundCell> background_cells(const DistributedMesh& mesh, FieldOn on,
                                             const std::vector<double>& values, int exponent) {
    std::vector<BackgroundCell> cells;
    cells.reserve(mesh.cells.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        std::array<std::pair<Point, double>, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const VertexIndex v = mesh.cells[c][k];
            corners[k] = {scaled_by(mesh.points[v], exponent),
                          values[on == FieldOn::cells ? c.value() : v.value()]};
        }
        std::ranges::sort(corners);
        BackgroundCell& cell = cells.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            cell.corners[k] = corners[k].first;
            cell.values[k] = corners[k].second;
        }
    }
    return cells;
}

}  // namespace

Background AdaptiveMesh::as_background(std::string name, const Field& field) const {
    const StandardArithmetic standard;
    const Phase phase(processes(), "select");
    return processes().transaction([&] {
        const DistributedMesh& mesh = state_->mesh;
        check_sizes(mesh, std::span(&field, 1));
        check_same(processes(), std::span(&field, 1));
        if (field.components != 1) {
            throw InputError(fmt::format("background({}): the field has {} components instead of 1",
                                         name, field.components));
        }
        std::vector<double> values = std::visit(
            [](const auto& list) { return std::vector<double>(list.begin(), list.end()); },
            field.values);
        if (std::ranges::any_of(values, [](double v) { return std::isnan(v); })) {
            throw InputError(fmt::format("background({}): a value is not a number", name));
        }
        if (field.on == FieldOn::vertices) {
            update_copies(processes(), state_->sharing, mesh.points.size(),
                          std::span<double>(values));
        }
        const int exponent = common_exponent(mesh);
        return Background(std::move(name),
                          std::make_shared<const BackgroundCells>(
                              background_cells(mesh, field.on, values, exponent), exponent));
    });
}

std::vector<double> background_values(const DistributedMesh& mesh, const Term& term,
                                      std::span<const Background> backgrounds) {
    const BackgroundCells& background = find_background(term, backgrounds);
    std::vector<Point> centroids;
    std::vector<ClosestValue> closest;
    for (const auto& [a, b, c, d] : mesh.cells) {
        const Point p = centroid({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
        centroids.push_back(in_unit(p, background.exponent()));
        closest.push_back(background.closest(centroids.back()));
    }
    if (mesh.processes.size() > 1) ask_others(mesh.processes, background, centroids, closest);
    std::vector<double> values;
    for (const ClosestValue& found : closest) values.push_back(found.value);
    return values;
}

}  // namespace octetra::distributed
