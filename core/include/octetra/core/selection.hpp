#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/point.hpp>

/// Which cells to refine, and how thoroughly.
namespace octetra {

/// Which edges a marked cell marks.
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

/// A cell is marked when any of these criteria marks it.
///
/// Every criterion judges a cell by its own corners and tags, never by its number or the order of
/// its corners, so a renumbered or distributed mesh has the same cells marked. The exception is
/// `cells`, which names cells of the input; at later levels it marks their descendants.
struct Selection {
    bool all = false;
    std::vector<GlobalCell> cells;      ///< cells of the input, ascending
    std::vector<Sphere> spheres;        ///< centroid nearer to the centre than the radius
    std::vector<Box> boxes;             ///< centroid in the closed box
    std::vector<Marker> regions;        ///< region tag equal
    std::optional<RandomShare> random;  ///< about this share of the cells, drawn by a hash of the
                                        ///< seed and the corners' coordinates
    std::optional<double> max_volume;   ///< volume greater than this
};

using Corners = std::array<Point, 4>;

/// The mean of the four corners. Each coordinate is summed in ascending order, so the bits do not
/// depend on the order of the corners.
[[nodiscard]] Point centroid(const Corners& corners);

/// The volume of a cell, in binary64; its bits do not depend on the order of the corners.
[[nodiscard]] double volume(const Corners& corners);

/// Does the selection mark the cell with these corners and region tag (0 where the mesh has
/// none) that descends from cell `root` of the input?
[[nodiscard]] bool marks(const Selection& selection, const Corners& corners, Marker region,
                         GlobalCell root);

}  // namespace octetra
