#include "setup/send_cells.hpp"

#include <algorithm>

#include "memory/huge_pages.hpp"

namespace octetra::distributed {
namespace {

struct CellToSend {
    CellVertices vertices;
    std::uint32_t number = 0;
    Marker region = 0;
};

/// Collective. How many cells come from each process.
std::vector<std::uint64_t> counts_to_come(const Communicator& processes,
                                          const std::vector<int>& parts, LocalFailure& failure) {
    std::vector<std::vector<std::uint64_t>> to_go;
    failure.attempt([&] {
        to_go.resize(static_cast<std::size_t>(processes.size()));
        for (const int part : parts) {
            auto& count = to_go[static_cast<std::size_t>(part)];
            if (count.empty()) count.push_back(0);
            ++count.front();
        }
    });
    failure.agree(processes);
    std::vector<std::vector<std::uint64_t>> to_come;
    failure.attempt([&] { to_come = processes.all_to_all(to_go); });
    failure.agree(processes);  // else who has no memory may have sent nothing
    std::vector<std::uint64_t> counts;
    failure.attempt([&] {
        for (const auto& from_one : to_come) {
            counts.push_back(from_one.empty() ? 0 : from_one.front());
        }
    });
    failure.agree(processes);
    return counts;
}

}  // namespace

CellsOfPart send_cells(const Communicator& processes, const MeshStretch& stretch,
                       const StretchCorners& corners, const std::vector<int>& parts,
                       LocalFailure& failure) {
    constexpr std::size_t at_once = std::size_t{1} << 15U;
    CellsOfPart part;
    // The stretches come in the order of the ranks, and each in its own.
    std::vector<std::uint64_t> next = counts_to_come(processes, parts, failure);
    std::vector<std::vector<CellToSend>> boxes;
    failure.attempt([&] {
        std::uint64_t count = 0;
        for (std::uint64_t& n : next) {
            const std::uint64_t from_one = n;
            n = count;
            count += from_one;
        }
        reserve_in_huge_pages(part.cells, count);
        reserve_in_huge_pages(part.numbers, count);
        part.cells.resize(count);
        part.numbers.resize(count);
        if (stretch.facts.has_regions) part.regions.resize(count);
        boxes.resize(static_cast<std::size_t>(processes.size()));
    });
    const Mesh& lists = stretch.lists;
    const std::uint64_t rounds = processes.max((parts.size() + at_once - 1) / at_once);
    for (std::size_t begin = 0, round = 0; round < rounds; ++round) {
        const std::size_t end = std::min(parts.size(), begin + at_once);
        failure.attempt([&] {
            for (auto& box : boxes) box.clear();
            for (std::size_t i = begin; i < end; ++i) {
                boxes[static_cast<std::size_t>(parts[i])].push_back(
                    {corners.numbers_of(i), static_cast<std::uint32_t>(stretch.first_cell + i),
                     lists.regions.empty() ? Marker{0} : lists.regions[CellIndex{i}]});
            }
        });
        failure.agree(processes);
        failure.attempt([&] {
            const auto come = processes.all_to_all(boxes);
            for (std::size_t rank = 0; rank < come.size(); ++rank) {
                for (const CellToSend& cell : come[rank]) {
                    const std::uint64_t i = next[rank]++;
                    part.cells[CellIndex{i}] = cell.vertices;
                    part.numbers[i] = cell.number;
                    if (!part.regions.empty()) part.regions[i] = cell.region;
                }
            }
        });
        begin = end;
    }
    failure.agree(processes);
    return part;
}

}  // namespace octetra::distributed
