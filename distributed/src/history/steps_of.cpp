#include "history/steps_of.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include "history/cuts.hpp"
#include "history/families.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {
namespace {

struct Nothing {};
using CellFamilies = Families<4, Nothing>;

/// Returns the edges of the parent that were bisected to make its children.
EdgeMask bisected(const CellVertices& parent, std::span<const CellFamilies::Member> children,
                  VertexIndex first_new, const VertexLevels& levels) {
    if (children.size() == 8) return all_edges;
    unsigned edges = 0;
    for (const auto& child : children) {
        for (const VertexIndex v : child.vertices) {
            if (v >= first_new) edges |= 1U << edge_between(parent, levels.ends(v));
        }
    }
    return static_cast<EdgeMask>(edges);
}

/// Accumulates the steps of a tree of cells from its families in order of completion. A step
/// applies to the cells that earlier steps made and no earlier step cut; those to the left of a
/// cell that the step cuts are visited before it, those to the right after it.
class Steps {
public:
    explicit Steps(std::size_t count) : runs_(count), written_(count, 0), counts_(count + 1) {}

    void cut(std::uint32_t level, Cut cut) {
        write_whole(level);
        runs_[level - 1].append(cut);
        ++counts_[level].cut;
        ++written_[level - 1];
    }
    /// Records that a cell made by `level` has been visited with all its descendants.
    void met(std::uint32_t level) { ++counts_[level].made; }

    [[nodiscard]] std::vector<CutRuns> finish() && {
        for (std::uint32_t level = 1; level <= runs_.size(); ++level) {
            write_whole(level);
            runs_[level - 1].finish();
        }
        return std::move(runs_);
    }

private:
    struct Counts {
        std::uint64_t made = 0;
        std::uint64_t cut = 0;
    };

    /// Appends, as whole, the cells visited since the last one that the step cut.
    void write_whole(std::uint32_t level) {
        std::uint64_t there = 0;
        for (std::uint32_t before = 0; before < level; ++before) {
            there += counts_[before].made - counts_[before].cut;
        }
        // The cut ancestors of visited cells have been recorded; cells that this level cut are not
        // yet.
        runs_[level - 1].append(0, there - written_[level - 1]);
        written_[level - 1] = there;
    }

    std::vector<CutRuns> runs_;
    std::vector<std::uint64_t> written_;  ///< for each step, the cells written so far
    std::vector<Counts> counts_;          ///< indexed by level, from 0
};

/// Returns a map with the same roots, each its own only descendant.
AncestorMap undivided(const AncestorMap& ancestors) {
    AncestorMap roots{.roots = ancestors.roots, .first = {}, .markers = ancestors.markers};
    roots.first.resize(roots.roots.size() + 1);
    std::iota(roots.first.begin(), roots.first.end(), 0U);
    return roots;
}

/// A corner keeps its position in every child that has it, and a child's other vertices are newer:
/// at each position, the root's corner is the oldest of all descendants.
template <class I, std::size_t N>
IndexVector<I, std::array<VertexIndex, N>> roots_of(
    const IndexVector<I, std::array<VertexIndex, N>>& list, const AncestorMap& ancestors) {
    IndexVector<I, std::array<VertexIndex, N>> roots;
    roots.reserve(ancestors.roots.size());
    for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
        std::array<VertexIndex, N> root = list[I{ancestors.first[r]}];
        for (I i{ancestors.first[r] + 1}; i < I{ancestors.first[r + 1]}; ++i) {
            for (std::size_t k = 0; k < N; ++k) root[k] = std::min(root[k], list[i][k]);
        }
        roots.push_back(root);
    }
    return roots;
}

}  // namespace

std::vector<CutRuns> steps_of(const DistributedMesh& mesh) {
    const VertexLevels levels(mesh);
    Steps steps(levels.count());
    CellFamilies families(levels);
    const auto on_parent = [&](std::uint32_t level, const CellVertices& parent,
                               std::span<const CellFamilies::Member> children) {
        const EdgeMask edges = bisected(parent, children, levels.begin(level), levels);
        steps.cut(level, cut_into(edges, children.size()));
        steps.met(levels.newest(parent));
        return Nothing{};
    };
    for (const CellVertices& cell : mesh.cells) {
        steps.met(levels.newest(cell));
        families.add(cell, {}, on_parent, [](auto&&...) {});
    }
    return std::move(steps).finish();
}

DistributedMesh input_of(const DistributedMesh& mesh) {
    const auto vertex_count = static_cast<std::ptrdiff_t>(mesh.input_vertices.size());
    const auto attribute_count =
        vertex_count * static_cast<std::ptrdiff_t>(mesh.attributes_per_point);
    DistributedMesh input;
    input.processes = mesh.processes;
    input.points.assign(mesh.points.begin(), mesh.points.begin() + vertex_count);
    input.attributes_per_point = mesh.attributes_per_point;
    input.point_attributes.assign(mesh.point_attributes.begin(),
                                  mesh.point_attributes.begin() + attribute_count);
    input.input_vertices = mesh.input_vertices;
    input.input_vertex_markers = mesh.input_vertex_markers;
    input.cells = roots_of(mesh.cells, mesh.cell_ancestors);
    input.cell_ancestors = undivided(mesh.cell_ancestors);
    input.facets = roots_of(mesh.facets, mesh.facet_ancestors);
    input.facet_ancestors = undivided(mesh.facet_ancestors);
    input.edges = roots_of(mesh.edges, mesh.edge_ancestors);
    input.edge_ancestors = undivided(mesh.edge_ancestors);
    input.input_vertex_count = mesh.input_vertex_count;
    input.input_cell_count = mesh.input_cell_count;
    input.index_base = mesh.index_base;
    input.group_names = mesh.group_names;
    input.closure = mesh.closure;
    input.features = mesh.features;
    return input;
}

}  // namespace octetra::distributed
