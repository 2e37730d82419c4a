#include "output/canonical_slices.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "level/known_marker.hpp"
#include "output/slices.hpp"

namespace octetra::distributed {
namespace {

/// Returns the numbers of the vertices. The array is constructed as a whole: a load of the whole
/// array after element-wise stores would stall.
template <class Number, std::size_t N>
std::array<Number, N> numbered(const std::array<VertexIndex, N>& vertices, const auto& of_vertex) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        return std::array{static_cast<Number>(of_vertex[vertices[k]])...};
    }
    (std::make_index_sequence<N>());
}

/// Returns the total number of decimal digits of the vertices of these entities. Vertices from
/// first_longer[k] on have at least k + 2 digits.
template <std::size_t N>
std::uint64_t digits_of(std::span<const std::array<VertexIndex, N>> entities,
                        std::span<const std::uint32_t> first_longer) {
    constexpr std::size_t at_once = 1U << 12U;  // stays in the cache, for all thresholds
    std::uint64_t digits = N * entities.size();
    for (std::size_t begin = 0; begin < entities.size(); begin += at_once) {
        const auto some = entities.subspan(begin, std::min(at_once, entities.size() - begin));
        for (const std::uint32_t longer : first_longer) {
            std::uint32_t more = 0;
            for (const auto& vertices : some) {
                for (const VertexIndex v : vertices) more += std::uint32_t{v.value() >= longer};
            }
            digits += more;
        }
    }
    return digits;
}

}  // namespace

CanonicalSlices::CanonicalSlices(const DistributedMesh& mesh, const CanonicalNumbers* known)
    : mesh_(&mesh),
      lists_(mesh),
      known_numbers_(known),
      own_numbers_(known != nullptr ? CanonicalNumbers() : canonical_numbers(mesh)),
      cell_runs_(canonical_runs(mesh.processes, lists_.cells.ancestors())),
      facet_runs_(canonical_runs(mesh.processes, lists_.facets.ancestors())),
      edge_runs_(canonical_runs(mesh.processes, lists_.edges.ancestors())),
      features_(mesh, {{{&lists_.edges.ancestors(), &edge_runs_},
                        {&lists_.facets.ancestors(), &facet_runs_},
                        {&lists_.cells.ancestors(), &cell_runs_}}}),
      facts_(find_facts()) {
    if (!sends_short_numbers()) return;
    short_numbers_.reserve(numbers().of_vertex.size());
    for (const GlobalVertex number : numbers().of_vertex) {
        short_numbers_.push_back(static_cast<std::uint32_t>(number));
    }
}

/// Returns whether vertex numbers are sent in 32 bits; the same on all processes, even without
/// vertices.
bool CanonicalSlices::sends_short_numbers() const {
    return mesh_->processes.size() > 1 &&
           numbers().vertex_count <= std::numeric_limits<std::uint32_t>::max();
}

MeshFacts CanonicalSlices::find_facts() const {
    // A process without cells has no tags, so their presence is reduced over all.
    const auto any_has = [&](const std::vector<Marker>& markers) {
        return mesh_->processes.max(markers.empty() ? 0 : 1) == 1;
    };
    return {.vertices = numbers().vertex_count,
            .cells = cell_runs_.count,
            .facets = facet_runs_.count,
            .edges = edge_runs_.count,
            .attributes_per_point = mesh_->attributes_per_point,
            .index_base = mesh_->index_base,
            .first_midpoint = mesh_->input_vertex_count,
            .has_point_markers = any_has(mesh_->input_vertex_markers),
            .has_regions = any_has(lists_.cells.ancestors().markers),
            .has_facet_markers = any_has(lists_.facets.ancestors().markers),
            .has_edge_markers = any_has(lists_.edges.ancestors().markers),
            .has_parents = true,
            .features = features_.counts(),
            .group_names = mesh_->group_names};
}

/// Calls emit(number, local index) for this process's vertices numbered begin .. end - 1.
void CanonicalSlices::for_each_vertex(std::uint64_t begin, std::uint64_t end, auto&& emit) const {
    const auto& numbers = this->numbers().of_vertex;
    const auto from = std::ranges::lower_bound(numbers, GlobalVertex{begin});
    for (VertexIndex v{static_cast<std::size_t>(from - numbers.begin())};
         v < numbers.end_index() && numbers[v] < GlobalVertex{end}; ++v) {
        emit(static_cast<std::uint64_t>(numbers[v]), v);
    }
}

std::span<const Point> CanonicalSlices::points(const Window& window) {
    send_to_slices<Point>(
        mesh_->processes, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            for_each_vertex(begin, end, [&](std::uint64_t number, VertexIndex v) {
                emit(number, mesh_->points[v]);
            });
        },
        points_);
    return points_;
}

std::span<const Marker> CanonicalSlices::point_markers(const Window& window) {
    const int rank = mesh_->processes.rank();
    std::vector<MidpointMarker> merged(window.end_of(rank) - window.begin_of(rank));
    std::vector<bool> met(merged.size(), false);
    send_to_slices<MidpointMarker>(
        mesh_->processes, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            for_each_vertex(begin, end, [&](std::uint64_t number, VertexIndex v) {
                emit(number, known_marker(*mesh_, v));
            });
        },
        [&](std::uint32_t position, const MidpointMarker& marker) {
            if (!met[position] || has_priority_over(marker, merged[position]))
                merged[position] = marker;
            met[position] = true;
        });
    point_markers_.clear();
    for (const MidpointMarker& marker : merged) point_markers_.push_back(marker.marker);
    return point_markers_;
}

std::span<const double> CanonicalSlices::point_attributes(const Window& window) {
    const std::size_t count = mesh_->attributes_per_point;
    const int rank = mesh_->processes.rank();
    point_attributes_.resize((window.end_of(rank) - window.begin_of(rank)) * count);
    for (std::size_t k = 0; k < count; ++k) {
        send_to_slices<double>(
            mesh_->processes, window,
            [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
                for_each_vertex(begin, end, [&](std::uint64_t number, VertexIndex v) {
                    emit(number, mesh_->point_attributes[v.value() * count + k]);
                });
            },
            [&](std::uint32_t position, double value) {
                point_attributes_[position * count + k] = value;
            });
    }
    return point_attributes_;
}

std::span<const VertexNumbers<2>> CanonicalSlices::midpoint_ends(const Window& window) {
    const std::uint64_t first = mesh_->input_vertex_count;
    const auto& of_vertex = numbers().of_vertex;
    send_to_slices<VertexNumbers<2>>(
        mesh_->processes, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            for_each_vertex(first + begin, first + end, [&](std::uint64_t number, VertexIndex v) {
                const std::size_t m = v.value() - mesh_->input_vertices.size();
                emit(number - first,
                     numbered<std::uint64_t>(mesh_->midpoint_to_edge[m], of_vertex));
            });
        },
        midpoint_ends_);
    return midpoint_ends_;
}

template <class Number, class I, std::size_t N>
void CanonicalSlices::entity_slice_as(
    const Window& window, const OrderedList<IndexVector<I, std::array<VertexIndex, N>>>& list,
    const CanonicalRuns& runs, const auto& of_vertex, std::vector<VertexNumbers<N>>& slice) const {
    using Row = std::array<Number, N>;
    slice.resize(window.end_of(mesh_->processes.rank()) - window.begin_of(mesh_->processes.rank()));
    const auto& entities = list.list();
    send_to_slices<Row>(
        mesh_->processes, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            for_each_between(runs, list.ancestors(), begin, end,
                             [&](std::uint64_t number, std::size_t local, std::size_t) {
                                 // In an unordered mesh the numbers are scattered, so they are
                                 // prefetched.
                                 if (const std::size_t next = local + 16; next < entities.size()) {
                                     for (const VertexIndex v : entities[I{next}]) {
                                         __builtin_prefetch(&of_vertex[v]);
                                     }
                                 }
                                 emit(number, numbered<Number>(entities[I{local}], of_vertex));
                             });
        },
        [&](std::uint32_t position, const Row& row) {
            std::ranges::copy(row, slice[position].begin());
        });
}

template <class I, std::size_t N>
std::span<const VertexNumbers<N>> CanonicalSlices::entity_slice(
    const Window& window, const OrderedList<IndexVector<I, std::array<VertexIndex, N>>>& list,
    const CanonicalRuns& runs, std::vector<VertexNumbers<N>>& slice) const {
    if (sends_short_numbers()) {
        entity_slice_as<std::uint32_t>(window, list, runs, short_numbers_, slice);
    } else {
        entity_slice_as<std::uint64_t>(window, list, runs, numbers().of_vertex, slice);
    }
    return slice;
}

std::span<const Marker> CanonicalSlices::marker_slice(const Window& window,
                                                      const AncestorMap& ancestors,
                                                      const CanonicalRuns& runs,
                                                      std::vector<Marker>& slice) const {
    send_to_slices<Marker>(
        mesh_->processes, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            for_each_between(runs, ancestors, begin, end,
                             [&](std::uint64_t number, std::size_t, std::size_t root) {
                                 emit(number, ancestors.markers[root]);
                             });
        },
        slice);
    return slice;
}

std::span<const VertexNumbers<4>> CanonicalSlices::cells(const Window& window) {
    return entity_slice(window, lists_.cells, cell_runs_, cells_);
}

/// A process's vertices ascend by number, so the local index determines the number of digits.
template <class I, std::size_t N>
std::uint64_t CanonicalSlices::digits_in(
    const Window& window, std::uint64_t index_base,
    const OrderedList<IndexVector<I, std::array<VertexIndex, N>>>& list,
    const CanonicalRuns& runs) const {
    const auto& of_vertex = numbers().of_vertex;
    std::vector<std::uint32_t> first_longer;  // the first vertex of two digits, of three, ...
    for (std::uint64_t least = 10; least < index_base + numbers().vertex_count; least *= 10) {
        const auto found = std::ranges::lower_bound(of_vertex, GlobalVertex{least - index_base});
        first_longer.push_back(static_cast<std::uint32_t>(found - of_vertex.begin()));
    }
    const Communicator& processes = mesh_->processes;
    std::vector<std::vector<std::uint64_t>> digits_to(static_cast<std::size_t>(processes.size()));
    for (int rank = 0; rank < processes.size(); ++rank) {
        const auto [begin, end] =
            local_range(runs, list.ancestors(), window.begin_of(rank), window.end_of(rank));
        if (begin == end) continue;
        const std::span<const std::array<VertexIndex, N>> all(list.list());
        const auto entities = all.subspan(begin, end - begin);
        digits_to[static_cast<std::size_t>(rank)] = {digits_of(entities, first_longer)};
    }
    std::uint64_t digits = 0;
    for (const auto& from_one : processes.all_to_all(digits_to)) {
        for (const std::uint64_t some : from_one) digits += some;
    }
    return digits;
}

std::uint64_t CanonicalSlices::cell_digits(const Window& window, std::uint64_t index_base) {
    return digits_in(window, index_base, lists_.cells, cell_runs_);
}

std::uint64_t CanonicalSlices::facet_digits(const Window& window, std::uint64_t index_base) {
    return digits_in(window, index_base, lists_.facets, facet_runs_);
}

std::uint64_t CanonicalSlices::edge_digits(const Window& window, std::uint64_t index_base) {
    return digits_in(window, index_base, lists_.edges, edge_runs_);
}

std::span<const Marker> CanonicalSlices::regions(const Window& window) {
    return marker_slice(window, lists_.cells.ancestors(), cell_runs_, regions_);
}

std::span<const std::uint64_t> CanonicalSlices::parents(const Window& window) {
    send_to_slices<std::uint64_t>(
        mesh_->processes, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            const AncestorMap& ancestors = lists_.cells.ancestors();
            for_each_between(cell_runs_, ancestors, begin, end,
                             [&](std::uint64_t number, std::size_t, std::size_t root) {
                                 emit(number, ancestors.roots[root]);
                             });
        },
        parents_);
    return parents_;
}

std::span<const VertexNumbers<3>> CanonicalSlices::facets(const Window& window) {
    return entity_slice(window, lists_.facets, facet_runs_, facets_);
}

std::span<const Marker> CanonicalSlices::facet_markers(const Window& window) {
    return marker_slice(window, lists_.facets.ancestors(), facet_runs_, facet_markers_);
}

std::span<const VertexNumbers<2>> CanonicalSlices::edges(const Window& window) {
    return entity_slice(window, lists_.edges, edge_runs_, edges_);
}

std::span<const Marker> CanonicalSlices::edge_markers(const Window& window) {
    return marker_slice(window, lists_.edges.ancestors(), edge_runs_, edge_markers_);
}

std::span<const std::uint64_t> CanonicalSlices::features(Feature feature, const Window& window) {
    return features_.slice(feature, window);
}

void CanonicalSlices::add(std::span<const Field> fields, const Sharing<VertexIndex>& sharing) {
    fields_.emplace(FieldsOfPart{.fields = fields,
                                 .processes = &mesh_->processes,
                                 .numbers = &numbers(),
                                 .sharing = &sharing,
                                 .cell_ancestors = &lists_.cells.ancestors(),
                                 .cells_before = lists_.cells.before(),
                                 .cell_runs = &cell_runs_});
}

std::span<const FieldFacts> CanonicalSlices::fields() const {
    return fields_ ? fields_->facts() : std::span<const FieldFacts>{};
}

std::span<const std::byte> CanonicalSlices::field_values(std::size_t field, const Window& window) {
    return fields_->values(field, window);
}

}  // namespace octetra::distributed
