#include <octetra/core/error.hpp>
#include <octetra/generator/tetgen.hpp>

#include "tetrahedralise.hpp"

namespace octetra::generator {

bool has_tetgen() { return false; }

Mesh tetrahedralise(const Complex& /*complex*/, std::string_view /*switches*/) {
    throw InputError(
        "this build has no TetGen, which this shape needs: install libtet1.5-dev and configure "
        "with -DOCTETRA_TETGEN=ON");
}

}  // namespace octetra::generator
