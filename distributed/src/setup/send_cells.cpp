#include "setup/send_cells.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <octetra/core/huge_pages.hpp>

namespace octetra::distributed {
namespace {

struct CellToSend {
    CellVertices vertices;
    std::uint32_t number = 0;
    Marker region = 0;
};

/// Collective. Returns the number of cells that this process receives from each process.
std::vector<std::uint64_t> counts_to_receive(const Communicator& processes,
                                             const std::vector<int>& parts) {
    std::vector<std::vector<std::uint64_t>> sent(static_cast<std::size_t>(processes.size()));
    for (const int part : parts) {
        auto& count = sent[static_cast<std::size_t>(part)];
        if (count.empty()) count.push_back(0);
        ++count.front();
    }
    const auto received = processes.all_to_all(sent);
    std::vector<std::uint64_t> counts;
    for (const auto& from_one : received) counts.push_back(from_one.empty() ? 0 : from_one.front());
    return counts;
}

/// The cells of a part during the exchange. Cells that stay are kept at the front of the lists that
/// were read; received cells are kept in separate lists until there is room between them.
class CellExchange {
public:
    CellExchange(const Communicator& processes, MeshShare& share, const ShareCorners& corners,
                 const std::vector<int>& parts)
        : own_(static_cast<std::size_t>(processes.rank())),
          share_(&share),
          corners_(&corners),
          parts_(&parts) {}

    /// Reserves the memory for the whole part.
    void make_room(const std::vector<std::uint64_t>& counts) {
        const auto own = counts.begin() + static_cast<std::ptrdiff_t>(own_);
        before_ = std::accumulate(counts.begin(), own, std::uint64_t{0});
        const std::uint64_t count = std::accumulate(own, counts.end(), before_);
        reserve_in_huge_pages(cells(), count);
        if (has_regions()) reserve_in_huge_pages(regions(), count);
        reserve_in_huge_pages(numbers_, count);
        numbers_.resize(count);
        received_.resize(counts.size());
        for (std::size_t rank = 0; rank < counts.size(); ++rank) {
            if (rank != own_) received_[rank].reserve(counts[rank]);
        }
        boxes_.resize(counts.size());
    }
    [[nodiscard]] const std::vector<std::vector<CellToSend>>& boxes() const { return boxes_; }

    /// Continues to iterate over the cells read, until `at_once` leaving cells are in boxes.
    void fill_boxes(std::size_t at_once) {
        for (auto& box : boxes_) box.clear();
        for (std::size_t in_boxes = 0; next_ < parts_->size() && in_boxes < at_once; ++next_) {
            const CellVertices vertices = corners_->numbers_of(next_);
            const std::uint64_t number = share_->first_cell + next_;
            const Marker region = has_regions() ? regions()[CellIndex{next_}] : Marker{0};
            const auto to = static_cast<std::size_t>((*parts_)[next_]);
            if (to == own_) {
                stay(vertices, number, region);
            } else {
                boxes_[to].push_back({vertices, static_cast<std::uint32_t>(number), region});
                ++in_boxes;
            }
        }
    }
    void take(const std::vector<std::vector<CellToSend>>& inboxes) {
        for (std::size_t rank = 0; rank < inboxes.size(); ++rank) {
            received_[rank].insert(received_[rank].end(), inboxes[rank].begin(),
                                   inboxes[rank].end());
        }
    }

    /// Joins the shares in the order of ranks, which is the order of cell numbers.
    [[nodiscard]] CellsOfPart join() && {
        make_room_before(cells());
        if (has_regions()) make_room_before(regions());
        std::size_t i = 0;
        for (std::size_t rank = 0; rank < received_.size(); ++rank) {
            if (rank == own_) i += kept_count_;
            for (const CellToSend& cell : received_[rank]) {
                cells()[CellIndex{i}] = cell.vertices;
                if (has_regions()) regions()[CellIndex{i}] = cell.region;
                numbers_[i++] = cell.number;
            }
        }
        return {std::move(cells()), std::move(numbers_), std::move(regions())};
    }

private:
    [[nodiscard]] IndexVector<CellIndex, CellVertices>& cells() const {
        return share_->lists.cells;
    }
    [[nodiscard]] IndexVector<CellIndex, Marker>& regions() const { return share_->lists.regions; }
    [[nodiscard]] bool has_regions() const { return share_->facts.has_regions; }

    /// Moves a staying cell forward; the target was already read, or is the cell itself.
    void stay(const CellVertices& vertices, std::uint64_t number, Marker region) {
        cells()[CellIndex{kept_count_}] = vertices;
        if (has_regions()) regions()[CellIndex{kept_count_}] = region;
        numbers_[before_ + kept_count_++] = number;
    }
    void make_room_before(auto& list) {
        list.resize(std::max(list.size(), numbers_.size()));
        const auto begin = list.begin();
        std::move_backward(begin, begin + static_cast<std::ptrdiff_t>(kept_count_),
                           begin + static_cast<std::ptrdiff_t>(before_ + kept_count_));
        list.resize(numbers_.size());
    }

    std::size_t own_;
    MeshShare* share_;
    const ShareCorners* corners_;
    const std::vector<int>* parts_;
    std::uint64_t before_ = 0;  // number of cells received from lower ranks
    std::size_t kept_count_ = 0;
    std::size_t next_ = 0;
    std::vector<std::uint64_t> numbers_;
    std::vector<std::vector<CellToSend>> boxes_;
    std::vector<std::vector<CellToSend>> received_;
};

}  // namespace

CellsOfPart send_cells(const Communicator& processes, MeshShare& share, const ShareCorners& corners,
                       const std::vector<int>& parts) {
    constexpr std::size_t at_once = std::size_t{1} << 15U;
    CellExchange exchange(processes, share, corners, parts);
    exchange.make_room(counts_to_receive(processes, parts));
    const auto leaving = static_cast<std::uint64_t>(
        std::ranges::count_if(parts, [&](int part) { return part != processes.rank(); }));
    const std::uint64_t rounds = processes.max((leaving + at_once - 1) / at_once);
    for (std::uint64_t round = 0; round < rounds; ++round) {
        exchange.fill_boxes(at_once);
        exchange.take(processes.all_to_all(exchange.boxes()));
    }
    exchange.fill_boxes(at_once);
    return std::move(exchange).join();
}

}  // namespace octetra::distributed
