#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

/// Which cells to refine, by the indicators of an error estimator: marks for AdaptiveMesh::refine.
///
/// Every function here is collective. `indicators` has a number for each cell of this process, at
/// least 0 and finite; the result has a byte for each of them, 1 for a marked cell, else 0. A
/// process may have no cells, and if none has any, nothing is marked.
///
/// A cell is marked if its indicator is at least a threshold, the same on all processes. So of
/// cells with the same indicator all are marked or none, and the set of marked cells is the same on
/// any number of processes, by any partition and in any order of the cells, bit by bit: sums are
/// exact, not rounded. A cell whose indicator is 0 is never marked.
///
/// Time is n log n for the n cells of a process (n for mark_maximum), and less than 25 reductions
/// of at most 8 KiB. Nothing is gathered.
///
/// Throws on all processes the same, when nobody waits any more: InputError if on one of them an
/// indicator is negative, infinite or not a number, or if the other argument is out of its range or
/// not the same on all; std::bad_alloc if one has no memory.
namespace octetra::distributed {

/// Bulk marking, also called Doerfler's (W. Doerfler, "A convergent adaptive algorithm for
/// Poisson's equation", SIAM J. Numer. Anal. 33, 1996): the cells with the largest indicators, as
/// few as have a sum of at least theta * (the sum of all), and those that tie with the last one.
///
/// Indicators are squares, eta_T^2 for the cell T, and theta is a share of the sum of squares, so
/// it stands for theta^2 where the norm of the eta_T is meant, as in Doerfler's paper.
///
/// 0 < theta <= 1, and 1 marks all cells that are not 0. The comparison is exact for the double
/// that theta is: 0.8 as a double is a little more than 8/10.
[[nodiscard]] std::vector<std::uint8_t> mark_bulk(const Communicator& processes,
                                                  std::span<const double> indicators, double theta);

/// The cells whose indicator is at least share * (the greatest of all), a product rounded once, to
/// double. 0 <= share <= 1; 0 marks all cells that are not 0.
[[nodiscard]] std::vector<std::uint8_t> mark_maximum(const Communicator& processes,
                                                     std::span<const double> indicators,
                                                     double share);

/// The ceil(fraction * N) cells with the largest indicators, for N cells on all processes, and
/// those that tie with the last one; all that are not 0, if those are fewer. The product is rounded
/// once, to double, before it is rounded up. 0 < fraction <= 1.
[[nodiscard]] std::vector<std::uint8_t> mark_fraction(const Communicator& processes,
                                                      std::span<const double> indicators,
                                                      double fraction);

}  // namespace octetra::distributed
