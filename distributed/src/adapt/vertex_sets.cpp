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
#include "comm/local_failure.hpp"
#include "numbering/vertex_markers.hpp"

namespace octetra::distributed {
namespace {

using Flags = std::vector<std::uint8_t>;

/// Collective. Returns the flags that `mark` sets on any sharer of the vertex.
Flags flagged_anywhere(const AdaptiveMesh& mesh, const std::function<void(Flags&)>& mark) {
    Flags flags;
    LocalFailure failure;
    failure.attempt([&] {
        flags.assign(mesh.points().size(), 0);
        mark(flags);
    });
    failure.agree(mesh.processes());
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
    return flagged_anywhere(*this, [&](Flags& flags) {
        for (const auto& [cell, face] : boundary()) {
            for (const std::uint8_t k : cell_faces[face]) {
                flags[cells()[cell.value()][k].value()] = 1;
            }
        }
    });
}

std::vector<std::uint8_t> AdaptiveMesh::vertices_of(Marker marker, int dimension) const {
    processes().check_same("marker and dimension", fmt::format("{}, {}", marker, dimension));
    if (dimension != 0) {
        return flagged_anywhere(*this, [&](Flags& flags) {
            switch (dimension) {
                case 1: return flag_vertices(edges(), edge_markers(), marker, flags);
                case 2: return flag_vertices(facets(), facet_markers(), marker, flags);
                case 3: return flag_vertices(cells(), regions(), marker, flags);
                default:
                    throw InputError(
                        fmt::format("a dimension is one of 0, 1, 2 and 3, not {}", dimension));
            }
        });
    }
    const std::vector<Marker> markers = vertex_markers();
    Flags flags;
    LocalFailure failure;
    failure.attempt([&] {
        flags.assign(points().size(), 0);
        for (std::size_t v = 0; v < markers.size(); ++v) flags[v] = markers[v] == marker ? 1 : 0;
    });
    failure.agree(processes());
    return flags;
}

std::vector<std::uint8_t> AdaptiveMesh::vertices_of(std::string_view group) const {
    processes().check_same("group", std::string(group));
    std::vector<GroupName> groups;
    Flags flags;
    LocalFailure failure;
    failure.attempt([&] {
        groups = groups_called(*this, group);
        flags.assign(points().size(), 0);
    });
    failure.agree(processes());
    for (const GroupName& one : groups) {
        const Flags of_one = vertices_of(one.tag, one.dimension);
        for (std::size_t v = 0; v < flags.size(); ++v) flags[v] |= of_one[v];
    }
    return flags;
}

std::vector<double> AdaptiveMesh::vertex_volumes() const {
    const StandardArithmetic standard;
    std::vector<double> volumes;
    LocalFailure failure;
    failure.attempt([&] {
        volumes.assign(points().size(), 0);
        for (const CellVertices& cell : cells()) {
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = points()[cell[k].value()];
            const double share = volume(corners) / 4;
            for (const VertexIndex v : cell) volumes[v.value()] += share;
        }
    });
    failure.agree(processes());
    combine_everywhere(processes(), vertex_sharing(), volumes.size(), volumes, std::plus<>{});
    return volumes;
}

std::vector<Marker> AdaptiveMesh::vertex_markers() const {
    return distributed::vertex_markers(state_->mesh, state_->numbers);
}

}  // namespace octetra::distributed
