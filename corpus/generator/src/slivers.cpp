#include <octetra/generator/clouds.hpp>

#include "parameters.hpp"
#include "tetrahedralise.hpp"
#include "uniform.hpp"

namespace octetra::generator {

Mesh slivers(std::uint64_t n, std::uint64_t seed) {
    check_count(n, 2, 400, "the number of points along each axis");
    Uniform uniform(seed);
    const auto perturbed = [&](std::uint64_t i) {
        constexpr double perturbation = 1e-6;
        return (static_cast<double>(i) + perturbation * (2 * uniform() - 1)) /
               static_cast<double>(n - 1);
    };
    Complex cloud;
    cloud.points.reserve(n * n * n);
    for (std::uint64_t k = 0; k < n; ++k) {
        for (std::uint64_t j = 0; j < n; ++j) {
            for (std::uint64_t i = 0; i < n; ++i) {
                const double x = perturbed(i);
                const double y = perturbed(j);
                const double z = perturbed(k);
                cloud.points.push_back({x, y, z});
            }
        }
    }
    return tetrahedralise(cloud, "");
}

}  // namespace octetra::generator
