#include "measures/sums.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "exact/measures.hpp"
#include "measures/rounding_bounds.hpp"
#include "parts/packing.hpp"

/// All sums, including those of bounds, are exact, so they do not depend on the order of summation,
/// and the sums of several processes can be added.
namespace octetra::verify {
namespace {

/// A term of the sum for a tag.
struct Term {
    Marker tag = 0;
    Which which = Which::fine;
    std::uint64_t number = 0;  ///< number of a facet, or tag of a CellFace

    friend bool operator<(const Term& a, const Term& b) {
        return std::tie(a.tag, a.which, a.number) < std::tie(b.tag, b.which, b.number);
    }
};

template <class I>
Marker tag_at(const IndexVector<I, Marker>& tags, I i) {
    return tags.empty() ? 0 : tags[i];
}

std::array<Point, 3> corners_of(const FacetVertices& v, const Mesh& mesh) {
    return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
}

/// Six times the volume of a cell is the sum of det(a, b, c) over its outward faces abc. A face
/// between two cells of one region would occur with both signs and is left out.
void append_borders_of_regions(const JudgedMesh& judged, bool by_tag, std::vector<Term>& terms) {
    const auto tag_of_cell = [&](CellIndex c) {
        return by_tag ? tag_at(judged.mesh.regions, c) : 0;
    };
    const auto turns_evenly = [&](CellFace f) {
        return is_even(outward_face(judged.mesh.cells[f.cell], f.face));
    };
    judged.faces.for_each_group([&](const FacetVertices& face, auto entries) {
        if (!judged.owns(face)) return;
        if (entries.size() == 2) {
            const CellFace f = cell_face(entries[0].tag);
            const CellFace g = cell_face(entries[1].tag);
            const bool cancel = turns_evenly(f) != turns_evenly(g);
            if (cancel && tag_of_cell(f.cell) == tag_of_cell(g.cell)) return;
        }
        for (const auto& entry : entries) {
            terms.push_back({tag_of_cell(cell_face(entry.tag).cell), judged.which, entry.tag});
        }
    });
}

void append_facets(const JudgedMesh& judged, std::vector<Term>& terms) {
    for (FacetIndex f{0}; f < judged.mesh.facets.end_index(); ++f) {
        if (!judged.owns(judged.mesh.facets[f])) continue;
        terms.push_back({tag_at(judged.mesh.facet_markers, f), judged.which, f.value()});
    }
}

/// The sums for one tag, as texts of exact::NumberSum.
struct TagTotal {
    Marker tag = 0;
    std::string fine, coarse, bound;
};

struct Volume {
    exact::VolumeSum sum;
    void clear(double largest) { sum.clear(largest); }
    void add(const Term& term, const JudgedMesh& judged) {
        const CellFace f = cell_face(term.number);
        const auto [a, b, c] =
            corners_of(outward_face(judged.mesh.cells[f.cell], f.face), judged.mesh);
        sum.add({Point{}, a, b, c});
    }
    static constexpr double multiple = 6;  ///< ratio of the summed quantity to the volume
};

struct Area {
    exact::AreaSum facet;
    exact::NumberSum sum;
    void clear(double) { sum.clear(); }
    void add(const Term& term, const JudgedMesh& judged) {
        facet.clear();
        facet.add(corners_of(judged.mesh.facets[FacetIndex{term.number}], judged.mesh));
        sum.add(facet.magnitude());
    }
    static constexpr double multiple = 2;
};

using TagBounds = std::map<Marker, exact::NumberSum>;

/// Returns totals by tag, ascending. `coarse` is used only for the points of coarse terms.
template <class Measure>
std::vector<TagTotal> totals_of(std::vector<Term> terms, const TagBounds& bounds,
                                const JudgedMesh& fine, const JudgedMesh& coarse) {
    std::sort(terms.begin(), terms.end());
    std::vector<TagTotal> totals;
    Measure of_fine;
    Measure of_coarse;
    const exact::NumberSum nothing;
    const double largest = std::max(exact::largest_coordinate(fine.mesh.points),
                                    exact::largest_coordinate(coarse.mesh.points));
    for (std::size_t i = 0; i < terms.size();) {
        const Marker tag = terms[i].tag;
        of_fine.clear(largest);
        of_coarse.clear(largest);
        for (; i < terms.size() && terms[i].tag == tag; ++i) {
            const bool is_fine = terms[i].which == Which::fine;
            (is_fine ? of_fine : of_coarse).add(terms[i], is_fine ? fine : coarse);
        }
        const auto bound = bounds.find(tag);
        totals.push_back({tag, of_fine.sum.exactly(), of_coarse.sum.exactly(),
                          (bound == bounds.end() ? nothing : bound->second).exactly()});
    }
    return totals;
}

ProcessGroup::Bytes packed(const std::vector<TagTotal>& totals) {
    Packer pack;
    pack(std::uint64_t{totals.size()});
    for (const TagTotal& total : totals) {
        pack(total.tag);
        pack.list(total.fine);
        pack.list(total.coarse);
        pack.list(total.bound);
    }
    return std::move(pack.bytes());
}

std::vector<TagTotal> unpacked_totals(const ProcessGroup::Bytes& bytes) {
    Unpacker unpack(bytes);
    std::uint64_t count = 0;
    unpack(count);
    std::vector<TagTotal> totals(count);
    for (TagTotal& total : totals) {
        unpack(total.tag);
        unpack.list(total.fine);
        unpack.list(total.coarse);
        unpack.list(total.bound);
    }
    return totals;
}

/// Collective. Returns the totals of all processes, sorted by tag.
std::vector<TagTotal> totals_of_all(std::vector<TagTotal> totals, const ProcessGroup& group) {
    if (group.size() == 1) return totals;
    ProcessGroup::Bytes own = packed(totals);
    totals.clear();
    for (const auto& bytes : group.of_all(std::move(own))) {
        for (TagTotal& total : unpacked_totals(bytes)) totals.push_back(std::move(total));
    }
    std::stable_sort(totals.begin(), totals.end(),
                     [](const TagTotal& a, const TagTotal& b) { return a.tag < b.tag; });
    return totals;
}

/// Collective. Returns the figures of each tag; calls judge(figures, exact difference, bound).
std::vector<TagSum> sum_up(std::vector<TagTotal> own_totals, double multiple, bool of_refinement,
                           const ProcessGroup& group, auto&& judge) {
    const std::vector<TagTotal> totals = totals_of_all(std::move(own_totals), group);
    std::vector<TagSum> sums;
    exact::NumberSum fine;
    exact::NumberSum coarse;
    exact::NumberSum difference;
    exact::NumberSum bound;
    for (std::size_t i = 0; i < totals.size();) {
        const Marker tag = totals[i].tag;
        for (exact::NumberSum* sum : {&fine, &coarse, &difference, &bound}) sum->clear();
        for (; i < totals.size() && totals[i].tag == tag; ++i) {
            fine.add_exactly(totals[i].fine);
            coarse.add_exactly(totals[i].coarse);
            difference.add_exactly(totals[i].fine);
            difference.subtract_exactly(totals[i].coarse);
            bound.add_exactly(totals[i].bound);
        }
        sums.push_back({tag, fine.rounded() / multiple, coarse.rounded() / multiple,
                        of_refinement ? difference.rounded() / multiple : 0});
        judge(sums.back(), difference, bound.magnitude() * up);
    }
    return sums;
}

/// Collective; violations are reported by the first process.
class SumCheck {
public:
    SumCheck(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
             Findings& findings)
        : coarse_(coarse), fine_(fine), descent_(descent), findings_(findings) {}

    std::string run() {
        check_volumes_of_regions();
        if (any(findings_.group(), !coarse_.mesh.facets.empty())) check_areas_of_markers();
        if (volume_bound_ == 0) {
            return fmt::format("of every region exactly, of every marker to within {:.3g}",
                               area_bound_);
        }
        return fmt::format("of every region to within {:.3g}, of every marker to within {:.3g}",
                           volume_bound_, area_bound_);
    }

private:
    void check_volumes_of_regions() {
        const bool by_tag = any(findings_.group(), !coarse_.mesh.regions.empty());
        TagBounds bounds;
        for (CellIndex c{0}; c < fine_.mesh.cells.end_index(); ++c) {
            if (!fine_.owns(fine_.mesh.cells[c])) continue;
            const Bound bound = volume_bound(shape_of(fine_.mesh.cells[c], fine_.mesh, descent_));
            if (bound > 0) bounds[by_tag ? tag_at(fine_.mesh.regions, c) : 0].add(bound);
        }
        std::vector<Term> terms;
        append_borders_of_regions(fine_, by_tag, terms);
        append_borders_of_regions(coarse_, by_tag, terms);
        findings_.verdict().volumes = sum_up(
            totals_of<Volume>(std::move(terms), bounds, fine_, coarse_), Volume::multiple, true,
            findings_.group(),
            [&](const TagSum& sum, const exact::NumberSum& difference, Bound bound) {
                volume_bound_ = std::max(volume_bound_, bound / Volume::multiple);
                if (difference.is_within(bound)) return;
                report(fmt::format("region {} has {:.17g} more volume", sum.tag, sum.difference),
                       bound / Volume::multiple);
            });
    }

    /// Adds the rounding errors of square roots: less than 2^-50 of each facet's area, in either
    /// mesh.
    static void add_roots(const JudgedMesh& judged, TagBounds& bounds) {
        constexpr Bound of_roots = 0x1p-50L;
        exact::AreaSum facet;
        const Mesh& mesh = judged.mesh;
        for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
            if (!judged.owns(mesh.facets[f])) continue;
            facet.clear();
            facet.add(corners_of(mesh.facets[f], mesh));
            bounds[tag_at(mesh.facet_markers, f)].add(of_roots * facet.magnitude() * up);
        }
    }

    void check_areas_of_markers() {
        TagBounds bounds;
        add_roots(coarse_, bounds);
        add_roots(fine_, bounds);
        for (FacetIndex f{0}; f < fine_.mesh.facets.end_index(); ++f) {
            if (!fine_.owns(fine_.mesh.facets[f])) continue;
            const Bound bound = area_bound(shape_of(fine_.mesh.facets[f], fine_.mesh, descent_));
            if (bound > 0) bounds[tag_at(fine_.mesh.facet_markers, f)].add(bound);
        }
        std::vector<Term> terms;
        append_facets(fine_, terms);
        append_facets(coarse_, terms);
        findings_.verdict().areas =
            sum_up(totals_of<Area>(std::move(terms), bounds, fine_, coarse_), Area::multiple, true,
                   findings_.group(),
                   [&](const TagSum& sum, const exact::NumberSum& difference, Bound bound) {
                       area_bound_ = std::max(area_bound_, bound / Area::multiple);
                       if (difference.is_within(bound)) return;
                       report(fmt::format("facets of marker {} have {:.17g} more area", sum.tag,
                                          sum.difference),
                              bound / Area::multiple);
                   });
    }

    void report(std::string found, Bound bound) {
        if (!findings_.group().is_first()) return;
        findings_.add(Code::wrong_sum, [&]() -> Findings::Description {
            return {{}, std::move(found), fmt::format("at most {:.3g}", bound)};
        });
    }

    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    const Descent& descent_;
    Findings& findings_;
    Bound volume_bound_ = 0;
    Bound area_bound_ = 0;
};

}  // namespace

void measure_sums(const JudgedMesh& judged, Findings& findings) {
    const auto no_check = [](const TagSum&, const exact::NumberSum&, Bound) {};
    Verdict& verdict = findings.verdict();
    std::vector<Term> terms;
    append_borders_of_regions(judged, true, terms);
    verdict.volumes = sum_up(totals_of<Volume>(std::move(terms), {}, judged, judged),
                             Volume::multiple, false, findings.group(), no_check);
    terms.clear();
    append_facets(judged, terms);
    verdict.areas = sum_up(totals_of<Area>(std::move(terms), {}, judged, judged), Area::multiple,
                           false, findings.group(), no_check);
}

std::string check_sums(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                       Findings& findings) {
    return SumCheck(coarse, fine, descent, findings).run();
}

}  // namespace octetra::verify
