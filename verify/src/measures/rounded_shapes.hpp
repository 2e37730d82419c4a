#pragma once

#include "measures/rounding_bounds.hpp"

/// Bounds of the angles and eta that a cell would have if its midpoints had not been rounded.
namespace octetra::verify {

/// Returns an upper bound, in degrees, of the change of a dihedral angle by the rounding of
/// vertices.
[[nodiscard]] double dihedral_error(const Shape<4>& shape);

/// Returns an upper bound of the mean ratio of the cell with exact midpoints.
[[nodiscard]] double exact_mean_ratio_at_most(const Shape<4>& shape);

/// Returns whether all solid angles of the cell with exact midpoints may be at least `least`
/// steradians, 0 to pi / 2. False is proved; true is not, since errors of this computation are
/// allowed for. Precondition: the cell is positively oriented.
[[nodiscard]] bool solid_angles_may_reach(double least, const Shape<4>& shape);

}  // namespace octetra::verify
