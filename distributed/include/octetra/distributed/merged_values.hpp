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

#include <octetra/distributed/succession.hpp>

namespace octetra::distributed {

/// What the children of a cell get of a value that it had; and of values that pieces had, what
/// their whole gets. What all pieces have the whole has, too, to the bit, but where they are added
/// up. What it gets does not depend on the number of processes.
enum class CellValues {
    copied,    ///< each the same, and the mean weighted by volumes, which keeps the integral: a
               ///< density, an average over the cell. Of whole numbers (a level, a tag) what most
               ///< pieces have, and of several such the least
    averaged,  ///< as copied, but whole numbers are refused
    divided,   ///< by their shares in its volume, and the sum: a mass. Whole numbers (a count) have
               ///< no shares, and can only be added up
};

/// Is T std::complex of a floating-point type?
template <class T>
inline constexpr bool is_complex = false;
template <std::floating_point R>
inline constexpr bool is_complex<std::complex<R>> = true;

/// The type of the real and imaginary parts of T; of a T that is not complex, T.
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

/// A strict order of numbers that tells all bits apart; complex ones by their real parts first.
template <class T>
[[nodiscard]] std::strong_ordering order_of(const T& a, const T& b) {
    if constexpr (is_complex<T>) {
        const std::strong_ordering real = std::strong_order(a.real(), b.real());
        return real != 0 ? real : std::strong_order(a.imag(), b.imag());
    } else {
        return std::strong_order(a, b);
    }
}

/// A value of a piece, which its whole had been halved so often for.
template <class T>
struct PieceValue {
    T value;
    unsigned halvings;
};

/// In an order that does not depend on that of the pieces, which is not the same on any number of
/// processes; values of other types stay as they are. Have all the same?
template <class T>
[[nodiscard]] bool sort_and_compare(std::span<PieceValue<T>> pieces) {
    if constexpr (std::is_arithmetic_v<T> || is_complex<T>) {
        const auto order = [](const PieceValue<T>& a, const PieceValue<T>& b) {
            return order_of(a.value, b.value);
        };
        std::ranges::sort(pieces, [&](const PieceValue<T>& a, const PieceValue<T>& b) {
            return order(a, b) != 0 ? order(a, b) < 0 : a.halvings < b.halvings;
        });
        return order(pieces.front(), pieces.back()) == 0;
    } else if constexpr (std::equality_comparable<T>) {
        return std::ranges::all_of(
            pieces, [&](const PieceValue<T>& piece) { return piece.value == pieces[0].value; });
    } else {
        return false;
    }
}

/// Of sorted ones; of several such the least.
template <class T>
[[nodiscard]] T most_frequent(std::span<const PieceValue<T>> pieces) {
    T found = pieces[0].value;
    for (std::size_t begin = 0, most = 0, end = 0; begin < pieces.size(); begin = end) {
        while (end < pieces.size() && pieces[end].value == pieces[begin].value) ++end;
        if (end - begin <= most) continue;
        most = end - begin;
        found = pieces[begin].value;
    }
    return found;
}

/// The value of a cell whose pieces, one or more, had these. Changes their order.
template <class T>
[[nodiscard]] T merged_value(std::span<PieceValue<T>> pieces, CellValues how) {
    const bool are_same = sort_and_compare(pieces);
    if (pieces.size() == 1 || (are_same && how != CellValues::divided)) return pieces[0].value;
    if constexpr (std::is_integral_v<T>) {
        if (how != CellValues::divided)
            return most_frequent(std::span<const PieceValue<T>>(pieces));
    }
    T sum{};
    for (const PieceValue<T>& piece : pieces) {
        if (how == CellValues::divided) {
            sum += piece.value;
        } else {
            sum += piece.value / static_cast<Real<T>>(1U << piece.halvings);
        }
    }
    return sum;
}

/// Values of cells, `components` for each, that coarsening made of those of their pieces.
template <class T>
[[nodiscard]] std::vector<T> merged_values(const std::vector<T>& values, std::size_t components,
                                           const Succession& cells, CellValues how) {
    const PiecesOfWholes all = pieces_of_wholes(cells);
    std::vector<T> wholes;
    wholes.reserve(cells.count() * components);
    std::vector<PieceValue<T>> pieces;
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
