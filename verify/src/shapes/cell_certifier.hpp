#pragma once

#include <array>
#include <cstddef>
#include <tuple>

#include <octetra/verify/certify_shapes.hpp>

#include "shapes/integers.hpp"
#include "shapes/root_shape.hpp"
#include "shapes/shape_set.hpp"

namespace octetra::verify::shapes {

/// Closes the sets of shapes of cells, one at a time, in memory that is reused.
///
/// Every shape is kept in units in which it has the volume of the root: bisection by all edges
/// divides the volume by eight, and lengths are then doubled. Therefore similar shapes are
/// congruent, and shapes that are equal up to translation and scaling are equal up to translation.
class CellCertifier {
public:
    explicit CellCertifier(std::size_t limit) : limit_(limit) {}

    /// Throws TooThin.
    [[nodiscard]] CellCertificate certify(const RootShape& root);

    /// A cell whose angles floating-point numbers cannot represent.
    struct TooThin {};

private:
    template <class Int>
    struct Sets {
        ShapeSet<Int, 6> similar;
        ShapeSet<Int, 9> placed;
    };

    std::size_t limit_;
    std::tuple<Sets<Int128>, Sets<Int512>, Sets<BigInt>> sets_;
};

}  // namespace octetra::verify::shapes
