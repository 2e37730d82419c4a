#include "migrate/merge_parts.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "level/known_marker.hpp"

namespace octetra::distributed {
namespace {

using NumbersAfter = IndexVector<VertexIndex, VertexIndex>;

/// Returns the vertices of staying cells, and those that no cell has. Other vertices may stay as
/// vertices of received cells.
IndexVector<VertexIndex, std::uint8_t> staying_vertices(const DistributedMesh& before,
                                                        const Departures& departures) {
    IndexVector<VertexIndex, std::uint8_t> stays;
    stays.assign(before.points.size(), 0);
    std::vector<bool> is_used(before.input_vertices.size(), false);
    const std::vector<std::uint32_t>& first = before.cell_ancestors.first;
    for (std::size_t r = 0; r < departures.rank_of_root.size(); ++r) {
        for (const VertexIndex v : departures.input.cells[CellIndex{r}]) is_used[v.value()] = true;
        if (departures.rank_of_root[r] != before.processes.rank()) continue;
        for (CellIndex c{first[r]}; c < CellIndex{first[r + 1]}; ++c) {
            for (const VertexIndex v : before.cells[c]) stays[v] = 1;
        }
    }
    for (std::size_t v = 0; v < is_used.size(); ++v) {
        if (!is_used[v]) stays[VertexIndex{v}] = 1;
    }
    return stays;
}

/// One of two parts whose vertices are merged, with the progress of the merge.
struct Source {
    const DistributedMesh* mesh;
    const IndexVector<VertexIndex, std::uint8_t>* stays;  ///< null: all stay
    NumbersAfter numbers;                                 ///< none() if it does not stay
    VertexIndex next{0};

    Source(const DistributedMesh& of, const IndexVector<VertexIndex, std::uint8_t>* of_these)
        : mesh(&of), stays(of_these) {
        numbers.assign(of.points.size(), VertexIndex::none());
    }

    [[nodiscard]] bool next_stays() const { return stays == nullptr || (*stays)[next] != 0; }
    /// Skips midpoints that the merged part cannot have, because it lacks one of their ends.
    void skip_impossible(VertexIndex end) {
        if (stays == nullptr || next < VertexIndex{mesh->input_vertices.size()}) return;
        const auto is_impossible = [&] {
            const auto [a, b] = ends();
            return a.is_none() || b.is_none();
        };
        while (next < end && is_impossible()) ++next;
    }
    void take_as(VertexIndex number) {
        numbers[next] = number;
        ++next;
    }
    [[nodiscard]] VertexIndex level_end(std::size_t level) const {
        if (level == 0) return VertexIndex{mesh->input_vertices.size()};
        return level < mesh->level_begin.size() ? mesh->level_begin[level]
                                                : mesh->points.end_index();
    }
    /// Returns the ends of the edge that the next vertex halves, by new index.
    [[nodiscard]] EdgeVertices ends() const {
        const auto& [a, b] = mesh->midpoint_to_edge[next.value() - mesh->input_vertices.size()];
        return {numbers[a], numbers[b]};
    }
};

/// Merges the vertices of two parts, level by level.
class VertexMerge {
public:
    VertexMerge(DistributedMesh& result, Source& a, Source& b) : result_(&result), a_(&a), b_(&b) {
        const std::size_t attributes = a.mesh->attributes_per_point;
        result.attributes_per_point = attributes;
        result.points.reserve(a.mesh->points.size() + b.mesh->points.size());
        has_markers_ =
            !a.mesh->input_vertex_markers.empty() || !b.mesh->input_vertex_markers.empty();
        merge_level(0, [](const Source& source) {
            return source.mesh->input_vertices[source.next.value()];
        });
        for (std::size_t level = 1; level <= a.mesh->level_begin.size(); ++level) {
            result.level_begin.push_back(result.points.end_index());
            merge_level(level, [](const Source& source) { return source.ends(); });
        }
    }

private:
    /// `key_of` orders the vertices of a level and is equal for equal vertices.
    void merge_level(std::size_t level, auto&& key_of) {
        const VertexIndex end_a = a_->level_end(level);
        const VertexIndex end_b = b_->level_end(level);
        while (true) {
            a_->skip_impossible(end_a);
            if (a_->next == end_a && b_->next == end_b) break;
            const bool has_a = a_->next < end_a;
            const bool has_b = b_->next < end_b;
            const bool takes_a = has_a && (!has_b || key_of(*a_) <= key_of(*b_));
            const bool takes_b = has_b && (!has_a || key_of(*b_) <= key_of(*a_));
            if (takes_a && !takes_b && !a_->next_stays()) {
                ++a_->next;
                continue;
            }
            if (level == 0) {
                take_input(takes_a ? *a_ : *b_);
            } else {
                take_midpoint(takes_a, takes_b);
            }
            const VertexIndex taken{result_->points.size() - 1};
            if (takes_a) a_->take_as(taken);
            if (takes_b) b_->take_as(taken);
        }
    }
    void take_point(const Source& source) {
        result_->points.push_back(source.mesh->points[source.next]);
        const std::size_t count = result_->attributes_per_point;
        const double* const from =
            source.mesh->point_attributes.data() + source.next.value() * count;
        result_->point_attributes.insert(result_->point_attributes.end(), from, from + count);
    }
    void take_input(const Source& source) {
        take_point(source);
        result_->input_vertices.push_back(source.mesh->input_vertices[source.next.value()]);
        if (!has_markers_) return;
        result_->input_vertex_markers.push_back(
            source.mesh->input_vertex_markers[source.next.value()]);
    }
    /// Adds a midpoint. If both parts have it, the marker with priority is adopted.
    void take_midpoint(bool takes_a, bool takes_b) {
        const Source& source = takes_a ? *a_ : *b_;
        result_->midpoint_to_edge.push_back(source.ends());
        if (has_markers_) {
            MidpointMarker known = known_marker(*source.mesh, source.next);
            if (takes_a && takes_b) {
                const MidpointMarker other = known_marker(*b_->mesh, b_->next);
                if (has_priority_over(other, known)) known = other;
            }
            result_->midpoint_markers.push_back(known);
        }
        take_point(source);
    }

    DistributedMesh* result_;
    Source* a_;
    Source* b_;
    bool has_markers_ = false;
};

/// A list of one of the parts, from which single roots are copied.
template <class I, std::size_t N>
struct ListSource {
    const IndexVector<I, std::array<VertexIndex, N>>* list;
    const AncestorMap* ancestors;
    const NumbersAfter* numbers;

    void append_to(IndexVector<I, std::array<VertexIndex, N>>& result, AncestorMap& merged,
                   std::size_t root, bool has_markers) const {
        for (I i{ancestors->first[root]}; i < I{ancestors->first[root + 1]}; ++i) {
            std::array<VertexIndex, N> vertices = (*list)[i];
            for (VertexIndex& v : vertices) v = (*numbers)[v];
            result.push_back(vertices);
        }
        merged.first.push_back(result.end_index().value());
        merged.roots.push_back(ancestors->roots[root]);
        if (has_markers) merged.markers.push_back(ancestors->markers[root]);
    }
};
template <class I, std::size_t N>
ListSource(const IndexVector<I, std::array<VertexIndex, N>>*, const AncestorMap*,
           const NumbersAfter*) -> ListSource<I, N>;

/// Merges the staying roots of one list with another list. Calls taken(root of b) for each root of
/// b, and taken(number of roots of b) for each of a.
template <class I, std::size_t N>
void merge_lists(const ListSource<I, N>& a, const std::vector<int>& rank_of_a, int rank,
                 const ListSource<I, N>& b, bool has_markers,
                 IndexVector<I, std::array<VertexIndex, N>>& result, AncestorMap& merged,
                 auto&& taken) {
    const std::size_t end_a = a.ancestors->roots.size();
    const std::size_t end_b = b.ancestors->roots.size();
    std::size_t next_b = 0;
    const auto take_b_before = [&](std::uint64_t number) {
        for (; next_b < end_b && b.ancestors->roots[next_b] < number; ++next_b) {
            b.append_to(result, merged, next_b, has_markers);
            taken(next_b);
        }
    };
    for (std::size_t r = 0; r < end_a; ++r) {
        if (rank_of_a[r] != rank) continue;
        take_b_before(a.ancestors->roots[r]);
        a.append_to(result, merged, r, has_markers);
        taken(end_b);
    }
    take_b_before(~std::uint64_t{0});
}

/// Throws InputError if the number of entities may exceed the range of 32-bit indices; departing
/// entities are counted, too.
void check_countable(const DistributedMesh& before, const DistributedMesh& received) {
    const std::size_t most = std::max({before.points.size() + received.points.size(),
                                       before.cells.size() + received.cells.size(),
                                       before.facets.size() + received.facets.size(),
                                       before.edges.size() + received.edges.size()});
    if (most < VertexIndex::limit) return;
    throw InputError(
        fmt::format("rank {}: the migration could result in {} entities of one kind, which are too "
                    "many",
                    before.processes.rank(), most));
}

Migration::Message kept_vertices(const NumbersAfter& numbers) {
    Migration::Message kept;
    for (VertexIndex v{0}; v < numbers.end_index(); ++v) {
        if (numbers[v].is_none()) continue;
        kept.sent.push_back(v.value());
        kept.received.push_back(numbers[v].value());
    }
    return kept;
}

}  // namespace

MergedPart merge_parts(const DistributedMesh& before, const Departures& departures,
                       const Arrivals& arrivals, const HasLists& has) {
    check_countable(before, arrivals.part);
    MergedPart merged;
    DistributedMesh& mesh = merged.mesh;
    mesh.processes = before.processes;
    mesh.input_vertex_count = before.input_vertex_count;
    mesh.input_cell_count = before.input_cell_count;
    mesh.index_base = before.index_base;
    mesh.group_names = before.group_names;
    mesh.closure = before.closure;
    mesh.features = before.features;
    const DistributedMesh& received = arrivals.part;
    const auto stays = staying_vertices(before, departures);
    Source a(before, &stays);
    Source b(received, nullptr);
    (void)VertexMerge(mesh, a, b);

    const int rank = before.processes.rank();
    const auto merge = [&](auto list, auto ancestors, const std::vector<int>& ranks,
                           bool has_markers, auto&& taken) {
        merge_lists(ListSource{&(before.*list), &(before.*ancestors), &a.numbers}, ranks, rank,
                    ListSource{&(received.*list), &(received.*ancestors), &b.numbers}, has_markers,
                    mesh.*list, mesh.*ancestors, taken);
    };
    using M = DistributedMesh;
    mesh.cells.reserve(before.cells.size() + received.cells.size());
    merge(&M::cells, &M::cell_ancestors, departures.rank_of_root, has.regions,
          [&](std::size_t arrival) {
              const bool is_received = arrival < arrivals.rank_of_root.size();
              merged.rank_of_root.push_back(is_received ? arrivals.rank_of_root[arrival] : rank);
          });
    merge(&M::facets, &M::facet_ancestors, departures.rank_of_facet, has.facet_markers,
          [](std::size_t) {});
    merge(&M::edges, &M::edge_ancestors, departures.rank_of_edge, has.edge_markers,
          [](std::size_t) {});
    merged.kept_vertices = kept_vertices(a.numbers);
    return merged;
}

}  // namespace octetra::distributed
