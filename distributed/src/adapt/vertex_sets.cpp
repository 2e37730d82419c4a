#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>

#include "adapt/mesh_state.hpp"
#include "numbering/vertex_markers.hpp"

namespace octetra::distributed {
namespace {

using Flags = std::vector<std::uint8_t>;

/// Collective. Returns the flags that `mark` sets on any sharer of the vertex.
Flags flagged_anywhere(const AdaptiveMesh& mesh, const std::function<void(Flags&)>& mark) {
    Flags flags(mesh.points().size(), 0);
    mark(flags);
    combine_everywhere(mesh.processes(), mesh.vertex_sharing(), flags.size(), flags,
                       std::logical_or<>{});
    return flags;
}

/// Sets the flags of the vertices of the entities with this marker.
template <std::size_t N>
void flag_vertices(std::span<const std::array<VertexIndex, N>> entities,
                   const std::vector<Marker>& markers, Marker marker, Flags& flags) {
    for (std::size_t i = 0; i < markers.size(); ++i) {
        if (markers[i] != marker) continue;
        for (const VertexIndex v : entities[i]) flags[v.value()] = 1;
    }
}

/// Collective. See AdaptiveMesh::vertices_of().
Flags flags_of(const AdaptiveMesh& mesh, Marker marker, int dimension) {
    if (dimension == 0) {
        const std::vector<Marker> markers = mesh.vertex_markers();
        Flags flags(mesh.points().size(), 0);
        for (std::size_t v = 0; v < markers.size(); ++v) flags[v] = markers[v] == marker ? 1 : 0;
        return flags;
    }
    return flagged_anywhere(mesh, [&](Flags& flags) {
        switch (dimension) {
            case 1: return flag_vertices(mesh.edges(), mesh.edge_markers(), marker, flags);
            case 2: return flag_vertices(mesh.facets(), mesh.facet_markers(), marker, flags);
            case 3: return flag_vertices(mesh.cells(), mesh.regions(), marker, flags);
            default:
                throw InputError(
                    fmt::format("a dimension is one of 0, 1, 2 and 3, not {}", dimension));
        }
    });
}

/// Returns the groups with this name. Throws InputError if there are none.
std::vector<GroupName> groups_called(const AdaptiveMesh& mesh, std::string_view name) {
    std::vector<GroupName> found;
    std::vector<std::string> known;
    for (const GroupName& group : mesh.group_names()) {
        if (group.name == name) found.push_back(group);
        known.push_back(group.name);
    }
    if (!found.empty()) return found;
    throw InputError(known.empty()
                         ? fmt::format("no group is named '{}': the mesh has no named groups", name)
                         : fmt::format("no group is named '{}'; the groups are {}", name,
                                       fmt::join(known, ", ")));
}

}  // namespace

std::vector<std::uint8_t> AdaptiveMesh::boundary_vertices() const {
    return processes().transaction([&] {
        return flagged_anywhere(*this, [&](Flags& flags) {
            for (const auto& [cell, face] : boundary()) {
                for (const std::uint8_t k : cell_faces[face]) {
                    flags[cells()[cell.value()][k].value()] = 1;
                }
            }
        });
    });
}

std::vector<std::uint8_t> AdaptiveMesh::vertices_of(Marker marker, int dimension) const {
    return processes().transaction([&] {
        processes().check_same("marker and dimension", fmt::format("{}, {}", marker, dimension));
        return flags_of(*this, marker, dimension);
    });
}

std::vector<std::uint8_t> AdaptiveMesh::vertices_of(std::string_view group) const {
    return processes().transaction([&] {
        processes().check_same("group", std::string(group));
        Flags flags(points().size(), 0);
        for (const GroupName& one : groups_called(*this, group)) {
            const Flags of_one = flags_of(*this, one.tag, one.dimension);
            for (std::size_t v = 0; v < flags.size(); ++v) flags[v] |= of_one[v];
        }
        return flags;
    });
}

std::vector<double> AdaptiveMesh::vertex_volumes() const {
    const StandardArithmetic standard;
    return processes().transaction([&] {
        std::vector<double> volumes(points().size(), 0);
        for (const CellVertices& cell : cells()) {
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = points()[cell[k].value()];
            const double share = volume(corners) / 4;
            for (const VertexIndex v : cell) volumes[v.value()] += share;
        }
        combine_everywhere(processes(), vertex_sharing(), volumes.size(), volumes, std::plus<>{});
        return volumes;
    });
}

std::vector<Marker> AdaptiveMesh::vertex_markers() const {
    return processes().transaction(
        [&] { return distributed::vertex_markers(state_->mesh, state_->numbers); });
}

}  // namespace octetra::distributed
