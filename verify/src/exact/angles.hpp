#pragma once

#include <array>
#include <memory>

#include <octetra/core/point.hpp>
#include <octetra/verify/verdict.hpp>

/// Comparisons of angles by the squares of their cosines, which are rational, so no roots are
/// needed.
namespace octetra::verify::exact {

/// An angle to compare with, from 0 to 180 degrees. Its cosine is enclosed with 400 bits, or exact:
/// for multiples of 30 and 45 degrees, and no other angles representable as a double, the square of
/// the cosine is rational.
class AngleLimit {
public:
    explicit AngleLimit(double degrees);
    ~AngleLimit();
    AngleLimit(const AngleLimit&) = delete;
    AngleLimit& operator=(const AngleLimit&) = delete;
    AngleLimit(AngleLimit&&) = delete;
    AngleLimit& operator=(AngleLimit&&) = delete;

    /// Returns whether the dihedral angle of the cell at its edge pq, between its faces pqr and
    /// pqs, is less than this angle.
    [[nodiscard]] bool exceeds_dihedral(const Point& p, const Point& q, const Point& r,
                                        const Point& s, Arithmetic& arithmetic) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns whether every angle of `piece` is at least half of the smallest angle of `whole`.
/// Precondition: both triangles are nondegenerate.
[[nodiscard]] bool keeps_half_of_smallest_angle(const std::array<Point, 3>& piece,
                                                const std::array<Point, 3>& whole,
                                                Arithmetic& arithmetic);

}  // namespace octetra::verify::exact
