#include <fmt/format.h>

#include "regular_cell.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {

Mesh fill(const Complex& complex, double edge_length, Surface surface) {
    return tetrahedralise(
        complex, fmt::format("p{}q1.414/10a{:.17g}{}", surface == Surface::as_given ? "Y" : "",
                             regular_cell_volume(edge_length), complex.regions.empty() ? "" : "A"));
}

}  // namespace octetra::generator
