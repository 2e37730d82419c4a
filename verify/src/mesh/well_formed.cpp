#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "mesh/checks.hpp"

namespace octetra::verify {
namespace {

template <std::size_t N>
bool has_repetition(const std::array<VertexIndex, N>& v) {
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (v[i] == v[k]) return true;
        }
    }
    return false;
}

template <class I, std::size_t N>
void check_range(const IndexVector<I, std::array<VertexIndex, N>>& list, std::uint64_t vertex_count,
                 Which which, Findings& findings) {
    for (I i{0}; i < list.end_index(); ++i) {
        for (const VertexIndex v : list[i]) {
            if (v.value() < vertex_count) continue;
            findings.add(Code::vertex_out_of_range, [&]() -> Findings::Description {
                return {{entity(i, which)},
                        fmt::format("vertex {}, counted from 0", v.value()),
                        fmt::format("a number less than {}", vertex_count)};
            });
        }
    }
}

void check_length(std::string_view what, std::size_t length, std::size_t expected, bool may_miss,
                  Findings& findings) {
    if (length == expected || (may_miss && length == 0)) return;
    findings.add(Code::list_length, [&]() -> Findings::Description {
        return {{}, fmt::format("{} {}", length, what), fmt::format("{}", expected)};
    });
}

/// Checks tagged facets or edges: vertices are distinct, and some cell contains them.
template <class I, std::size_t N, class OfCells>
void check_tagged(const IndexVector<I, std::array<VertexIndex, N>>& list, const OfCells& of_cells,
                  Code stray, const JudgedMesh& judged, Findings& findings) {
    const Which which = judged.which;
    for (I i{0}; i < list.end_index(); ++i) {
        if (!judged.owns(list[i])) continue;
        if (has_repetition(list[i])) {
            findings.add(Code::repeated_vertex, [&]() -> Findings::Description {
                return {{entity(i, which)}, "a vertex twice", "different vertices"};
            });
        } else if (!of_cells.contains(list[i])) {
            findings.add(stray, [&]() -> Findings::Description {
                return {{entity(i, which)}, "belongs to no cell", "a face or edge of some cell"};
            });
        }
    }
}

/// Checks that no entity of the list occurs twice with different markers.
template <class I, std::size_t N>
void check_markers(const IndexVector<I, std::array<VertexIndex, N>>& list,
                   const IndexVector<I, Marker>& markers, const JudgedMesh& judged,
                   Findings& findings) {
    if (markers.empty()) return;
    const Buckets<N> by_vertices(judged.mesh.points.size(), [&](auto&& visit) {
        for (I i{0}; i < list.end_index(); ++i) visit(list[i], i.value());
    });
    by_vertices.for_each_group([&](const std::array<VertexIndex, N>& vertices, auto entries) {
        if (!judged.owns(vertices)) return;
        const I first{entries[0].tag};
        for (std::size_t k = 1; k < entries.size(); ++k) {
            const I again{entries[k].tag};
            if (markers[first] == markers[again]) continue;
            findings.add(Code::conflicting_markers, [&]() -> Findings::Description {
                return {{entity(first, judged.which), entity(again, judged.which)},
                        fmt::format("markers {} and {}", markers[first], markers[again]),
                        "one marker for the same vertices"};
            });
        }
    });
}

void for_each_sound_cell(const JudgedMesh& judged, auto&& visit) {
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        if (judged.is_sound(c)) visit(c, judged.mesh.cells[c]);
    }
}

Buckets<3> faces_of_sound_cells(const JudgedMesh& judged) {
    return Buckets<3>(judged.mesh.points.size(), [&](auto&& visit) {
        for_each_sound_cell(judged, [&](CellIndex c, const CellVertices& cell) {
            for (std::size_t face = 0; face < 4; ++face) {
                visit(outward_face(cell, face), tag_of({c, face}));
            }
        });
    });
}

void reject_cells_with_repetitions(JudgedMesh& judged, Findings& findings) {
    const Mesh& mesh = judged.mesh;
    judged.sound.assign(mesh.cells.size(), 1);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (!has_repetition(mesh.cells[c])) continue;
        judged.sound[c.value()] = 0;
        if (!judged.owns(mesh.cells[c])) continue;
        findings.add(Code::repeated_vertex, [&]() -> Findings::Description {
            return {{entity(c, judged.which)}, "a vertex twice", "four different vertices"};
        });
    }
}

/// Returns whether any two cells have the same vertices: a face in common, and its opposite
/// corners.
bool has_repeated_cells(const JudgedMesh& judged) {
    bool found = false;
    judged.faces.for_each_group([&](const FacetVertices&, auto entries) {
        const auto opposite = [&](std::size_t i) {
            const CellFace f = cell_face(entries[i].tag);
            return judged.mesh.cells[f.cell][f.face];
        };
        for (std::size_t i = 1; i < entries.size() && !found; ++i) {
            for (std::size_t k = 0; k < i; ++k) found = found || opposite(i) == opposite(k);
        }
    });
    return found;
}

void reject_repeated_cells(JudgedMesh& judged, Findings& findings) {
    const Mesh& mesh = judged.mesh;
    const Buckets<4> by_vertices(mesh.points.size(), [&](auto&& visit) {
        for_each_sound_cell(judged,
                            [&](CellIndex c, const CellVertices& cell) { visit(cell, c.value()); });
    });
    by_vertices.for_each_group([&](const CellVertices& vertices, auto cells) {
        for (std::size_t k = 1; k < cells.size(); ++k) {
            const CellIndex first{cells[0].tag};
            const CellIndex again{cells[k].tag};
            judged.sound[again.value()] = 0;
            if (!judged.owns(vertices)) continue;
            findings.add(Code::repeated_cell, [&]() -> Findings::Description {
                return {{entity(first, judged.which), entity(again, judged.which)},
                        "the same four vertices",
                        "each cell once"};
            });
        }
    });
}

}  // namespace

std::string check_ranges(const Mesh& mesh, std::uint64_t vertex_count, Which which,
                         Findings& findings) {
    check_range(mesh.cells, vertex_count, which, findings);
    check_range(mesh.facets, vertex_count, which, findings);
    check_range(mesh.edges, vertex_count, which, findings);
    const std::size_t points = mesh.points.size();
    check_length("vertex markers", mesh.point_markers.size(), points, true, findings);
    check_length("attributes", mesh.point_attributes.size(), points * mesh.attributes_per_point,
                 false, findings);
    check_length("region tags", mesh.regions.size(), mesh.cells.size(), true, findings);
    check_length("facet markers", mesh.facet_markers.size(), mesh.facets.size(), true, findings);
    check_length("edge markers", mesh.edge_markers.size(), mesh.edges.size(), true, findings);
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (is_finite(mesh.points[v])) continue;
        findings.add(Code::not_finite, [&]() -> Findings::Description {
            const Point& p = mesh.points[v];
            return {{entity(v, which)},
                    fmt::format("({}, {}, {})", p.x, p.y, p.z),
                    "finite coordinates"};
        });
    }
    return {};
}

std::string check_slice_ranges(const MeshSlice& slice, Which which, Findings& findings) {
    const ProcessGroup& group = findings.group();
    const auto numbered = [&](std::uint64_t count) {
        return NumberList{
            .first = static_cast<std::uint32_t>(slice_begin(count, group.rank(), group.size()))};
    };
    const Numbers numbers{numbered(slice.totals.vertices), numbered(slice.totals.cells),
                          numbered(slice.totals.facets), numbered(slice.totals.edges)};
    findings.translate(which, &numbers);
    std::string note = check_ranges(slice.lists, slice.totals.vertices, which, findings);
    findings.translate(which, nullptr);
    return note;
}

std::string check_well_formed(JudgedMesh& judged, Findings& findings) {
    const Mesh& mesh = judged.mesh;
    reject_cells_with_repetitions(judged, findings);
    judged.faces = faces_of_sound_cells(judged);
    if (has_repeated_cells(judged)) {
        reject_repeated_cells(judged, findings);
        judged.faces = faces_of_sound_cells(judged);
    }
    judged.edges = EdgeSet(mesh.points.size(), [&](auto&& visit) {
        for_each_sound_cell(judged, [&](CellIndex, const CellVertices& cell) {
            for (const auto& [i, j] : cell_edges) visit(EdgeVertices{cell[i], cell[j]});
        });
    });
    check_tagged(mesh.facets, judged.faces, Code::stray_facet, judged, findings);
    check_tagged(mesh.edges, judged.edges, Code::stray_edge, judged, findings);
    return judged.totals.cells == 0 ? "there are no cells to check" : "";
}

std::string check_tagged_markers(const JudgedMesh& judged, Findings& findings) {
    check_markers(judged.mesh.facets, judged.mesh.facet_markers, judged, findings);
    check_markers(judged.mesh.edges, judged.mesh.edge_markers, judged, findings);
    return {};
}

std::string check_vertices(const JudgedMesh& judged, const std::vector<char>& tolerated,
                           Unused unused, Findings& findings) {
    const Mesh& mesh = judged.mesh;
    const std::vector<char> used = used_vertices(mesh);
    const auto is_tolerated = [&](VertexIndex v) {
        return !tolerated.empty() && tolerated[v.value()] != 0;
    };
    Facts& facts = findings.facts();
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (used[v.value()] != 0 || !judged.owns(v)) continue;
        if (unused == Unused::noted || is_tolerated(v)) {
            ++facts.unused_vertices;
            continue;
        }
        findings.add(Code::unused_vertex, [&]() -> Findings::Description {
            return {{entity(v, judged.which)}, "belongs to no cell", "a corner of some cell"};
        });
    }

    // The position of unused vertices does not matter; only vertices of cells are compared.
    std::vector<VertexIndex> by_place;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (used[v.value()] != 0 && judged.owns(v)) by_place.push_back(v);
    }
    std::sort(by_place.begin(), by_place.end(), [&](VertexIndex v, VertexIndex w) {
        const auto order = mesh.points[v] <=> mesh.points[w];
        return order != 0 ? order < 0 : v < w;
    });
    for (std::size_t i = 1; i < by_place.size(); ++i) {
        const VertexIndex v = by_place[i - 1];
        const VertexIndex w = by_place[i];
        if (mesh.points[v] != mesh.points[w] || (is_tolerated(v) && is_tolerated(w))) continue;
        findings.add(Code::coincident_vertices, [&]() -> Findings::Description {
            const Point& p = mesh.points[v];
            return {{entity(v, judged.which), entity(w, judged.which)},
                    fmt::format("both at ({}, {}, {})", p.x, p.y, p.z),
                    "one vertex at each place"};
        });
    }
    const std::uint64_t count = sum(findings.group(), facts.unused_vertices);
    if (count == 0) return {};
    return count == 1 ? "1 vertex belongs to no cell"
                      : fmt::format("{} vertices belong to no cell", count);
}

}  // namespace octetra::verify
