#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octetra::distributed {

/// The bisection of an entity into children: the volume (area, length) of child k is the fraction
/// 2^-halvings[k] of the parent's, up to the rounding of midpoints.
struct Division {
    std::uint8_t piece_count = 1;
    std::array<std::uint8_t, 8> halvings{};

    friend auto operator<=>(const Division&, const Division&) = default;
};

/// The map between this process's cells, or tagged facets, or tagged edges, before and after a
/// step. All numbers are local.
///
/// Refinement: if few entities changed, those that were not bisected keep their numbers; the first
/// child of a bisected entity takes the number of its parent, and the other children are appended.
/// If many changed, all entities get new numbers.
///
/// Coarsening, for which merges() is true: fine entities are merged into coarse ones, and any
/// entity may get a new number.
class EntityTransfer {
public:
    /// A step that changes nothing.
    explicit EntityTransfer(std::size_t count = 0) : count_before_(count), count_(count) {}

    /// The number of entities before the step.
    [[nodiscard]] std::size_t count_before() const { return count_before_; }
    /// The number of entities after the step.
    [[nodiscard]] std::size_t count() const { return count_; }

    /// Returns whether all entities that were not bisected keep their numbers.
    [[nodiscard]] bool keeps_numbers() const { return keeps_numbers_; }

    /// Returns whether the step was coarsening. Only then coarse_of() and halvings() are defined.
    [[nodiscard]] bool merges() const { return merges_; }
    /// For each entity before the step, the entity after it that it became or was merged into.
    [[nodiscard]] std::span<const std::uint32_t> coarse_of() const { return coarse_of_; }
    /// For each cell before coarsening, the number of bisections that separate it from the coarse
    /// cell: its volume is the fraction 2^-halvings, up to the rounding of midpoints.
    [[nodiscard]] std::span<const std::uint8_t> halvings() const { return halvings_; }

    /// Refinement only. Calls visit(number, before, halvings) for entities after the step, where
    /// `before` is the number of the same entity or of its parent before the step. If
    /// keeps_numbers() is false, all entities are visited in ascending order; if it is true, only
    /// the children of bisected entities.
    void for_each_new(auto&& visit) const {
        if (lists_parents_) {
            for (std::size_t k = 0; k < count_; ++k) {
                visit(k, std::size_t{before_[k]}, unsigned{halvings_[k]});
            }
            return;
        }
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

    /// Refinement only. Returns for each entity after the step the number of the same entity or of
    /// its parent before the step. Takes time proportional to the number of entities.
    [[nodiscard]] std::vector<std::uint32_t> parents() const;

    // Interface for the code that bisects.
    struct Cut {
        std::uint32_t before = 0;
        std::uint8_t division = 0;  ///< index into the divisions
    };
    /// The map for a list in which `cuts` were bisected, in this order, and all other entities kept
    /// their numbers. The divisions must outlive the result.
    [[nodiscard]] static EntityTransfer of_cuts(std::size_t count, std::vector<Cut> cuts,
                                                std::span<const Division> divisions);
    /// The map for a list whose entities were all replaced, in order, by their children by
    /// `division_of`. The divisions must outlive the result.
    [[nodiscard]] static EntityTransfer of_all(std::vector<std::uint8_t> division_of,
                                               std::span<const Division> divisions);

    /// The map for a list of new numbers: `before` has the number of the same entity or of its
    /// parent before the step, `halvings` the number of bisections between them.
    [[nodiscard]] static EntityTransfer of_parents(std::size_t count_before,
                                                   std::vector<std::uint32_t> before,
                                                   std::vector<std::uint8_t> halvings);
    /// The map for a list whose entities were merged into `count` coarse ones. `halvings` is empty
    /// for facets and edges.
    [[nodiscard]] static EntityTransfer of_merges(std::size_t count,
                                                  std::vector<std::uint32_t> coarse_of,
                                                  std::vector<std::uint8_t> halvings);

    /// Composes the map with a preceding permutation: `before` has the number before it of each
    /// entity, or is empty.
    void set_order(std::vector<std::uint32_t> before) { before_ = std::move(before); }

private:
    std::size_t count_before_;
    std::size_t count_;
    bool keeps_numbers_ = true;
    std::span<const Division> divisions_;
    std::vector<Cut> cuts_;
    std::vector<std::uint32_t> before_;
    std::vector<std::uint8_t> division_of_;
    bool lists_parents_ = false;
    bool merges_ = false;
    std::vector<std::uint32_t> coarse_of_;
    std::vector<std::uint8_t> halvings_;
};

/// The fine entities of each coarse one: those of coarse entity w are pieces[first[w]] ..
/// pieces[first[w + 1] - 1].
struct FineOfCoarse {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> pieces;
};
/// Inverts coarse_of() of a coarsening.
[[nodiscard]] FineOfCoarse fine_of_coarse(const EntityTransfer& merges);

}  // namespace octetra::distributed
