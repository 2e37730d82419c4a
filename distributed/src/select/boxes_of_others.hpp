#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include <octetra/core/box_tree.hpp>
#include <octetra/core/triangle_tree.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "mark/selection_bounds.hpp"

/// Search for the nearest of entities that are distributed over the processes: each process sends a
/// point to those whose boxes of entities are near enough.
namespace octetra::distributed {

/// Boxes that a process sends to all others in place of its entities.
constexpr std::size_t most_boxes = 64;

/// Collective. Returns the lists of all processes, by rank.
template <class T>
std::vector<std::vector<T>> lists_of_all(const Communicator& processes, std::vector<T> list) {
    const auto bytes = std::as_bytes(std::span<const T>(list));
    std::vector<std::vector<T>> lists;
    for (const ProcessGroup::Bytes& received : processes.of_all({bytes.begin(), bytes.end()})) {
        std::vector<T>& of_rank = lists.emplace_back(received.size() / sizeof(T));
        if (!received.empty()) std::memcpy(of_rank.data(), received.data(), received.size());
    }
    return lists;
}

/// Collective. Returns the exponent of the unit of length in which the mesh has an extent of about
/// 1.
[[nodiscard]] int common_exponent(const DistributedMesh& mesh);

/// The boxes of the entities of the other processes.
class BoxesOfOthers {
public:
    BoxesOfOthers(std::vector<std::vector<Box>> boxes, int own_rank);

    /// Returns an upper bound of the squared distance to the entities of others: each box has one.
    [[nodiscard]] double bound(const Point& p, double bound) const;
    /// Calls visit(r) for the processes that may have an entity as near as `squared`.
    void for_each_within(const Point& p, double squared, auto&& visit) const {
        const double limit = limit_of_boxes(squared);
        const auto is_within = [&](const Box& box) {
            return least_squared_distance(p, box) <= limit;
        };
        for (std::size_t r = 0; r < boxes_.size(); ++r) {
            if (boxes_[r].empty() || !is_within(all_[r])) continue;
            if (std::ranges::any_of(boxes_[r], is_within)) visit(r);
        }
    }

private:
    std::vector<std::vector<Box>> boxes_;  ///< by rank
    std::vector<Box> all_;                 ///< their bounding boxes
};

}  // namespace octetra::distributed
