#include <octetra/generator/clouds.hpp>

#include "parameters.hpp"
#include "tetrahedralise.hpp"
#include "uniform.hpp"

namespace octetra::generator {

Mesh random(std::uint64_t points, std::uint64_t seed) {
    // TetGen counts the corners of all cells in an int.
    check_count(points, 4, std::uint64_t{1} << 26U, "the number of points");
    Uniform uniform(seed);
    Complex cloud;
    cloud.points.reserve(points);
    for (std::uint64_t i = 0; i < points; ++i) {
        const double x = uniform();
        const double y = uniform();
        const double z = uniform();
        cloud.points.push_back({x, y, z});
    }
    return tetrahedralise(cloud, "");
}

}  // namespace octetra::generator
