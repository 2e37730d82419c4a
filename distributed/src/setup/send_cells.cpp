#include "setup/send_cells.hpp"

#include <algorithm>

#include <octetra/core/huge_pages.hpp>

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
    const auto put = [&](std::uint64_t i, const CellToSend& cell) {
        part.cells[CellIndex{i}] = cell.vertices;
        part.numbers[i] = cell.number;
        if (!part.regions.empty()) part.regions[i] = cell.region;
    };
    const auto own = static_cast<std::size_t>(processes.rank());
    const auto leaving = static_cast<std::uint64_t>(std::ranges::count_if(
        parts, [&](int part_of_one) { return part_of_one != processes.rank(); }));
    const std::uint64_t rounds = processes.max((leaving + at_once - 1) / at_once);
    std::size_t i = 0;
    // What stays is put in its place at once: in a mesh whose file is well ordered, most.
    const auto take_own_and_fill_boxes = [&] {
        for (auto& box : boxes) box.clear();
        for (std::size_t in_boxes = 0; i < parts.size() && in_boxes < at_once; ++i) {
            const CellToSend cell{corners.numbers_of(i),
                                  static_cast<std::uint32_t>(stretch.first_cell + i),
                                  lists.regions.empty() ? Marker{0} : lists.regions[CellIndex{i}]};
            const auto to = static_cast<std::size_t>(parts[i]);
            if (to == own) {
                put(next[own]++, cell);
            } else {
                boxes[to].push_back(cell);
                ++in_boxes;
            }
        }
    };
    for (std::uint64_t round = 0; round < rounds; ++round) {
        failure.attempt(take_own_and_fill_boxes);
        failure.agree(processes);
        failure.attempt([&] {
            const auto come = processes.all_to_all(boxes);
            for (std::size_t rank = 0; rank < come.size(); ++rank) {
                for (const CellToSend& cell : come[rank]) put(next[rank]++, cell);
            }
        });
    }
    failure.attempt(take_own_and_fill_boxes);
    failure.agree(processes);
    return part;
}

}  // namespace octetra::distributed
