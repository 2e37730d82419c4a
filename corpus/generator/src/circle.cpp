#include "circle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octetra::generator {

Direction direction(double step, double steps) {
    const double angle = 2 * std::numbers::pi * step / steps;
    return {std::cos(angle), std::sin(angle)};
}

std::uint32_t circle_parts(double radius, double edge_length, std::uint32_t least) {
    const double parts = std::ceil(2 * std::numbers::pi * radius / edge_length);
    return std::max(least, static_cast<std::uint32_t>(parts));
}

}  // namespace octetra::generator
