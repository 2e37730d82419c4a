#include <octetra/distributed/succession.hpp>

#include <numeric>

namespace octetra::distributed {

Succession Succession::of_cuts(std::size_t count, std::vector<Cut> cuts,
                               std::span<const Division> divisions) {
    Succession succession(count);
    for (const Cut& cut : cuts) succession.count_ += divisions[cut.division].piece_count - 1U;
    succession.cuts_ = std::move(cuts);
    succession.divisions_ = divisions;
    return succession;
}

Succession Succession::of_all(std::vector<std::uint8_t> division_of,
                              std::span<const Division> divisions) {
    Succession succession(division_of.size());
    succession.count_ = 0;
    for (const std::uint8_t d : division_of) succession.count_ += divisions[d].piece_count;
    succession.keeps_numbers_ = false;
    succession.division_of_ = std::move(division_of);
    succession.divisions_ = divisions;
    return succession;
}

std::vector<std::uint32_t> Succession::parents() const {
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

Succession Succession::of_merges(std::size_t count, std::vector<std::uint32_t> whole_of,
                                 std::vector<std::uint8_t> halvings) {
    Succession succession(whole_of.size());
    succession.count_ = count;
    succession.keeps_numbers_ = false;
    succession.merges_ = true;
    succession.whole_of_ = std::move(whole_of);
    succession.halvings_ = std::move(halvings);
    return succession;
}

PiecesOfWholes pieces_of_wholes(const Succession& merges) {
    const auto whole_of = merges.whole_of();
    PiecesOfWholes all{std::vector<std::uint32_t>(merges.count() + 1, 0),
                       std::vector<std::uint32_t>(whole_of.size())};
    for (const std::uint32_t whole : whole_of) ++all.first[whole + std::size_t{1}];
    std::partial_sum(all.first.begin(), all.first.end(), all.first.begin());
    std::vector<std::uint32_t> next = all.first;
    for (std::uint32_t piece = 0; piece < whole_of.size(); ++piece) {
        all.pieces[next[whole_of[piece]]++] = piece;
    }
    return all;
}

}  // namespace octetra::distributed
