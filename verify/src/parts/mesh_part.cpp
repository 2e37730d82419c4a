#include "parts/mesh_part.hpp"

#include <utility>

#include "parts/cut_space.hpp"
#include "parts/exchange.hpp"
#include "parts/fetch_vertices.hpp"
#include "parts/vertex_lookup.hpp"
#include "parts/views.hpp"

namespace octetra::verify {
namespace {

template <class I, std::size_t N>
void append_vertices(const IndexVector<I, std::array<VertexIndex, N>>& list,
                     std::vector<std::uint32_t>& numbers) {
    for (const auto& vertices : list) {
        for (const VertexIndex v : vertices) numbers.push_back(v.value());
    }
}

std::vector<std::uint32_t> vertices_of_entities(const Mesh& lists) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(4 * lists.cells.size());
    append_vertices(lists.cells, numbers);
    append_vertices(lists.facets, numbers);
    append_vertices(lists.edges, numbers);
    return numbers;
}

/// A slice with the coordinates of the vertices of its entities, wherever these are stored.
class LocatedSlice {
public:
    LocatedSlice(MeshSlice slice, const ProcessGroup& group)
        : slice_(std::move(slice)),
          lookup_(vertices_of_entities(slice_.lists)),
          points_(fetch_points(lookup_.numbers(), slice_, group)) {}

    [[nodiscard]] const MeshSlice& slice() const { return slice_; }
    [[nodiscard]] const Mesh& lists() const { return slice_.lists; }

    template <std::size_t N>
    [[nodiscard]] std::array<Point, N> corners(const std::array<VertexIndex, N>& vertices) const {
        std::array<Point, N> points;
        for (std::size_t k = 0; k < N; ++k) points[k] = points_[lookup_.find(vertices[k].value())];
        return points;
    }

    /// Returns the smallest corner of each cell, which determines its domain.
    [[nodiscard]] std::vector<Point> places_of_cells() const {
        std::vector<Point> places;
        places.reserve(lists().cells.size());
        for (const CellVertices& cell : lists().cells) {
            const auto p = corners(cell);
            places.push_back(*std::min_element(p.begin(), p.end()));
        }
        return places;
    }

    /// Returns a box around all vertices of the slice.
    [[nodiscard]] Bounds bounds() const {
        Bounds bounds;
        for (const Point& p : lists().points) bounds.take(p);
        return bounds;
    }

private:
    MeshSlice slice_;
    VertexLookup lookup_;
    IndexVector<VertexIndex, Point> points_;
};

Bounds joined(Bounds a, const Bounds& b) {
    a.take(b);
    return a;
}

/// Collective. Each process passes a box for every process; returns the joins over all processes.
std::vector<Bounds> joined_with_all(const std::vector<Bounds>& boxes, const ProcessGroup& group) {
    std::vector<Bounds> result(boxes.size());
    for (const auto& of_one : share_with_all(group, boxes)) {
        for (std::size_t r = 0; r < result.size(); ++r) result[r].take(of_one[r]);
    }
    return result;
}

template <std::size_t N>
struct Record {
    std::uint32_t number;
    Marker marker;
    std::array<VertexIndex, N> vertices;
};

/// Collective. Sends the entities of a list to the processes whose views they meet.
template <class I, std::size_t N>
std::vector<Record<N>> deliver(const IndexVector<I, std::array<VertexIndex, N>>& list,
                               const IndexVector<I, Marker>& markers, std::uint64_t count,
                               const LocatedSlice& from, const Views& views,
                               const ProcessGroup& group) {
    std::vector<std::vector<Record<N>>> to_each(static_cast<std::size_t>(group.size()));
    const std::uint64_t first = slice_begin(count, group.rank(), group.size());
    for (I i{0}; i < list.end_index(); ++i) {
        const Record<N> record{static_cast<std::uint32_t>(first + i.value()),
                               markers.empty() ? 0 : markers[i], list[i]};
        views.for_each_meeting(bounds_of(from.corners(list[i])),
                               [&](std::size_t rank) { to_each[rank].push_back(record); });
    }
    std::vector<Record<N>> all;
    for (const auto& of_one : exchange(group, std::move(to_each))) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
}

/// Collective. Returns the numbers of the vertices in this process's view.
std::vector<std::uint32_t> vertices_in_view(const MeshSlice& slice, const Views& views,
                                            const ProcessGroup& group) {
    std::vector<std::vector<std::uint32_t>> to_each(static_cast<std::size_t>(group.size()));
    const std::uint64_t first = slice_begin(slice.totals.vertices, group.rank(), group.size());
    for (VertexIndex v{0}; v < slice.lists.points.end_index(); ++v) {
        Bounds place;
        place.take(slice.lists.points[v]);
        views.for_each_meeting(place, [&](std::size_t r) {
            to_each[r].push_back(static_cast<std::uint32_t>(first + v.value()));
        });
    }
    std::vector<std::uint32_t> all;
    for (const auto& of_one : exchange(group, std::move(to_each))) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
}

template <class I, std::size_t N>
void unpack(const std::vector<Record<N>>& records, bool has_markers, const VertexLookup& vertices,
            IndexVector<I, std::array<VertexIndex, N>>& list, IndexVector<I, Marker>& markers,
            NumberList& numbers) {
    list.reserve(records.size());
    numbers.numbers.reserve(records.size());
    for (const Record<N>& record : records) {
        auto local = record.vertices;
        for (VertexIndex& v : local) v = vertices.find(v.value());
        list.push_back(local);
        numbers.numbers.push_back(record.number);
        if (has_markers) markers.push_back(record.marker);
    }
}

template <std::size_t N>
void append_vertices(const std::vector<Record<N>>& records, std::vector<std::uint32_t>& numbers) {
    for (const auto& record : records) {
        for (const VertexIndex v : record.vertices) numbers.push_back(v.value());
    }
}

/// Collective. Returns the part of a mesh in this process's view.
MeshPart part_in_view(const LocatedSlice& from, const Views& views, const ProcessGroup& group) {
    const Mesh& lists = from.lists();
    const Totals& totals = from.slice().totals;
    const auto cells = deliver(lists.cells, lists.regions, totals.cells, from, views, group);
    const auto facets =
        deliver(lists.facets, lists.facet_markers, totals.facets, from, views, group);
    const auto edges = deliver(lists.edges, lists.edge_markers, totals.edges, from, views, group);

    auto numbers = vertices_in_view(from.slice(), views, group);
    append_vertices(cells, numbers);
    append_vertices(facets, numbers);
    append_vertices(edges, numbers);
    const VertexLookup vertices(numbers);

    MeshPart part;
    Mesh& mesh = part.mesh;
    mesh.index_base = lists.index_base;
    fetch_vertices(vertices.numbers(), from.slice(), group, mesh);
    part.numbers.vertices.numbers = vertices.numbers();
    const bool regions = any(group, !lists.regions.empty());
    const bool facet_markers = any(group, !lists.facet_markers.empty());
    const bool edge_markers = any(group, !lists.edge_markers.empty());
    unpack(cells, regions, vertices, mesh.cells, mesh.regions, part.numbers.cells);
    unpack(facets, facet_markers, vertices, mesh.facets, mesh.facet_markers, part.numbers.facets);
    unpack(edges, edge_markers, vertices, mesh.edges, mesh.edge_markers, part.numbers.edges);
    return part;
}

std::vector<Bounds> closed_boxes(const std::vector<Domain>& domains, const Bounds& bounds) {
    std::vector<Bounds> boxes;
    for (const Domain& domain : domains) boxes.push_back(closed_box(domain, bounds));
    return boxes;
}

const Domain& own(const std::vector<Domain>& domains, const ProcessGroup& group) {
    return domains[static_cast<std::size_t>(group.rank())];
}

}  // namespace

Parts part_of(MeshSlice mesh, const ProcessGroup& group) {
    const LocatedSlice located(std::move(mesh), group);
    const Bounds bounds = reduce(group, located.bounds(), joined);
    const auto domains = cut_space(located.places_of_cells(), group);
    const auto boxes = closed_boxes(domains, bounds);
    Parts parts;
    parts.fine = part_in_view(located, Views(boxes), group);
    parts.domain = own(domains, group);
    return parts;
}

Parts parts_of(MeshSlice coarse, MeshSlice fine, const ProcessGroup& group) {
    const LocatedSlice located_coarse(std::move(coarse), group);
    const LocatedSlice located_fine(std::move(fine), group);
    const Bounds bounds =
        reduce(group, joined(located_coarse.bounds(), located_fine.bounds()), joined);
    const auto domains = cut_space(located_fine.places_of_cells(), group);
    const auto boxes = closed_boxes(domains, bounds);

    const auto for_each_coarse_cell = [&](auto&& visit) {
        for (const CellVertices& cell : located_coarse.lists().cells) {
            visit(located_coarse.corners(cell));
        }
    };
    std::vector<Bounds> coarse_views = boxes;
    const Views in_domains(boxes);
    for_each_coarse_cell([&](const std::array<Point, 4>& corners) {
        const Point place = *std::min_element(corners.begin(), corners.end());
        Bounds at;
        at.take(place);
        in_domains.for_each_meeting(at, [&](std::size_t r) {
            if (domains[r].owns(place)) coarse_views[r].take(bounds_of(corners));
        });
    });
    coarse_views = joined_with_all(coarse_views, group);

    Parts parts;
    parts.coarse_in_view.resize(domains.size());
    const Views views(coarse_views);
    for_each_coarse_cell([&](const std::array<Point, 4>& corners) {
        const Bounds box = bounds_of(corners);
        views.for_each_meeting(box, [&](std::size_t r) { parts.coarse_in_view[r].take(box); });
    });
    parts.coarse_in_view = joined_with_all(parts.coarse_in_view, group);

    std::vector<Bounds> fine_views = boxes;
    for (std::size_t r = 0; r < boxes.size(); ++r) fine_views[r].take(parts.coarse_in_view[r]);
    parts.coarse = part_in_view(located_coarse, views, group);
    parts.fine = part_in_view(located_fine, Views(fine_views), group);
    parts.domain = own(domains, group);
    return parts;
}

}  // namespace octetra::verify
