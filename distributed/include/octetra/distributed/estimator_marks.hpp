#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

/// Marking of cells by the indicators of an error estimator, for AdaptiveMesh::refine.
///
/// All functions are collective. `indicators` has a number for each cell of this process,
/// nonnegative and finite; the result has a byte for each of them, 1 for a marked cell, else 0. A
/// process may have no cells, and if none has any, nothing is marked.
///
/// A cell is marked if its indicator is at least a threshold that is the same on all processes. So
/// of cells with the same indicator all are marked or none, and the set of marked cells does not
/// depend on the number of processes, the partition or the order of the cells: sums are exact, not
/// rounded. A cell with the indicator 0 is never marked.
///
/// Complexity: O(n log n) for the n cells of a process, O(n) for mark_maximum, and less than 25
/// reductions of at most 8 KiB. Nothing is gathered.
///
/// The functions throw the same exception on all processes: InputError if on any process an
/// indicator is negative, infinite or not a number, or the other argument is out of range or
/// differs between processes; std::bad_alloc if one runs out of memory.
namespace octetra::distributed {

/// Bulk marking, also called Doerfler marking (W. Doerfler, "A convergent adaptive algorithm for
/// Poisson's equation", SIAM J. Numer. Anal. 33, 1996): marks the smallest set of cells with the
/// largest indicators whose sum is at least theta * (the sum of all), and the cells that tie with
/// the last one.
///
/// Indicators are squares, eta_T^2 for the cell T, and theta is a fraction of the sum of squares;
/// so it corresponds to theta^2 in Doerfler's paper, where it refers to the norm of the eta_T.
///
/// 0 < theta <= 1; 1 marks all cells with a nonzero indicator. The comparison is exact for the
/// double value of theta: 0.8 as a double is a little more than 8/10.
[[nodiscard]] std::vector<std::uint8_t> mark_bulk(const Communicator& processes,
                                                  std::span<const double> indicators, double theta);

/// Marks the cells whose indicator is at least share * (the maximum of all), a product rounded
/// once, to double. 0 <= share <= 1; 0 marks all cells with a nonzero indicator.
[[nodiscard]] std::vector<std::uint8_t> mark_maximum(const Communicator& processes,
                                                     std::span<const double> indicators,
                                                     double share);

/// Marks the ceil(fraction * N) cells with the largest indicators, for N cells on all processes,
/// and those that tie with the last one; all cells with nonzero indicators if these are fewer. The
/// product is rounded to double once before it is rounded up. 0 < fraction <= 1.
[[nodiscard]] std::vector<std::uint8_t> mark_fraction(const Communicator& processes,
                                                      std::span<const double> indicators,
                                                      double fraction);

}  // namespace octetra::distributed
