#pragma once

#include <array>
#include <memory>

#include <octetra/core/point.hpp>
#include <octetra/verify/verdict.hpp>

/// Angles compared through their cosines' squares, which are rational: no root is taken.
namespace octetra::verify::exact {

/// An angle to compare with, from 0 to 180 degrees. Its cosine is enclosed in 400 bits, or known:
/// for the multiples of 30 and 45 degrees the square is a rational number, and for no others that a
/// double can hold.
class AngleLimit {
public:
    explicit AngleLimit(double degrees);
    ~AngleLimit();
    AngleLimit(const AngleLimit&) = delete;
    AngleLimit& operator=(const AngleLimit&) = delete;
    AngleLimit(AngleLimit&&) = delete;
    AngleLimit& operator=(AngleLimit&&) = delete;

    /// Is the dihedral angle of the cell at its edge pq, between its faces pqr and pqs, less?
    [[nodiscard]] bool exceeds_dihedral(const Point& p, const Point& q, const Point& r,
                                        const Point& s, Arithmetic& arithmetic) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Is every angle of `piece` at least half of the smallest angle of `whole`? Both are triangles
/// that are not degenerate.
[[nodiscard]] bool keeps_half_of_smallest_angle(const std::array<Point, 3>& piece,
                                                const std::array<Point, 3>& whole,
                                                Arithmetic& arithmetic);

}  // namespace octetra::verify::exact
