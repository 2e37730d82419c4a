#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octetra::distributed {

/// How many pieces an entity was bisected into, and how often it was halved for each of them: the
/// share of piece k in its volume (area, length) is 2^-halvings[k], but for rounded midpoints.
struct Division {
    std::uint8_t piece_count = 1;
    std::array<std::uint8_t, 8> halvings{};

    friend auto operator<=>(const Division&, const Division&) = default;
};

/// How this process's cells, or tagged facets, or tagged edges became those after a step. All
/// numbers are local.
///
/// Of refinement: where little changed, what was not bisected has its number still: of what was,
/// the first piece has the number of the whole, and the others stand behind all that there was
/// before. Where much changed, all have new numbers.
///
/// Of coarsening, merges() is true: pieces became wholes, and any may have new numbers.
class Succession {
public:
    /// Nothing changed.
    explicit Succession(std::size_t count = 0) : count_before_(count), count_(count) {}

    [[nodiscard]] std::size_t count_before() const { return count_before_; }
    [[nodiscard]] std::size_t count() const { return count_; }

    /// Has all that was not bisected its number still?
    [[nodiscard]] bool keeps_numbers() const { return keeps_numbers_; }

    /// Was this coarsening? Then whole_of() and halvings() tell what became of what.
    [[nodiscard]] bool merges() const { return merges_; }
    /// For each entity of before, the one that it became or is a piece of.
    [[nodiscard]] std::span<const std::uint32_t> whole_of() const { return whole_of_; }
    /// Of cells, how often the whole had been halved for each of before: its share in the volume is
    /// 2^-halvings, but for rounded midpoints.
    [[nodiscard]] std::span<const std::uint8_t> halvings() const { return halvings_; }

    /// Of refinement. Calls visit(number, before, halvings) for each entity of after the step,
    /// where `before` is the number of what it is or is a piece of; in ascending order where
    /// keeps_numbers() is false. Where it is true, only for the pieces: those that take the place
    /// of a whole, and those behind.
    void for_each_new(auto&& visit) const {
        std::size_t next = keeps_numbers_ ? count_before_ : 0;
        const auto pieces = [&](std::uint32_t before, const Division& division, bool in_place) {
            for (std::size_t k = 0; k < division.piece_count; ++k) {
                visit(in_place && k == 0 ? std::size_t{before} : next++, std::size_t{before},
                      unsigned{division.halvings[k]});
            }
        };
        if (keeps_numbers_) {
            for (const Cut& cut : cuts_) pieces(cut.before, divisions_[cut.division], true);
            return;
        }
        for (std::size_t k = 0; k < division_of_.size(); ++k) {
            const auto before = before_.empty() ? static_cast<std::uint32_t>(k) : before_[k];
            pieces(before, divisions_[division_of_[k]], false);
        }
    }

    /// Of refinement. Of each entity after the step, the number of what it is or is a piece of.
    /// Takes time in proportion to all of them.
    [[nodiscard]] std::vector<std::uint32_t> parents() const;

    // For who bisects.
    struct Cut {
        std::uint32_t before = 0;
        std::uint8_t division = 0;  ///< one of the divisions
    };
    /// Of a list in which `cuts` were bisected, in this order, and all else kept its number.
    [[nodiscard]] static Succession of_cuts(std::size_t count, std::vector<Cut> cuts,
                                            std::span<const Division> divisions);
    /// Of a list whose entities came to be divided as `division_of` says, all in order. The
    /// divisions must outlive this.
    [[nodiscard]] static Succession of_all(std::vector<std::uint8_t> division_of,
                                           std::span<const Division> divisions);

    /// Of a list whose entities became `count` wholes. No halvings: not of cells.
    [[nodiscard]] static Succession of_merges(std::size_t count,
                                              std::vector<std::uint32_t> whole_of,
                                              std::vector<std::uint8_t> halvings);

    /// Of a list whose entities were brought into another order first: `before` are the numbers
    /// that they had, or empty.
    void set_order(std::vector<std::uint32_t> before) { before_ = std::move(before); }

private:
    std::size_t count_before_;
    std::size_t count_;
    bool keeps_numbers_ = true;
    std::span<const Division> divisions_;
    std::vector<Cut> cuts_;
    std::vector<std::uint32_t> before_;
    std::vector<std::uint8_t> division_of_;
    bool merges_ = false;
    std::vector<std::uint32_t> whole_of_;
    std::vector<std::uint8_t> halvings_;
};

/// The pieces of each whole, one whole after the other: of number w, pieces[first[w]] to
/// pieces[first[w + 1] - 1].
struct PiecesOfWholes {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> pieces;
};
/// Of coarsening.
[[nodiscard]] PiecesOfWholes pieces_of_wholes(const Succession& merges);

}  // namespace octetra::distributed
