#pragma once

#include <algorithm>
#include <compare>
#include <complex>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <octetra/distributed/entity_transfer.hpp>

namespace octetra::distributed {

/// The rule by which values of cells are transferred: by refinement from a parent to its children,
/// and by coarsening from fine cells to the coarse cell that they are merged into. A value that all
/// fine cells have in common is preserved bit by bit unless values are summed. The result does not
/// depend on the number of processes.
enum class CellValues {
    copied,  ///< each child gets the value of the parent; a coarse cell gets the mean weighted by
             ///< volumes, which preserves the integral: for a density or a cell average. For whole
             ///< numbers (a level, a tag) it gets the most frequent value, or the smallest of these
    averaged,  ///< as copied, but whole numbers are rejected
    divided,  ///< children get fractions of the value in proportion to their volumes; a coarse cell
              ///< gets the sum: for a mass. Whole numbers (a count) can be summed, but not divided
};

/// True if T is std::complex of a floating-point type.
template <class T>
inline constexpr bool is_complex = false;
template <std::floating_point R>
inline constexpr bool is_complex<std::complex<R>> = true;

/// The type of the real and imaginary parts of T; T itself if it is not complex.
template <class T>
struct RealOf {
    using Type = T;
};
template <class R>
struct RealOf<std::complex<R>> {
    using Type = R;
};
template <class T>
using Real = typename RealOf<T>::Type;

/// A strict total order that distinguishes all bit patterns; complex numbers are ordered by their
/// real parts first.
template <class T>
[[nodiscard]] std::strong_ordering order_of(const T& a, const T& b) {
    if constexpr (is_complex<T>) {
        const std::strong_ordering real = std::strong_order(a.real(), b.real());
        return real != 0 ? real : std::strong_order(a.imag(), b.imag());
    } else {
        return std::strong_order(a, b);
    }
}

/// The value of a fine cell, and the number of bisections that separate it from the coarse cell.
template <class T>
struct FineValue {
    T value;
    unsigned halvings;
};

/// Sorts values into an order that does not depend on the order of the cells, which varies with the
/// number of processes; values of types without an order are left as they are. Returns whether all
/// values are equal.
template <class T>
[[nodiscard]] bool sort_and_compare(std::span<FineValue<T>> pieces) {
    if constexpr (std::is_arithmetic_v<T> || is_complex<T>) {
        const auto order = [](const FineValue<T>& a, const FineValue<T>& b) {
            return order_of(a.value, b.value);
        };
        std::ranges::sort(pieces, [&](const FineValue<T>& a, const FineValue<T>& b) {
            return order(a, b) != 0 ? order(a, b) < 0 : a.halvings < b.halvings;
        });
        return order(pieces.front(), pieces.back()) == 0;
    } else if constexpr (std::equality_comparable<T>) {
        return std::ranges::all_of(
            pieces, [&](const FineValue<T>& piece) { return piece.value == pieces[0].value; });
    } else {
        return false;
    }
}

/// Returns the most frequent of sorted values; the smallest if several are equally frequent.
template <class T>
[[nodiscard]] T most_frequent(std::span<const FineValue<T>> pieces) {
    T found = pieces[0].value;
    for (std::size_t begin = 0, most = 0, end = 0; begin < pieces.size(); begin = end) {
        while (end < pieces.size() && pieces[end].value == pieces[begin].value) ++end;
        if (end - begin <= most) continue;
        most = end - begin;
        found = pieces[begin].value;
    }
    return found;
}

/// Returns the value of a coarse cell that one or more fine cells are merged into. Reorders
/// `pieces`.
template <class T>
[[nodiscard]] T merged_value(std::span<FineValue<T>> pieces, CellValues how) {
    const bool are_same = sort_and_compare(pieces);
    if (pieces.size() == 1 || (are_same && how != CellValues::divided)) return pieces[0].value;
    if constexpr (std::is_integral_v<T>) {
        if (how != CellValues::divided) return most_frequent(std::span<const FineValue<T>>(pieces));
    }
    T sum{};
    for (const FineValue<T>& piece : pieces) {
        if (how == CellValues::divided) {
            sum += piece.value;
        } else {
            sum += piece.value / static_cast<Real<T>>(1U << piece.halvings);
        }
    }
    return sum;
}

/// Returns the values after coarsening, `components` for each cell, from the values before it.
template <class T>
[[nodiscard]] std::vector<T> merged_values(const std::vector<T>& values, std::size_t components,
                                           const EntityTransfer& cells, CellValues how) {
    const FineOfCoarse all = fine_of_coarse(cells);
    std::vector<T> wholes;
    wholes.reserve(cells.count() * components);
    std::vector<FineValue<T>> pieces;
    for (std::size_t whole = 0; whole < cells.count(); ++whole) {
        for (std::size_t k = 0; k < components; ++k) {
            pieces.clear();
            for (std::uint32_t p = all.first[whole]; p < all.first[whole + 1]; ++p) {
                const std::uint32_t piece = all.pieces[p];
                pieces.push_back({values[piece * components + k], cells.halvings()[piece]});
            }
            wholes.push_back(merged_value(std::span(pieces), how));
        }
    }
    return wholes;
}

}  // namespace octetra::distributed
