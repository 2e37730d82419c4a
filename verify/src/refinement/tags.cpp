#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

class TagCheck {
public:
    TagCheck(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines, const Descent& descent,
             const VerifyOptions& options, Findings& findings)
        : coarse_(coarse.mesh),
          fine_(fine.mesh),
          judged_fine_(fine),
          lines_(lines),
          descent_(descent),
          options_(options),
          findings_(findings) {}

    void run() {
        check("region tags", coarse_.regions.empty(), fine_.regions.empty(), [&] { regions(); });
        check("facets", coarse_.facets.empty(), fine_.facets.empty(), [&] { facets(); });
        check("edges", coarse_.edges.empty(), fine_.edges.empty(), [&] { edges(); });
        check(
            "vertex markers", coarse_.point_markers.empty(), fine_.point_markers.empty(),
            [&] { vertex_markers(); }, options_.vertex_markers_lost);
        check(
            "attributes", coarse_.attributes_per_point == 0, fine_.attributes_per_point == 0,
            [&] { attributes(); }, options_.attributes_lost);
    }

private:
    /// Runs a check unless the coarse mesh has no such data, which then cannot be inherited. If the
    /// fine mesh has none, it counts as 0, or as an empty list, unless `lost` gives a reason why it
    /// cannot have any.
    void check(std::string_view name, bool coarse_has_none, bool fine_has_none, auto&& judge,
               std::string_view lost = {}) {
        coarse_has_none = !any(findings_.group(), !coarse_has_none);
        fine_has_none = !any(findings_.group(), !fine_has_none);
        if (coarse_has_none && fine_has_none) return;
        if (coarse_has_none) {
            findings_.skip(name, "the coarse mesh has none");
            return;
        }
        if (fine_has_none && !lost.empty()) {
            findings_.skip(name, lost);
            return;
        }
        findings_.run(name, [&] {
            judge();
            return std::string();
        });
    }

    /// Returns the tag of an entity, or 0 if the mesh has no such tags.
    template <class I>
    static Marker tag_at(const IndexVector<I, Marker>& tags, I i) {
        return tags.empty() ? 0 : tags[i];
    }

    void regions() {
        for (CellIndex c{0}; c < fine_.cells.end_index(); ++c) {
            if (!judged_fine_.owns(fine_.cells[c])) continue;
            const Marker found = tag_at(fine_.regions, c);
            const Marker expected = coarse_.regions[descent_.parent[c]];
            if (found == expected) continue;
            findings_.add(Code::wrong_region, [&]() -> Findings::Description {
                return {{entity(c), entity(descent_.parent[c], Which::coarse)},
                        fmt::format("tag {}", found),
                        fmt::format("tag {}", expected)};
            });
        }
    }

    // A facet may be listed repeatedly, with different markers. The multiset of markers with which
    // a face is listed is compared with that of the coarse face of which it is a piece.

    /// Returns the markers of the entities with these tags, ascending.
    template <class I, class Entries>
    static std::vector<Marker> markers_of(const Entries& entries,
                                          const IndexVector<I, Marker>& markers) {
        std::vector<Marker> found;
        for (const auto& entry : entries) {
            found.push_back(tag_at(markers, I{entry.tag}));
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    template <class I, std::size_t N>
    static Buckets<N> buckets_of(const IndexVector<I, std::array<VertexIndex, N>>& list,
                                 std::size_t vertex_count) {
        return Buckets<N>(vertex_count, [&](auto&& visit) {
            for (I i{0}; i < list.end_index(); ++i) visit(list[i], i.value());
        });
    }

    static std::string shown(const std::vector<Marker>& markers) {
        return markers.empty() ? "not tagged" : fmt::format("marker {}", fmt::join(markers, ", "));
    }

    template <std::size_t N>
    void compare(const std::array<VertexIndex, N>& vertices, const std::vector<Marker>& found,
                 const std::vector<Marker>& expected, Code missing, Code extra, Code wrong) {
        if (found == expected) return;
        const Code code = found.size() < expected.size()   ? missing
                          : found.size() > expected.size() ? extra
                                                           : wrong;
        findings_.add(code, [&]() -> Findings::Description {
            return {{entity(vertices)}, shown(found), shown(expected)};
        });
    }

    void facets() {
        const auto coarse = buckets_of(coarse_.facets, coarse_.points.size());
        const auto fine = buckets_of(fine_.facets, fine_.points.size());
        judged_fine_.faces.for_each_group([&](const FacetVertices& face, auto entries) {
            if (!judged_fine_.owns(face)) return;
            const CellFace f = cell_face(entries.front().tag);
            std::vector<Marker> expected;
            if (const auto on = descent_.coarse_face(f)) {
                const FacetVertices whole = outward_face(coarse_.cells[on->cell], on->face);
                expected = markers_of(coarse.find(whole), coarse_.facet_markers);
            }
            const auto found = markers_of(fine.find(face), fine_.facet_markers);
            compare(face, found, expected, Code::missing_facet, Code::extra_facet,
                    Code::wrong_facet_marker);
        });
    }

    void edges() {
        // The pieces of the coarse edges, in the order of the list.
        IndexVector<EdgeIndex, EdgeVertices> pieces;
        std::vector<Marker> markers;
        for (EdgeIndex e{0}; e < coarse_.edges.end_index(); ++e) {
            const auto& [a, b] = coarse_.edges[e];
            append_pieces(descent_.coarse_to_fine[a], descent_.coarse_to_fine[b], pieces);
            markers.resize(pieces.size(), tag_at(coarse_.edge_markers, e));
        }
        const IndexVector<EdgeIndex, Marker> piece_markers(markers.begin(), markers.end());
        const auto expected = buckets_of(pieces, fine_.points.size());
        const auto found = buckets_of(fine_.edges, fine_.points.size());
        judged_fine_.edges.for_each([&](const EdgeVertices& edge) {
            if (!judged_fine_.owns(edge)) return;
            compare(edge, markers_of(found.find(edge), fine_.edge_markers),
                    markers_of(expected.find(edge), piece_markers), Code::missing_edge,
                    Code::extra_edge, Code::wrong_edge_marker);
        });
    }

    void append_pieces(VertexIndex a, VertexIndex b, IndexVector<EdgeIndex, EdgeVertices>& pieces) {
        const VertexIndex m = lines_.is_whole(a, b) ? VertexIndex::none() : lines_.midpoint(a, b);
        if (m.is_none()) {
            pieces.push_back({a, b});
            return;
        }
        append_pieces(a, m, pieces);
        append_pieces(m, b, pieces);
    }

    /// A midpoint of a tagged edge has the marker of this edge; otherwise the smallest marker of
    /// the tagged facets that contain its edge; otherwise 0.
    void vertex_markers() {
        IndexVector<VertexIndex, Marker> expected(fine_.points.size(), 0);
        std::vector<char> known(fine_.points.size(), 0);
        const auto take = [&](VertexIndex v, Marker marker) {
            Marker& m = expected[v];
            m = known[v.value()] != 0 ? std::min(m, marker) : marker;
            known[v.value()] = 1;
        };
        take_markers_of_facets(take);
        std::fill(known.begin(), known.end(), char{0});
        take_markers_of_edges(take);
        for (VertexIndex v{0}; v < coarse_.points.end_index(); ++v) {
            const VertexIndex w = descent_.coarse_to_fine[v];
            if (!w.is_none()) expected[w] = coarse_.point_markers[v];
        }
        for (VertexIndex v{0}; v < fine_.points.end_index(); ++v) {
            const Marker found = tag_at(fine_.point_markers, v);
            if (found == expected[v] || !judged_fine_.owns(v)) continue;
            findings_.add(Code::wrong_vertex_marker, [&]() -> Findings::Description {
                return {{entity(v)},
                        fmt::format("marker {}", found),
                        fmt::format("marker {}", expected[v])};
            });
        }
    }

    /// A new vertex in the interior of a coarse face, or on its border, is the midpoint of an edge
    /// of it.
    void take_markers_of_facets(auto&& take) {
        if (coarse_.facet_markers.empty()) return;
        const auto tagged = buckets_of(coarse_.facets, coarse_.points.size());
        judged_fine_.faces.for_each_group([&](const FacetVertices& face, auto entries) {
            const CellFace f = cell_face(entries.front().tag);
            const auto on = descent_.coarse_face(f);
            if (!on) return;
            const FacetVertices whole = outward_face(coarse_.cells[on->cell], on->face);
            for (const auto& entry : tagged.find(whole)) {
                const Marker marker = coarse_.facet_markers[FacetIndex{entry.tag}];
                for (const VertexIndex v : face) take(v, marker);
            }
        });
    }

    void take_markers_of_edges(auto&& take) {
        for (EdgeIndex e{0}; e < coarse_.edge_markers.end_index(); ++e) {
            const auto& [a, b] = coarse_.edges[e];
            IndexVector<EdgeIndex, EdgeVertices> pieces;
            append_pieces(descent_.coarse_to_fine[a], descent_.coarse_to_fine[b], pieces);
            for (const EdgeVertices& piece : pieces) {
                for (const VertexIndex v : piece) take(v, coarse_.edge_markers[e]);
            }
        }
    }

    void attributes() {
        const std::size_t count = coarse_.attributes_per_point;
        if (fine_.attributes_per_point != count) {
            if (!findings_.group().is_first()) return;
            findings_.add(Code::wrong_attribute, [&]() -> Findings::Description {
                return {{},
                        fmt::format("{} attributes a vertex", fine_.attributes_per_point),
                        fmt::format("{}", count)};
            });
            return;
        }
        const auto value = [&](VertexIndex v, std::size_t k) {
            return fine_.point_attributes[v.value() * count + k];
        };
        const auto judge = [&](VertexIndex v, std::size_t k, double expected) {
            const double found = value(v, k);
            if (found == expected || (std::isnan(found) && std::isnan(expected))) return;
            findings_.add(Code::wrong_attribute, [&]() -> Findings::Description {
                return {{entity(v)}, fmt::format("{}", found), fmt::format("{}", expected)};
            });
        };
        for (VertexIndex v{0}; v < coarse_.points.end_index(); ++v) {
            const VertexIndex w = descent_.coarse_to_fine[v];
            if (w.is_none() || !judged_fine_.owns(w)) continue;
            for (std::size_t k = 0; k < count; ++k) {
                judge(w, k, coarse_.point_attributes[v.value() * count + k]);
            }
        }
        for (VertexIndex v{0}; v < fine_.points.end_index(); ++v) {
            const auto& [a, b] = descent_.halves[v];
            if (a.is_none() || !judged_fine_.owns(v)) continue;
            for (std::size_t k = 0; k < count; ++k) {
                judge(v, k, mean(value(a, k), value(b, k)));
            }
        }
    }

    const Mesh& coarse_;
    const Mesh& fine_;
    const JudgedMesh& judged_fine_;
    Lines& lines_;
    const Descent& descent_;
    const VerifyOptions& options_;
    Findings& findings_;
};

}  // namespace

void check_tags(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                const Descent& descent, const VerifyOptions& options, Findings& findings) {
    TagCheck(coarse, fine, lines, descent, options, findings).run();
}

}  // namespace octetra::verify
