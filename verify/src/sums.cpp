#include "sums.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "exact/measures.hpp"
#include "rounding_bounds.hpp"

/// All sums are exact, so they are the same in whatever order, and those of parts of a mesh can be
/// added up.
namespace octetra::verify {
namespace {

/// Something to be summed up, for one tag.
struct Term {
    Marker tag = 0;
    Which which = Which::fine;
    std::uint64_t number = 0;  ///< of a facet, or a CellFace

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

/// Six times the volume of a cell is the sum of det(a, b, c) over its outward faces abc. That of a
/// face between two cells of one region comes twice, with both signs, and is left out.
void append_borders_of_regions(const Subject& subject, bool by_tag, std::vector<Term>& terms) {
    const auto tag_of_cell = [&](CellIndex c) {
        return by_tag ? tag_at(subject.mesh.regions, c) : 0;
    };
    const auto turns_evenly = [&](CellFace f) {
        return is_even(outward_face(subject.mesh.cells[f.cell], f.face));
    };
    subject.faces.for_each_group([&](const FacetVertices&, auto entries) {
        if (entries.size() == 2) {
            const CellFace f = cell_face(entries[0].tag);
            const CellFace g = cell_face(entries[1].tag);
            const bool cancel = turns_evenly(f) != turns_evenly(g);
            if (cancel && tag_of_cell(f.cell) == tag_of_cell(g.cell)) return;
        }
        for (const auto& entry : entries) {
            terms.push_back({tag_of_cell(cell_face(entry.tag).cell), subject.which, entry.tag});
        }
    });
}

void append_facets(const Subject& subject, std::vector<Term>& terms) {
    for (FacetIndex f{0}; f < subject.mesh.facets.end_index(); ++f) {
        terms.push_back({tag_at(subject.mesh.facet_markers, f), subject.which, f.value()});
    }
}

struct Volume {
    exact::VolumeSum sum;
    void clear() { sum.clear(); }
    void add(const Term& term, const Subject& subject, bool negative) {
        const CellFace f = cell_face(term.number);
        const auto [a, b, c] =
            corners_of(outward_face(subject.mesh.cells[f.cell], f.face), subject.mesh);
        const std::array<Point, 4> from_the_origin{Point{}, a, b, c};
        negative ? sum.subtract(from_the_origin) : sum.add(from_the_origin);
    }
    static constexpr double multiple = 6;  ///< how many times the volume is what is summed up
};

struct Area {
    exact::AreaSum facet;
    exact::NumberSum sum;
    void clear() { sum.clear(); }
    void add(const Term& term, const Subject& subject, bool negative) {
        facet.clear();
        facet.add(corners_of(subject.mesh.facets[FacetIndex{term.number}], subject.mesh));
        sum.add(negative ? -facet.magnitude() : facet.magnitude());
    }
    static constexpr double multiple = 2;
};

/// Sums up for each tag, and calls judge(figures, difference) with the exact difference.
template <class Measure>
std::vector<TagSum> sum_up(std::vector<Term> terms, const Subject& fine, const Subject* coarse,
                           auto&& judge) {
    std::sort(terms.begin(), terms.end());
    std::vector<TagSum> sums;
    Measure of_fine;
    Measure of_coarse;
    Measure difference;
    for (std::size_t i = 0; i < terms.size();) {
        const Marker tag = terms[i].tag;
        of_fine.clear();
        of_coarse.clear();
        difference.clear();
        for (; i < terms.size() && terms[i].tag == tag; ++i) {
            const bool is_fine = terms[i].which == Which::fine;
            const Subject& subject = is_fine ? fine : *coarse;
            (is_fine ? of_fine : of_coarse).add(terms[i], subject, false);
            if (coarse != nullptr) difference.add(terms[i], subject, !is_fine);
        }
        constexpr double multiple = Measure::multiple;
        sums.push_back({tag, of_fine.sum.rounded() / multiple, of_coarse.sum.rounded() / multiple,
                        difference.sum.rounded() / multiple});
        judge(sums.back(), difference.sum);
    }
    return sums;
}

class SumCheck {
public:
    SumCheck(const Subject& coarse, const Subject& fine, const Descent& descent, Findings& findings)
        : coarse_(coarse), fine_(fine), descent_(descent), findings_(findings) {}

    std::string run() {
        check_volumes_of_regions();
        if (!coarse_.mesh.facets.empty()) check_areas_of_markers();
        if (volume_bound_ == 0) {
            return fmt::format("of every region exactly, of every marker to within {:.3g}",
                               area_bound_);
        }
        return fmt::format("of every region to within {:.3g}, of every marker to within {:.3g}",
                           volume_bound_, area_bound_);
    }

private:
    void check_volumes_of_regions() {
        const bool by_tag = !coarse_.mesh.regions.empty();
        std::map<Marker, Bound> bounds;
        for (CellIndex c{0}; c < fine_.mesh.cells.end_index(); ++c) {
            Bound& bound = bounds[by_tag ? tag_at(fine_.mesh.regions, c) : 0];
            bound =
                (bound + volume_bound(shape_of(fine_.mesh.cells[c], fine_.mesh, descent_))) * up;
        }
        std::vector<Term> terms;
        append_borders_of_regions(fine_, by_tag, terms);
        append_borders_of_regions(coarse_, by_tag, terms);
        findings_.verdict().volumes = sum_up<Volume>(
            std::move(terms), fine_, &coarse_,
            [&](const TagSum& sum, const exact::VolumeSum& difference) {
                const Bound bound = bounds[sum.tag];
                volume_bound_ = std::max(volume_bound_, bound / Volume::multiple);
                if (difference.is_within(bound)) return;
                report(fmt::format("region {} has {:.17g} more volume", sum.tag, sum.difference),
                       bound / Volume::multiple);
            });
    }

    void check_areas_of_markers() {
        // What roots lose: less than 2^-50 of each facet's area, in either mesh.
        constexpr Bound of_roots = 0x1p-50L;
        std::map<Marker, Bound> bounds;
        exact::AreaSum facet;
        const auto add_roots = [&](const Mesh& mesh) {
            for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
                facet.clear();
                facet.add(corners_of(mesh.facets[f], mesh));
                bounds[tag_at(mesh.facet_markers, f)] += of_roots * facet.magnitude() * up;
            }
        };
        add_roots(coarse_.mesh);
        add_roots(fine_.mesh);
        for (FacetIndex f{0}; f < fine_.mesh.facets.end_index(); ++f) {
            Bound& bound = bounds[tag_at(fine_.mesh.facet_markers, f)];
            bound = (bound + area_bound(shape_of(fine_.mesh.facets[f], fine_.mesh, descent_))) * up;
        }
        std::vector<Term> terms;
        append_facets(fine_, terms);
        append_facets(coarse_, terms);
        findings_.verdict().areas =
            sum_up<Area>(std::move(terms), fine_, &coarse_,
                         [&](const TagSum& sum, const exact::NumberSum& difference) {
                             const Bound bound = bounds[sum.tag];
                             area_bound_ = std::max(area_bound_, bound / Area::multiple);
                             if (difference.is_within(bound)) return;
                             report(fmt::format("facets of marker {} have {:.17g} more area",
                                                sum.tag, sum.difference),
                                    bound / Area::multiple);
                         });
    }

    void report(std::string found, Bound bound) {
        findings_.add(Code::wrong_sum, [&]() -> Findings::Description {
            return {{}, std::move(found), fmt::format("at most {:.3g}", bound)};
        });
    }

    const Subject& coarse_;
    const Subject& fine_;
    const Descent& descent_;
    Findings& findings_;
    Bound volume_bound_ = 0;
    Bound area_bound_ = 0;
};

}  // namespace

void measure_sums(const Subject& subject, Verdict& verdict) {
    const auto nothing_to_judge = [](const TagSum&, const auto&) {};
    std::vector<Term> terms;
    append_borders_of_regions(subject, true, terms);
    verdict.volumes = sum_up<Volume>(std::move(terms), subject, nullptr, nothing_to_judge);
    terms.clear();
    append_facets(subject, terms);
    verdict.areas = sum_up<Area>(std::move(terms), subject, nullptr, nothing_to_judge);
}

std::string check_sums(const Subject& coarse, const Subject& fine, const Descent& descent,
                       Findings& findings) {
    return SumCheck(coarse, fine, descent, findings).run();
}

}  // namespace octetra::verify
