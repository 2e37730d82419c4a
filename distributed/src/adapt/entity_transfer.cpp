#include <octetra/distributed/entity_transfer.hpp>

#include <numeric>

namespace octetra::distributed {

EntityTransfer EntityTransfer::of_cuts(std::size_t count, std::vector<Cut> cuts,
                                       std::span<const Division> divisions) {
    EntityTransfer entity_transfer(count);
    for (const Cut& cut : cuts) entity_transfer.count_ += divisions[cut.division].piece_count - 1U;
    entity_transfer.cuts_ = std::move(cuts);
    entity_transfer.divisions_ = divisions;
    return entity_transfer;
}

EntityTransfer EntityTransfer::of_all(std::vector<std::uint8_t> division_of,
                                      std::span<const Division> divisions) {
    EntityTransfer entity_transfer(division_of.size());
    entity_transfer.count_ = 0;
    for (const std::uint8_t d : division_of) entity_transfer.count_ += divisions[d].piece_count;
    entity_transfer.keeps_numbers_ = false;
    entity_transfer.division_of_ = std::move(division_of);
    entity_transfer.divisions_ = divisions;
    return entity_transfer;
}

EntityTransfer EntityTransfer::of_parents(std::size_t count_before,
                                          std::vector<std::uint32_t> before,
                                          std::vector<std::uint8_t> halvings) {
    EntityTransfer entity_transfer(count_before);
    entity_transfer.count_ = before.size();
    entity_transfer.keeps_numbers_ = false;
    entity_transfer.lists_parents_ = true;
    entity_transfer.before_ = std::move(before);
    entity_transfer.halvings_ = std::move(halvings);
    return entity_transfer;
}

std::vector<std::uint32_t> EntityTransfer::parents() const {
    std::vector<std::uint32_t> parents(count_);
    if (keeps_numbers_) {
        std::iota(parents.begin(), parents.begin() + static_cast<std::ptrdiff_t>(count_before_),
                  0U);
    }
    for_each_new([&](std::size_t number, std::size_t before, unsigned) {
        parents[number] = static_cast<std::uint32_t>(before);
    });
    return parents;
}

EntityTransfer EntityTransfer::of_merges(std::size_t count, std::vector<std::uint32_t> coarse_of,
                                         std::vector<std::uint8_t> halvings) {
    EntityTransfer entity_transfer(coarse_of.size());
    entity_transfer.count_ = count;
    entity_transfer.keeps_numbers_ = false;
    entity_transfer.merges_ = true;
    entity_transfer.coarse_of_ = std::move(coarse_of);
    entity_transfer.halvings_ = std::move(halvings);
    return entity_transfer;
}

FineOfCoarse fine_of_coarse(const EntityTransfer& merges) {
    const auto coarse_of = merges.coarse_of();
    FineOfCoarse all{std::vector<std::uint32_t>(merges.count() + 1, 0),
                     std::vector<std::uint32_t>(coarse_of.size())};
    for (const std::uint32_t whole : coarse_of) ++all.first[whole + std::size_t{1}];
    std::partial_sum(all.first.begin(), all.first.end(), all.first.begin());
    std::vector<std::uint32_t> next = all.first;
    for (std::uint32_t piece = 0; piece < coarse_of.size(); ++piece) {
        all.pieces[next[coarse_of[piece]]++] = piece;
    }
    return all;
}

}  // namespace octetra::distributed
