#include <algorithm>
#include <functional>
#include <numeric>
#include <ranges>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/check_group_names.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/core/positive_filter.hpp>
#include <octetra/core/repeated_cells.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/core/vertex_buckets.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/profile.hpp>

#include "assemble/ancestors_of_roots.hpp"
#include "setup/find_interfaces.hpp"
#include "setup/number_check.hpp"
#include "sharing/sharers.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {
namespace {

template <class... Arguments>
[[noreturn]] void refuse(const Communicator& processes, fmt::format_string<Arguments...> words,
                         Arguments&&... arguments) {
    throw InputError(fmt::format("rank {}: {}", processes.rank(),
                                 fmt::format(words, std::forward<Arguments>(arguments)...)));
}

void check_sizes(const Communicator& processes, const MeshPart& part) {
    const auto check = [&](const char* what, std::size_t values, std::size_t entities,
                           bool may_be_empty) {
        if (values == entities || (may_be_empty && values == 0)) return;
        refuse(processes, "{} {} for {} entities", values, what, entities);
    };
    const std::size_t vertices = part.vertex_numbers.size();
    check("points", part.points.size(), vertices, false);
    check("vertex markers", part.point_markers.size(), vertices, true);
    check("attributes", part.point_attributes.size(), vertices * part.attributes_per_point, false);
    check("region tags", part.regions.size(), part.cells.size(), true);
    check("cell numbers", part.cell_numbers.size(), part.cells.size(), true);
    check("facet markers", part.facet_markers.size(), part.facets.size(), true);
    check("facet numbers", part.facet_numbers.size(), part.facets.size(), true);
    check("edge markers", part.edge_markers.size(), part.edges.size(), true);
    check("edge numbers", part.edge_numbers.size(), part.edges.size(), true);
    const std::size_t most =
        std::max({vertices, part.cells.size(), part.facets.size(), part.edges.size()});
    if (most >= VertexIndex::limit) refuse(processes, "{} entities of a kind are too many", most);
    const auto check_ascent = [&](const char* what, const std::vector<std::uint64_t>& numbers) {
        if (std::ranges::is_sorted(numbers, std::ranges::less_equal())) return;
        refuse(processes, "{} numbers do not ascend", what);
    };
    check_ascent("cell", part.cell_numbers);
    check_ascent("facet", part.facet_numbers);
    check_ascent("edge", part.edge_numbers);
    const std::string wrong = wrong_in(part.group_names);
    if (!wrong.empty()) refuse(processes, "{}", wrong);
}

/// Returns a hash of the names; equal lists have equal hashes.
std::uint64_t hash_of(const std::vector<GroupName>& names) {
    std::uint64_t hash = names.size();
    for (const GroupName& group : names) {
        for (const std::uint64_t part :
             {static_cast<std::uint64_t>(group.dimension), static_cast<std::uint64_t>(group.tag),
              std::uint64_t{std::hash<std::string>{}(group.name)}}) {
            hash = (hash ^ part) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 32U;
        }
    }
    return hash;
}

/// Collective. Throws InputError if some processes have an optional list and others do not, or if a
/// property of the whole mesh differs.
void check_consistent(const Communicator& processes, const MeshPart& part) {
    const auto check = [&](const char* what, std::size_t values, std::size_t entities) {
        const bool given = processes.max(values > 0 ? 1 : 0) == 1;
        const bool missing = processes.max(values == 0 && entities > 0 ? 1 : 0) == 1;
        if (given && missing) {
            throw InputError(fmt::format("some processes have {}, and others none", what));
        }
    };
    check("vertex markers", part.point_markers.size(), part.points.size());
    check("region tags", part.regions.size(), part.cells.size());
    check("cell numbers", part.cell_numbers.size(), part.cells.size());
    check("facet markers", part.facet_markers.size(), part.facets.size());
    check("facet numbers", part.facet_numbers.size(), part.facets.size());
    check("edge markers", part.edge_markers.size(), part.edges.size());
    check("edge numbers", part.edge_numbers.size(), part.edges.size());
    const auto check_same = [&](const char* what, std::uint64_t number) {
        if (processes.max(number) != ~processes.max(~number)) {
            throw InputError(fmt::format("processes pass different {}", what));
        }
    };
    check_same("numbers of attributes", part.attributes_per_point);
    check_same("index bases", part.index_base);
    check_same("names of groups", hash_of(part.group_names));
    if (processes.max(part.index_base) > 1) throw InputError("the index base must be 0 or 1");
}

/// The vertices of a part in ascending order of their global numbers. "Position" below means the
/// index in this order. Later steps drop the vertices that only cells of other processes use.
class PartVertices {
public:
    PartVertices(const Communicator& processes, const MeshPart& part)
        : order_(part.vertex_numbers.size()), used_(part.vertex_numbers.size(), 0) {
        std::iota(order_.begin(), order_.end(), 0U);
        std::ranges::sort(order_, {}, [&](std::uint32_t v) { return part.vertex_numbers[v]; });
        for (const std::uint32_t v : order_) numbers_.push_back(part.vertex_numbers[v]);
        const auto twice = std::ranges::adjacent_find(numbers_);
        if (twice != numbers_.end()) refuse(processes, "vertex {} is listed twice", *twice);
        for (std::size_t v = 0; v < part.points.size(); ++v) {
            const Point& p = part.points[v];
            const auto fits = [](double x) { return std::abs(x) < coordinate_limit; };
            if (fits(p.x) && fits(p.y) && fits(p.z)) continue;  // false for NaN as well
            refuse(processes, "vertex {} has a coordinate that is not finite, or too large",
                   part.vertex_numbers[v]);
        }
    }

    /// Returns the positions of an entity's vertices, which are given by global numbers.
    template <std::size_t N>
    [[nodiscard]] std::array<VertexIndex, N> positions_of(
        const Communicator& processes, const std::array<std::uint64_t, N>& numbers) const {
        std::array<VertexIndex, N> positions;
        for (std::size_t k = 0; k < N; ++k) {
            const auto found = std::ranges::lower_bound(numbers_, numbers[k]);
            if (found == numbers_.end() || *found != numbers[k]) {
                refuse(processes, "vertex {} is used, and not listed", numbers[k]);
            }
            positions[k] = VertexIndex{static_cast<std::size_t>(found - numbers_.begin())};
        }
        return positions;
    }
    void use(const CellVertices& cell) {
        for (const VertexIndex v : cell) used_[v.value()] = 1;
    }

    [[nodiscard]] const std::vector<std::uint64_t>& numbers() const { return numbers_; }
    [[nodiscard]] const std::vector<std::uint8_t>& used() const { return used_; }
    /// Returns the index in MeshPart of the vertex at a position.
    [[nodiscard]] std::size_t at(std::size_t position) const { return order_[position]; }

private:
    std::vector<std::uint32_t> order_;
    std::vector<std::uint64_t> numbers_;
    std::vector<std::uint8_t> used_;  ///< by a cell of this process
};

/// Returns the cells with vertices by position.
IndexVector<CellIndex, CellVertices> cells_by_position(const Communicator& processes,
                                                       const MeshPart& part,
                                                       PartVertices& vertices) {
    IndexVector<CellIndex, CellVertices> cells;
    cells.reserve(part.cells.size());
    RepeatedCells repeated(part.cells.size());
    PositiveFilter filter;
    filter.add(part.points);
    for (std::size_t c = 0; c < part.cells.size(); ++c) {
        const CellVertices cell = vertices.positions_of(processes, part.cells[c]);
        const auto point = [&](std::size_t k) -> const Point& {
            return part.points[vertices.at(cell[k].value())];
        };
        if (!filter.is_surely_positive(point(0), point(1), point(2), point(3))) {
            const int sign = orientation(point(0), point(1), point(2), point(3));
            if (sign <= 0) refuse(processes, "cell {} is {}", c, sign < 0 ? "inverted" : "flat");
        }
        vertices.use(cell);
        cells.push_back(cell);
        repeated.add(cell);
    }
    if (const CellPair pair = repeated.find(cells, vertices.numbers().size());
        !pair.cell.is_none()) {
        refuse(processes, "cell {} has the vertices of cell {}", pair.cell.value(),
               pair.earlier.value());
    }
    return cells;
}

/// Returns facets or edges with vertices by position. Each must be one of the cells' `sides`; an
/// entity that is listed repeatedly must have the same marker each time.
template <class I, std::size_t N, std::size_t Sides>
IndexVector<I, std::array<VertexIndex, N>> tagged_by_position(
    const Communicator& processes, const PartVertices& vertices,
    const IndexVector<CellIndex, CellVertices>& cells,
    const std::vector<std::array<std::uint64_t, N>>& listed, const std::vector<Marker>& markers,
    const std::array<std::array<std::uint8_t, N>, Sides>& sides, const char* what) {
    IndexVector<I, std::array<VertexIndex, N>> list;
    for (const auto& numbers : listed) list.push_back(vertices.positions_of(processes, numbers));
    if (list.empty()) return list;
    const VertexBuckets<I, N> buckets(list, vertices.numbers().size());
    IndexVector<I, std::uint8_t> met(list.size(), 0);
    for (const CellVertices& cell : cells) {
        for (const auto& side : sides) {
            std::array<VertexIndex, N> corners;
            for (std::size_t k = 0; k < N; ++k) corners[k] = cell[side[k]];
            buckets.find(corners, [&](I i) { met[i] = 1; });
        }
    }
    const auto stray = std::ranges::find(met, std::uint8_t{0});
    if (stray != met.end()) {
        refuse(processes, "{} {} belongs to no cell of this process", what, stray - met.begin());
    }
    if (markers.empty()) return list;
    buckets.for_each_repeated([&](I first, I again) {
        if (markers[first.value()] == markers[again.value()]) return;
        refuse(processes, "{} {} is listed again as {}, with another marker", what, first.value(),
               again.value());
    });
    return list;
}

/// Collective. Returns which of this process's facets or edges it keeps: of several processes that
/// list the same entity, the lowest rank keeps it.
template <class I, std::size_t N>
std::vector<std::uint8_t> kept(const Communicator& processes, const PartVertices& vertices,
                               const IndexVector<I, std::array<VertexIndex, N>>& list,
                               const std::vector<Marker>& markers, const char* what) {
    using Key = std::array<std::uint64_t, N + 1>;  // vertices and marker
    std::vector<std::pair<Key, std::uint32_t>> entries;
    std::vector<std::array<std::uint64_t, N>> keys;
    std::vector<Key> marked_keys;
    for (I i{0}; i < list.end_index(); ++i) {
        Key key{};
        for (std::size_t k = 0; k < N; ++k) key[k] = vertices.numbers()[list[i][k].value()];
        std::sort(key.begin(), key.begin() + N);
        if (!markers.empty()) key[N] = static_cast<std::uint32_t>(markers[i.value()]);
        entries.emplace_back(key, i.value());
    }
    std::ranges::sort(entries);
    for (const auto& [key, i] : entries) {
        if (!marked_keys.empty() && marked_keys.back() == key) continue;
        marked_keys.push_back(key);
        auto& vertices_only = keys.emplace_back();
        std::copy_n(key.begin(), N, vertices_only.begin());
    }
    const auto sharers = find_sharers(processes, keys);
    const auto agreeing = find_sharers(processes, marked_keys);
    if (sharers != agreeing) {
        refuse(processes, "another process lists a {} of this process with another marker", what);
    }
    std::vector<std::uint8_t> keeps_key(keys.size(), 1);
    for (const Sharer& s : sharers) {
        if (s.rank < processes.rank()) keeps_key[s.key] = 0;
    }
    std::vector<std::uint8_t> keeps(list.size());
    std::size_t key = 0;
    for (const auto& [marked_key, i] : entries) {
        while (marked_keys[key] != marked_key) ++key;
        keeps[i] = keeps_key[key];
    }
    return keeps;
}

/// The facets or edges of a part, with vertices by position.
template <class I, std::size_t N>
struct TaggedList {
    const char* what;
    const IndexVector<I, std::array<VertexIndex, N>>& list;
    const std::vector<Marker>& markers;
    const std::vector<std::uint64_t>& numbers;
};

/// Collective. Adds the facets or edges that this process keeps to its part of the mesh.
template <class I, std::size_t N>
void take_tagged(const Communicator& processes, const PartVertices& vertices,
                 const TaggedList<I, N>& listed,
                 IndexVector<I, std::array<VertexIndex, N>>& entities, AncestorMap& ancestors) {
    const auto keeps = kept(processes, vertices, listed.list, listed.markers, listed.what);
    const auto count = static_cast<std::uint64_t>(std::ranges::count(keeps, std::uint8_t{1}));
    std::uint64_t next = processes.sum_before(count);
    const bool are_numbered = processes.max(listed.numbers.size()) > 0;
    std::vector<std::uint64_t> numbers;
    std::vector<Marker> kept_markers;
    for (I i{0}; i < listed.list.end_index(); ++i) {
        if (keeps[i.value()] == 0) continue;
        entities.push_back(listed.list[i]);
        numbers.push_back(are_numbered ? listed.numbers[i.value()] : next++);
        if (!listed.markers.empty()) kept_markers.push_back(listed.markers[i.value()]);
    }
    ancestors = ancestors_of_roots(std::move(numbers), std::move(kept_markers));
    if (!are_numbered) return;
    check_complete(processes, ancestors.roots, processes.sum(count), listed.what);
}

/// Adds the vertices that this process keeps to the mesh, and renumbers its entities from positions
/// to local indices.
void take_vertices(const MeshPart& part, const PartVertices& vertices,
                   const std::vector<std::uint8_t>& keeps, DistributedMesh& mesh) {
    std::vector<VertexIndex> local(keeps.size());
    for (std::size_t position = 0; position < keeps.size(); ++position) {
        if (keeps[position] == 0) continue;
        const std::size_t v = vertices.at(position);
        local[position] = mesh.points.append(part.points[v]);
        mesh.input_vertices.push_back(GlobalVertex{vertices.numbers()[position]});
        if (!part.point_markers.empty()) mesh.input_vertex_markers.push_back(part.point_markers[v]);
        for (std::size_t k = 0; k < part.attributes_per_point; ++k) {
            mesh.point_attributes.push_back(
                part.point_attributes[v * part.attributes_per_point + k]);
        }
    }
    const auto renumber = [&](auto& list) {
        for (auto& entity : list) {
            for (VertexIndex& v : entity) v = local[v.value()];
        }
    };
    renumber(mesh.cells);
    renumber(mesh.facets);
    renumber(mesh.edges);
}

/// Collective, within a transaction.
DistributedMesh mesh_of(const Communicator& processes, MeshPart part) {
    const Phase phase(processes, "distribute");
    check_sizes(processes, part);
    check_consistent(processes, part);

    DistributedMesh mesh;
    mesh.group_names = SharedGroupNames(std::move(part.group_names));
    mesh.processes = processes;
    mesh.attributes_per_point = part.attributes_per_point;
    mesh.index_base = part.index_base;
    PartVertices vertices(processes, part);
    mesh.cells = cells_by_position(processes, part, vertices);
    const auto facets = tagged_by_position<FacetIndex>(processes, vertices, mesh.cells, part.facets,
                                                       part.facet_markers, cell_faces, "facet");
    const auto edges = tagged_by_position<EdgeIndex>(processes, vertices, mesh.cells, part.edges,
                                                     part.edge_markers, cell_edges, "edge");
    const CheckedVertices checked = check_vertices(
        processes, vertices.numbers(), vertices.used(),
        [&](std::size_t position) { return part.points[vertices.at(position)]; },
        [&](std::size_t position) {
            return part.point_markers.empty() ? Marker{0}
                                              : part.point_markers[vertices.at(position)];
        },
        [&](std::size_t position) {
            const std::size_t count = part.attributes_per_point;
            return std::span(part.point_attributes).subspan(vertices.at(position) * count, count);
        });
    mesh.input_vertex_count = checked.count;
    mesh.input_cell_count = processes.sum(part.cells.size());
    const std::uint64_t first_cell = processes.sum_before(part.cells.size());
    if (part.cell_numbers.empty()) {
        part.cell_numbers.resize(part.cells.size());
        std::iota(part.cell_numbers.begin(), part.cell_numbers.end(), first_cell);
    }
    check_complete(processes, part.cell_numbers, mesh.input_cell_count, "cell");

    take_tagged(processes, vertices,
                TaggedList<FacetIndex, 3>{"facet", facets, part.facet_markers, part.facet_numbers},
                mesh.facets, mesh.facet_ancestors);
    take_tagged(processes, vertices,
                TaggedList<EdgeIndex, 2>{"edge", edges, part.edge_markers, part.edge_numbers},
                mesh.edges, mesh.edge_ancestors);
    mesh.cell_ancestors = ancestors_of_roots(std::move(part.cell_numbers), std::move(part.regions));
    take_vertices(part, vertices, checked.keeps, mesh);
    mesh.interfaces = find_interfaces(mesh, find_vertex_sharing(mesh));
    return mesh;
}

}  // namespace

DistributedMesh distribute_parts(const Communicator& processes, MeshPart part) {
    const StandardArithmetic standard;
    return processes.transaction([&] { return mesh_of(processes, std::move(part)); });
}

}  // namespace octetra::distributed
