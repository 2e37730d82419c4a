#include <fmt/format.h>

#include "coarsening/checks.hpp"
#include "lookup/point_lookup.hpp"

namespace octetra::verify {
namespace {

using Why = Reason::Why;

bool is_kept(const Remainder& rest, VertexIndex v) { return rest.reasons[v].why != Why::none; }

/// Returns false unless the vertices of the mesh after are exactly the kept ones, in order.
bool match_by_number(const Lineage& lineage, const Remainder& rest, const Mesh& after,
                     VertexMatch& match) {
    VertexIndex w{0};
    for (VertexIndex v{0}; v < lineage.points.end_index(); ++v) {
        if (!is_kept(rest, v)) continue;
        if (w == after.points.end_index() || after.points[w] != lineage.points[v]) return false;
        match[w] = v;
        ++w;
    }
    return w == after.points.end_index();
}

void match_by_place(const Lineage& lineage, const Remainder& rest, const Mesh& after,
                    VertexMatch& match) {
    const PointLookup places(lineage.points);
    VertexSet taken(lineage.points.size(), 0);
    for (VertexIndex w{0}; w < after.points.end_index(); ++w) {
        VertexIndex& v = match[w];
        const auto is_free = [&](VertexIndex x) { return taken[x] == 0; };
        v = places.find(after.points[w],
                        [&](VertexIndex x) { return is_free(x) && is_kept(rest, x); });
        if (v.is_none()) v = places.find(after.points[w], is_free);
        if (!v.is_none()) taken[v] = 1;
    }
}

void report_removed(VertexIndex v, const Reason& reason, Findings& findings) {
    findings.add(Code::vertex_went, [&]() -> Findings::Description {
        Findings::Description description{{entity(v, Which::before)}, "gone", {}};
        std::string& expected = description.expected;
        switch (reason.why) {
            case Why::cell:
                description.entities.push_back(entity(reason.cell, Which::before));
                expected = "kept: it belongs to this cell, which must not be coarsened";
                break;
            case Why::cut:
                description.entities.push_back(entity(reason.cell, Which::before));
                expected = "kept: this cell contains it and a vertex of a later step";
                break;
            case Why::closure:
                description.entities.push_back(entity(reason.vertex, Which::before));
                expected =
                    "kept: it bisects the longest edge of a face, and the second vertex, "
                    "which is kept, another edge";
                break;
            case Why::child:
                description.entities.push_back(entity(reason.cell, Which::before));
                expected =
                    "kept: it bisects an edge of the cell from which this cell was made, which "
                    "stays bisected (regular closure)";
                break;
            default: expected = "kept: no level could remove it"; break;
        }
        return description;
    });
}

void report_found(VertexIndex w, VertexIndex v, const Lineage& lineage, Findings& findings) {
    if (v.is_none()) {
        findings.add(Code::vertex_not_before, [&]() -> Findings::Description {
            return {{entity(w)}, "a vertex that is not in the mesh before", "one of its vertices"};
        });
        return;
    }
    findings.add(Code::vertex_stayed, [&]() -> Findings::Description {
        return {{entity(w), entity(v, Which::before)},
                fmt::format("still present, of step {}", lineage.step[v]),
                "gone: all cells at it may be coarsened, and no other rule keeps it"};
    });
}

}  // namespace

std::string check_kept_vertices(const Lineage& lineage, const Remainder& rest, const Mesh& after,
                                VertexMatch& match, Findings& findings) {
    match.assign(after.points.size(), VertexIndex::none());
    const bool by_number = match_by_number(lineage, rest, after, match);
    if (!by_number) match_by_place(lineage, rest, after, match);
    VertexSet found(lineage.points.size(), 0);
    for (VertexIndex w{0}; w < match.end_index(); ++w) {
        const VertexIndex v = match[w];
        if (v.is_none() || !is_kept(rest, v)) {
            report_found(w, v, lineage, findings);
        } else {
            found[v] = 1;
        }
    }
    std::size_t went = 0;
    for (VertexIndex v{0}; v < found.end_index(); ++v) {
        if (!is_kept(rest, v)) {
            ++went;
        } else if (found[v] == 0 && lineage.step[v] > 0) {  // for the input: lost_vertex
            report_removed(v, rest.reasons[v], findings);
        }
    }
    return fmt::format("{} of {} are gone, found by {}", went, lineage.points.size(),
                       by_number ? "number" : "place");
}

}  // namespace octetra::verify
