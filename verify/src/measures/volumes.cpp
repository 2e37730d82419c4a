#include <algorithm>

#include <fmt/format.h>

#include "exact/measures.hpp"
#include "measures/rounding_bounds.hpp"
#include "mesh/checks.hpp"
#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

/// Fine entities grouped by the coarse entity to which each belongs.
struct Grouped {
    std::vector<std::uint32_t> begin;    ///< begin of each group
    std::vector<std::uint32_t> members;  ///< concatenated groups
};

Grouped group(std::size_t groups, const std::vector<std::uint32_t>& group_of) {
    Grouped grouped{std::vector<std::uint32_t>(groups + 1, 0),
                    std::vector<std::uint32_t>(group_of.size())};
    for (const std::uint32_t g : group_of) ++grouped.begin[g + 1];
    for (std::size_t g = 0; g < groups; ++g) grouped.begin[g + 1] += grouped.begin[g];
    auto next = grouped.begin;
    for (std::uint32_t i = 0; i < group_of.size(); ++i) grouped.members[next[group_of[i]]++] = i;
    return grouped;
}

/// Returns the largest bound used.
Bound check_cell_volumes(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                         Findings& findings) {
    // Cells without a parent in this process's view form the last group.
    const auto coarse_cells = static_cast<std::uint32_t>(coarse.mesh.cells.size());
    std::vector<std::uint32_t> parents(fine.mesh.cells.size());
    for (CellIndex c{0}; c < fine.mesh.cells.end_index(); ++c) {
        parents[c.value()] = std::min(descent.parent[c].value(), coarse_cells);
    }
    const Grouped children = group(coarse_cells + 1, parents);
    exact::VolumeSum difference;
    Bound largest = 0;
    Steps step(findings, coarse.mesh.cells.size());
    for (CellIndex c{0}; c < coarse.mesh.cells.end_index(); ++c) {
        step();
        if (!coarse.owns(coarse.mesh.cells[c])) continue;
        const std::uint32_t first = children.begin[c.value()];
        const std::uint32_t last = children.begin[c.value() + 1];
        const auto corners = coarse.corners(c);
        if (last - first == 1 && fine.corners(CellIndex{children.members[first]}) == corners) {
            ++findings.arithmetic().filtered;  // the volume is that of the same points
            continue;
        }
        difference.clear(exact::largest_coordinate(corners));
        difference.subtract(corners);
        Bound bound = 0;
        for (std::uint32_t i = first; i < last; ++i) {
            const CellIndex child{children.members[i]};
            const auto shape = shape_of(fine.mesh.cells[child], fine.mesh, descent);
            difference.add(shape.corners);
            bound = (bound + volume_bound(shape)) * up;
        }
        ++findings.arithmetic().exact;
        largest = std::max(largest, bound);
        if (difference.is_within(bound)) continue;
        findings.add(Code::wrong_volume, [&]() -> Findings::Description {
            return {{entity(c, Which::coarse)},
                    fmt::format("its {} cells have {:.17g} more volume", last - first,
                                difference.rounded() / 6),
                    fmt::format("at most {:.3g}", bound / 6)};
        });
    }
    return largest / 6;
}

Bound check_boundary_areas(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                           Findings& findings) {
    constexpr std::uint32_t not_on_boundary = 0xffffffffU;
    std::vector<CellFace> coarse_faces = boundary_faces(coarse);
    std::erase_if(coarse_faces,
                  [&](CellFace f) { return !coarse.owns(coarse.mesh.cells[f.cell]); });
    std::vector<std::uint32_t> number_of(4 * coarse.mesh.cells.size(), not_on_boundary);
    for (std::uint32_t i = 0; i < coarse_faces.size(); ++i) number_of[tag_of(coarse_faces[i])] = i;

    std::vector<CellFace> fine_faces;
    std::vector<std::uint32_t> coarse_of;
    for (const CellFace f : boundary_faces(fine)) {
        const auto whole = descent.coarse_face(f);
        if (!whole) continue;  // an open face, already reported by check_cover
        const std::uint32_t number = number_of[tag_of(*whole)];
        if (number == not_on_boundary) continue;
        fine_faces.push_back(f);
        coarse_of.push_back(number);
    }
    const Grouped pieces = group(coarse_faces.size(), coarse_of);
    exact::AreaSum difference;
    Bound largest = 0;
    for (std::size_t i = 0; i < coarse_faces.size(); ++i) {
        const auto corners_of = [](const FacetVertices& v, const Mesh& mesh) {
            return std::array<Point, 3>{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
        };
        const FacetVertices whole =
            outward_face(coarse.mesh.cells[coarse_faces[i].cell], coarse_faces[i].face);
        difference.clear();
        difference.subtract(corners_of(whole, coarse.mesh));
        Bound bound = 0;
        for (std::uint32_t k = pieces.begin[i]; k < pieces.begin[i + 1]; ++k) {
            const CellFace f = fine_faces[pieces.members[k]];
            const auto shape =
                shape_of(outward_face(fine.mesh.cells[f.cell], f.face), fine.mesh, descent);
            difference.add(shape.corners);
            bound = (bound + area_bound(shape)) * up;
        }
        ++findings.arithmetic().exact;
        largest = std::max(largest, bound);
        if (difference.is_within(bound)) continue;
        findings.add(Code::boundary_moved, [&]() -> Findings::Description {
            const Point d = difference.rounded();
            return {{entity(whole, Which::coarse)},
                    fmt::format("its pieces have ({:.6g}, {:.6g}, {:.6g}) more vector area",
                                d.x / 2, d.y / 2, d.z / 2),
                    fmt::format("at most {:.3g} in each component", bound / 2)};
        });
    }
    return largest / 2;
}

}  // namespace

std::string check_volumes(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                          Findings& findings) {
    const ProcessGroup& group = findings.group();
    const Bound volume = greatest(group, check_cell_volumes(coarse, fine, descent, findings));
    const Bound area = greatest(group, check_boundary_areas(coarse, fine, descent, findings));
    if (volume == 0 && area == 0) return "of every coarse cell and boundary face, exactly";
    return fmt::format(
        "of every coarse cell to within {:.3g}, of every boundary face to within {:.3g}", volume,
        area);
}

}  // namespace octetra::verify
