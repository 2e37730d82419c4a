#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/point.hpp>

/// The selection of cells to refine, and the scheme by which they are refined.
namespace octetra {

/// The edges that a marked cell marks.
enum class Scheme {
    eight,  ///< `8t`: all six
    four,   ///< `4t`: the longest edge of each of its four faces
    two,    ///< `2t`: its longest edge
};

struct Sphere {
    Point centre;
    double radius = 0;
};

struct Box {
    Point low;
    Point high;
};

struct RandomShare {
    double fraction = 0;
    std::uint64_t seed = 0;
};

/// A cell is marked if any of these criteria marks it and each selection in `narrowed_by` marks it.
///
/// No criterion depends on the number of a cell or the order of its corners, so the same cells are
/// marked in a renumbered or distributed mesh. The exception is `cells`, which names cells of the
/// input; at later levels it marks their descendants. Most criteria depend only on the corners and
/// tags of a cell; expressions may use the history, facets and fields of the mesh.
struct Selection {
    bool all = false;
    std::vector<GlobalCell> cells;       ///< cells of the input, ascending
    std::vector<Sphere> spheres;         ///< centroid closer to the centre than the radius
    std::vector<Box> boxes;              ///< centroid in the closed box
    std::vector<Marker> regions;         ///< region tag equal to one of these
    std::optional<RandomShare> random;   ///< about this fraction of the cells, chosen by a hash of
                                         ///< the seed and the corners' coordinates
    std::optional<double> max_volume;    ///< volume greater than this
    std::vector<Expression> where;       ///< one of these expressions is not 0
    std::vector<Selection> narrowed_by;  ///< each marks the cell, too
};

using Corners = std::array<Point, 4>;

/// The mean of the four corners. Each coordinate is summed in ascending order, so the result is
/// bitwise independent of the order of the corners.
[[nodiscard]] Point centroid(const Corners& corners);

/// The volume of a cell, in binary64, bitwise independent of the order of the corners.
[[nodiscard]] double volume(const Corners& corners);

/// Returns whether the selection marks the cell with these corners and this region tag (0 if the
/// mesh has none) that descends from cell `root` of the input. Throws InputError if an expression
/// has no value, or uses more than the corners and the tag (is_external()): then see
/// AdaptiveMesh::marked_cells().
[[nodiscard]] bool marks(const Selection& selection, const Corners& corners, Marker region,
                         GlobalCell root);

}  // namespace octetra
