#include "shapes/cell_certifier.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/face_edges.hpp"
#include "shapes/extremes.hpp"
#include "shapes/patterns.hpp"

namespace octetra::verify::shapes {
namespace {

/// Squared lengths are nearly equal if they differ by less than one part in 2^30.
constexpr int near_tie_bits = 30;

/// Factors that bring the numbers of a cell near 1.
struct Scale {
    int shift = 0;      ///< lengths are multiplied by 2^-shift, their squares by its square
    double volume = 0;  ///< six times that of the root, scaled
};

template <class Int>
Scale scale_of(const RootShape& root, const std::array<Int, 6>& lengths) {
    const int shift = bit_count(*std::ranges::max_element(lengths)) / 2;
    return {shift, rounded(six_volumes(root), -3 * shift)};
}

/// The longest edges of the faces of a shape.
struct LongestEdges {
    /// For each face, positions among its edges, one bit each: several if lengths differ so little
    /// that rounding may decide which is the longest.
    std::array<std::uint8_t, 4> of_face{};
    bool has_ties = false;  ///< two longest edges of a face
    bool has_near_ties = false;
};

/// Among equal lengths, selects that of the edge with the higher number. If corners ascend
/// lexicographically, that is the order of core/edge_order.hpp.
template <class Int>
LongestEdges longest_edges(const std::array<Int, 6>& l) {
    LongestEdges result;
    for (std::size_t f = 0; f < 4; ++f) {
        const auto& edges = face_edges[f];
        std::size_t longest = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (l[edges[k]] >= l[edges[longest]]) longest = k;
        }
        unsigned candidates = 1U << longest;
        const Int& length = l[edges[longest]];
        for (std::size_t k = 0; k < 3; ++k) {
            if (k == longest) continue;
            const Int difference = length - l[edges[k]];
            if (difference == 0) {
                result.has_ties = true;
            } else if (difference < (length >> near_tie_bits)) {
                result.has_near_ties = true;
                candidates |= 1U << k;
            }
        }
        result.of_face[f] = static_cast<std::uint8_t>(candidates);
    }
    return result;
}

/// Calls visit(pattern) for each pattern that these longest edges permit.
void for_each_pattern(const LongestEdges& longest, auto&& visit) {
    for (std::size_t key = 0; key < face_key_count; ++key) {
        bool is_permitted = true;
        std::size_t rest = key;
        for (const std::uint8_t candidates : longest.of_face) {
            is_permitted = is_permitted && (candidates >> rest % 3 & 1U) != 0;
            rest /= 3;
        }
        if (!is_permitted) continue;
        const Pattern* pattern = pattern_of(static_cast<FaceKey>(key));
        if (pattern != nullptr) visit(*pattern);
    }
}

/// Measures the members of a set and the transition cells in them.
template <class Int>
class Measure {
public:
    explicit Measure(const Scale& scale)
        : scale_(scale), factor_(std::ldexp(1.0, -2 * scale.shift)) {
        constexpr double least_volume = 0x1p-500;
        if (scale.volume < least_volume) throw CellCertifier::TooThin{};
    }

    void set_cell(const std::array<Int, 6>& lengths) {
        exact_ = all_lengths(lengths);
        for (std::size_t k = 0; k < length_count; ++k) {
            rounded_[k] = near_one(exact_[k]);
            constexpr double least_length = 0x1p-300;
            if (rounded_[k] < least_length) throw CellCertifier::TooThin{};
        }
    }
    void add_cell() { add({0, 1, 2, 3, 4, 5}, scale_.volume); }
    void add_piece(const Piece& piece) {
        add(piece.lengths, std::ldexp(scale_.volume, 3 - piece.depth));
    }

    [[nodiscard]] ShapeBounds bounds() const { return extremes_.bounds(); }

private:
    double near_one(const Int& length) const {
        if constexpr (std::is_same_v<Int, Int128>) {
            return static_cast<double>(length) * factor_;
        } else {
            return rounded(length, -2 * scale_.shift);
        }
    }

    void add(const std::array<std::uint8_t, 6>& lengths, double volume) {
        RoundedPiece piece{.volume = volume};
        for (std::size_t e = 0; e < 6; ++e) piece.lengths[e] = rounded_[lengths[e]];
        extremes_.add(piece, [&](std::size_t edge) {
            std::array<BigInt, 6> exact;
            for (std::size_t e = 0; e < 6; ++e) exact[e] = BigInt(exact_[lengths[e]]);
            return rounded(four_cosines(exact, edge), -4 * scale_.shift);
        });
    }

    Scale scale_;
    double factor_;
    std::array<Int, length_count> exact_;
    std::array<double, length_count> rounded_{};
    Extremes extremes_;
};

/// Members are squared lengths, which determine a shape up to similarity. Correct as long as no
/// face of a member has two longest edges: lengths then determine the pattern, and so the children.
template <class Int>
struct UpToSimilarity {
    static constexpr bool needs_distinct_lengths = true;
    using Member = std::array<Int, 6>;

    static Member root(const Vectors<Int>& vectors) {
        return up_to_congruence(squared_lengths(vectors));
    }
    static const std::array<Int, 6>& lengths(const Member& member) { return member; }
    static Member child(const Piece& piece, const Member& member) {
        const std::array<Int, length_count> all = all_lengths(member);
        std::array<Int, 6> lengths;
        for (std::size_t e = 0; e < 6; ++e) lengths[e] = all[piece.lengths[e]];
        return up_to_congruence(lengths);
    }
};

/// Members are vectors, which determine a shape up to translation and scaling.
template <class Int>
struct UpToTranslation {
    static constexpr bool needs_distinct_lengths = false;
    using Member = Vectors<Int>;

    static Member root(const Vectors<Int>& vectors) { return vectors; }
    static std::array<Int, 6> lengths(const Member& member) { return squared_lengths(member); }
    static Member child(const Piece& piece, const Member& member) {
        return vectors_of_piece(piece, member);
    }
};

enum class Outcome : std::uint8_t { done, lengths_tie, overflow };

/// Closes the set of shapes of a root, and writes the certificate, except for the number of shapes.
template <class Equivalence, class Set, class Int>
Outcome close(const RootShape& root, Set& set, std::size_t limit, Measure<Int> measure,
              CellCertificate& certificate) {
    set.clear();
    set.insert(Equivalence::root(vectors_of<Int>(root)));
    certificate = {};
    std::size_t begin = 0;
    for (std::uint32_t generation = 0; begin < set.size(); ++generation) {
        const std::size_t end = set.size();
        for (std::size_t k = begin; k < end; ++k) {
            const auto member = set[k];
            const std::array<Int, 6> lengths = Equivalence::lengths(member);
            if (!std::ranges::all_of(lengths, fits<Int>)) return Outcome::overflow;
            const LongestEdges longest = longest_edges(lengths);
            if (longest.has_ties && Equivalence::needs_distinct_lengths)
                return Outcome::lengths_tie;
            certificate.has_ties |= longest.has_ties;
            certificate.has_near_ties |= longest.has_near_ties;
            measure.set_cell(lengths);
            measure.add_cell();
            for_each_pattern(longest, [&](const Pattern& pattern) {
                for (const Piece& piece : pattern.transition_cells) measure.add_piece(piece);
                for (const Piece& piece : pattern.children) {
                    if (set.size() <= limit) set.insert(Equivalence::child(piece, member));
                }
            });
        }
        certificate.generations = generation + 1;
        if (set.size() > limit) {
            // A transition cell may be a child, so those of the last generation are measured as
            // well.
            certificate.generations = generation;
            for (std::size_t k = begin; k < end; ++k) {
                const std::array<Int, 6> lengths = Equivalence::lengths(set[k]);
                measure.set_cell(lengths);
                for_each_pattern(longest_edges(lengths), [&](const Pattern& pattern) {
                    for (const Piece& piece : pattern.children) measure.add_piece(piece);
                });
            }
            break;
        }
        begin = end;
    }
    certificate.is_closed = set.size() <= limit;
    certificate.placements = set.size();
    certificate.bounds = measure.bounds();
    return Outcome::done;
}

/// Returns the certificate, or nothing if integers of this size do not suffice.
template <class Int>
std::optional<CellCertificate> certify_with(const RootShape& root, std::size_t limit,
                                            ShapeSet<Int, 6>& similar, ShapeSet<Int, 9>& placed) {
    const std::array<Int, 6> lengths = squared_lengths(vectors_of<Int>(root));
    const Measure<Int> measure(scale_of(root, lengths));
    CellCertificate certificate;
    Outcome outcome = close<UpToSimilarity<Int>>(root, similar, limit, measure, certificate);
    if (outcome == Outcome::lengths_tie) {
        outcome = close<UpToTranslation<Int>>(root, placed, limit, measure, certificate);
        similar.clear();
        for (std::size_t k = 0; k < placed.size(); ++k) {
            similar.insert(up_to_congruence(squared_lengths(placed[k])));
        }
    }
    if (outcome == Outcome::overflow) return std::nullopt;
    certificate.shapes = similar.size();
    return certificate;
}

bool fit(const RootShape& root, int bits) {
    return root.is_small ||
           std::ranges::all_of(root.vectors, [&](const BigInt& x) { return bit_count(x) <= bits; });
}

}  // namespace

CellCertificate CellCertifier::certify(const RootShape& root) {
    if (root.is_small) {
        auto& [similar, placed] = std::get<0>(sets_);
        if (const auto found = certify_with<Int128>(root, limit_, similar, placed)) return *found;
    }
    constexpr int bits = 250;  // squared lengths are then less than 3 * 2^500
    if (fit(root, bits)) {
        auto& [similar, placed] = std::get<1>(sets_);
        if (const auto found = certify_with<Int512>(root, limit_, similar, placed)) return *found;
    }
    auto& [similar, placed] = std::get<2>(sets_);
    return *certify_with<BigInt>(root, limit_, similar, placed);
}

}  // namespace octetra::verify::shapes
