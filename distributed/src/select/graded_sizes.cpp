#include "select/graded_sizes.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

#include <octetra/core/select_cells.hpp>

#include "topology/face_neighbours.hpp"

namespace octetra::distributed {
namespace {

/// The size of a cell at the other side of a face of cell `to`, which the receiver has.
struct Offer {
    double size;
    Point centroid;
    std::uint64_t to;
};

class Gradation {
public:
    Gradation(const DistributedMesh& mesh, std::vector<double> sizes, double growth)
        : sizes_(std::move(sizes)),
          growth_(growth),
          rank_(mesh.processes.rank()),
          neighbours_(find_face_neighbours(mesh)),
          is_to_send_(sizes_.size(), 1) {
        for (const auto& [a, b, c, d] : mesh.cells) {
            centroids_.push_back(
                centroid({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]}));
        }
        for (CellIndex c{0}; c < neighbours_.end_index(); ++c) {
            if (std::ranges::any_of(neighbours_[c], [&](const FaceNeighbour& other) {
                    return is_elsewhere(other);
                })) {
                border_.push_back(c);
            }
        }
        for (const Interface& interface : mesh.interfaces) ranks_.push_back(interface.rank);
    }

    /// Collective. Lowers sizes until no pair of cells violates the limit.
    std::vector<double> limited(const Communicator& processes) && {
        for (CellIndex c{0}; c < neighbours_.end_index(); ++c) offer_to_neighbours(c);
        spread();
        for (;;) {
            const std::vector<std::vector<Offer>> sent = offers();
            std::uint64_t count = 0;
            for (const auto& list : sent) count += list.size();
            if (processes.max(count) == 0) return std::move(sizes_);
            for (const auto& list : processes.exchange_with(ranks_, sent)) {
                for (const Offer& offer : list) {
                    lower(CellIndex{offer.to}, offer.size, offer.centroid);
                }
            }
            spread();
        }
    }

private:
    /// Lowers the size of a cell to what the size at a neighbour's centroid admits.
    void lower(CellIndex cell, double size, const Point& from) {
        const double limit = size + growth_ * length(from, centroids_[cell.value()]);
        if (!(limit < sizes_[cell.value()])) return;
        sizes_[cell.value()] = limit;
        is_to_send_[cell.value()] = 1;
        lowered_.emplace(limit, cell.value());
    }
    void offer_to_neighbours(CellIndex cell) {
        for (const FaceNeighbour& other : neighbours_[cell]) {
            if (other.rank == rank_) {
                lower(other.cell, sizes_[cell.value()], centroids_[cell.value()]);
            }
        }
    }
    /// Visits lowered cells by ascending size, so that few are visited twice.
    void spread() {
        while (!lowered_.empty()) {
            const auto [size, cell] = lowered_.top();
            lowered_.pop();
            if (size == sizes_[cell]) offer_to_neighbours(CellIndex{cell});
        }
    }
    /// Returns the sizes that others do not know yet, for each neighbouring rank.
    std::vector<std::vector<Offer>> offers() {
        std::vector<std::vector<Offer>> lists(ranks_.size());
        for (const CellIndex c : border_) {
            if (std::exchange(is_to_send_[c.value()], std::uint8_t{0}) == 0) continue;
            for (const FaceNeighbour& other : neighbours_[c]) {
                if (!is_elsewhere(other)) continue;
                lists[place_of(other.rank)].push_back(
                    {sizes_[c.value()], centroids_[c.value()], other.cell.value()});
            }
        }
        return lists;
    }
    [[nodiscard]] bool is_elsewhere(const FaceNeighbour& other) const {
        return !other.is_boundary() && other.rank != rank_;
    }
    [[nodiscard]] std::size_t place_of(int rank) const {
        return static_cast<std::size_t>(std::ranges::find(ranks_, rank) - ranks_.begin());
    }

    using Lowered = std::pair<double, std::uint32_t>;  // the size and the cell

    std::vector<double> sizes_;
    double growth_;
    int rank_;
    FaceNeighbours neighbours_;
    std::vector<std::uint8_t> is_to_send_;  ///< whether a size has changed since it was sent
    std::vector<Point> centroids_;
    std::vector<CellIndex> border_;  ///< the cells with a face that another process has
    std::vector<int> ranks_;         ///< the neighbouring ranks
    std::priority_queue<Lowered, std::vector<Lowered>, std::greater<>> lowered_;
};

}  // namespace

std::vector<double> graded_sizes(const DistributedMesh& mesh, std::vector<double> sizes,
                                 double gradation) {
    return Gradation(mesh, std::move(sizes), gradation - 1).limited(mesh.processes);
}

}  // namespace octetra::distributed
