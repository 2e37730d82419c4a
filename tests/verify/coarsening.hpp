#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include <octetra/reference/history.hpp>
#include <octetra/verify/verify_coarsening.hpp>

/// Histories of the reference in the verifier's form, and coarser meshes that the reference does
/// not make.
namespace octetra::test {

/// The mesh after the last step of a history.
inline Mesh mesh_of_history(const reference::History& history) {
    return reference::replay(history).back().mesh;
}

inline verify::StepCuts cuts_of(const reference::History& history) {
    const auto meshes = reference::replay(history);
    verify::StepCuts steps;
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        const std::set<EdgeVertices> edges(history.steps[t].begin(), history.steps[t].end());
        std::vector<std::uint8_t> cuts;
        for (const CellVertices& cell : meshes[t].mesh.cells) {
            unsigned cut = 0;
            for (std::size_t k = 0; k < cell_edges.size(); ++k) {
                const auto [a, b] = std::minmax(cell[cell_edges[k][0]], cell[cell_edges[k][1]]);
                if (edges.contains({a, b})) cut |= 1U << k;
            }
            cuts.push_back(static_cast<std::uint8_t>(cut));
        }
        steps.push_back(cuts);
    }
    return steps;
}

/// A request to coarsen exactly these cells.
inline verify::CoarseningRequest request_of(const reference::CellMarks& may_coarsen) {
    verify::CoarseningRequest request;
    for (CellIndex c{0}; c < may_coarsen.end_index(); ++c) {
        if (may_coarsen[c] != 0) request.may_coarsen.cells.push_back(GlobalCell{c.value()});
    }
    return request;
}

/// For each vertex of the history before, whether it is left in the one after.
inline std::vector<char> remaining_vertices(const reference::History& after,
                                            const reference::History& before) {
    const Mesh coarser = mesh_of_history(after);
    const std::set<Point> left(coarser.points.begin(), coarser.points.end());
    std::vector<char> stays;
    for (const Point& p : mesh_of_history(before).points) stays.push_back(left.contains(p) ? 1 : 0);
    return stays;
}

/// The history without the midpoints that do not stay, even against the rules. No edge of a later
/// step may need them.
inline reference::History history_with(const std::vector<char>& stays,
                                       const reference::History& history) {
    reference::History rest{history.input, {}};
    std::vector<VertexIndex> new_number;
    std::size_t count = 0;
    const auto number = [&](bool has) {
        new_number.push_back(has ? VertexIndex{count++} : VertexIndex::none());
    };
    while (count < history.input.points.size()) number(true);
    for (const auto& step : history.steps) {
        std::vector<EdgeVertices> edges;
        for (const auto& [a, b] : step) {
            const bool has = stays[new_number.size()] != 0;
            if (has) edges.push_back({new_number[a.value()], new_number[b.value()]});
            number(has);
        }
        if (!edges.empty()) rest.steps.push_back(edges);
    }
    return rest;
}

/// The step that made each vertex; 0 for those of the input.
inline std::vector<int> steps_of_vertices(const reference::History& history) {
    std::vector<int> steps(history.input.points.size(), 0);
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        steps.resize(steps.size() + history.steps[t].size(), static_cast<int>(t) + 1);
    }
    return steps;
}

/// The midpoints on which no later step depends: no cell at them has a later vertex.
inline std::vector<std::size_t> midpoints_on_top(const reference::History& history) {
    const std::vector<int> step = steps_of_vertices(history);
    std::vector<char> on_top(step.size(), 1);
    for (const CellVertices& cell : mesh_of_history(history).cells) {
        int latest = 0;
        for (const VertexIndex v : cell) latest = std::max(latest, step[v.value()]);
        for (const VertexIndex v : cell) {
            if (step[v.value()] < latest) on_top[v.value()] = 0;
        }
    }
    std::vector<std::size_t> found;
    for (std::size_t v = history.input.points.size(); v < step.size(); ++v) {
        if (on_top[v] != 0) found.push_back(v);
    }
    return found;
}

}  // namespace octetra::test
