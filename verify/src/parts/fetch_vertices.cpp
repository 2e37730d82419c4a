#include "parts/fetch_vertices.hpp"

#include "parts/exchange.hpp"

namespace octetra::verify {
namespace {

/// The vertex numbers that each process requests from this one.
using Requests = std::vector<std::vector<std::uint32_t>>;

Requests ask(const std::vector<std::uint32_t>& wanted, const MeshSlice& slice,
             const ProcessGroup& group) {
    Requests to_each;
    auto begin = wanted.begin();
    for (int r = 0; r < group.size(); ++r) {
        const std::uint64_t last = slice_begin(slice.totals.vertices, r + 1, group.size());
        const auto end = std::lower_bound(begin, wanted.end(), last);
        to_each.emplace_back(begin, end);
        begin = end;
    }
    return exchange(group, std::move(to_each));
}

/// Collective. Returns the requested elements, in the order of the requests, of a distributed list
/// with `per_vertex` elements for each vertex. The list may be empty.
template <class T>
std::vector<T> answer(const Requests& requests, const std::vector<T>& list, std::size_t per_vertex,
                      const MeshSlice& slice, const ProcessGroup& group) {
    const std::uint64_t first = slice_begin(slice.totals.vertices, group.rank(), group.size());
    std::vector<std::vector<T>> answers(requests.size());
    for (std::size_t r = 0; r < requests.size() && !list.empty(); ++r) {
        answers[r].reserve(requests[r].size() * per_vertex);
        for (const std::uint32_t v : requests[r]) {
            const auto at = list.begin() + static_cast<std::ptrdiff_t>((v - first) * per_vertex);
            answers[r].insert(answers[r].end(), at, at + static_cast<std::ptrdiff_t>(per_vertex));
        }
    }
    std::vector<T> all;
    for (const auto& of_one : exchange(group, std::move(answers))) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
}

}  // namespace

IndexVector<VertexIndex, Point> fetch_points(const std::vector<std::uint32_t>& wanted,
                                             const MeshSlice& slice, const ProcessGroup& group) {
    const auto points =
        answer<Point>(ask(wanted, slice, group), slice.lists.points, 1, slice, group);
    return {points.begin(), points.end()};
}

void fetch_vertices(const std::vector<std::uint32_t>& wanted, const MeshSlice& slice,
                    const ProcessGroup& group, Mesh& mesh) {
    const Requests requests = ask(wanted, slice, group);
    const Mesh& lists = slice.lists;
    const auto points = answer<Point>(requests, lists.points, 1, slice, group);
    const auto markers = answer<Marker>(requests, lists.point_markers, 1, slice, group);
    mesh.points.assign(points.begin(), points.end());
    mesh.point_markers.assign(markers.begin(), markers.end());
    mesh.attributes_per_point = lists.attributes_per_point;
    mesh.point_attributes =
        answer(requests, lists.point_attributes, lists.attributes_per_point, slice, group);
}

}  // namespace octetra::verify
