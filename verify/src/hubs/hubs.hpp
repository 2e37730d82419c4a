#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "hubs/directions.hpp"
#include "mesh/judged_mesh.hpp"

namespace octetra::verify {

/// The viewpoint of a fan of entities: a vertex or an edge.
struct Apex {
    VertexIndex a = VertexIndex::none();
    VertexIndex b = VertexIndex::none();  ///< none() for a vertex

    [[nodiscard]] bool is_none() const { return a.is_none(); }
    [[nodiscard]] bool is_edge() const { return !b.is_none(); }
    [[nodiscard]] bool has(VertexIndex v) const { return v == a || v == b; }
    friend constexpr auto operator<=>(const Apex&, const Apex&) = default;
};

[[nodiscard]] Viewpoint viewpoint_of(const Apex& apex,
                                     const IndexVector<VertexIndex, Point>& points);

/// Hubs: vertices and edges with so many cells that testing all pairs of these is too expensive. An
/// entity at a hub, or near one and much longer than wide as seen from there, has a box that
/// overlaps many others, but a direction that does not.
class Hubs {
public:
    explicit Hubs(const JudgedMesh& judged);

    [[nodiscard]] bool none() const { return hubs_ == 0; }

    /// Returns the apex from which an edge, face or cell is searched by its direction, or none if
    /// it is searched by its box. For edges, apexes are vertices only.
    [[nodiscard]] Apex apex_of(std::span<const VertexIndex> entity) const;

    /// Returns the direction of the axis of an apex that many cells surround: the apex itself if it
    /// is an edge, or the first edge that is a hub at a vertex. Returns nothing if there is none or
    /// it is unknown.
    [[nodiscard]] std::optional<Vector> axis_at(const Apex& apex) const;

private:
    /// Some of the hubs closest to a vertex, by number of edges.
    using NearHubs = std::array<VertexIndex, 4>;
    struct Axis {
        VertexIndex hub;
        Apex edge;  ///< contains the hub vertex, and is itself a hub
    };

    void find_axes(const JudgedMesh& judged);
    void find_near_hubs(const JudgedMesh& judged);

    [[nodiscard]] std::vector<Axis>::const_iterator first_axis_at(VertexIndex hub) const;
    [[nodiscard]] bool is_hub(VertexIndex v) const { return degree_[v.value()] > many_; }
    [[nodiscard]] Apex apex_at(std::span<const VertexIndex> entity) const;
    [[nodiscard]] Apex apex_near(std::span<const VertexIndex> entity) const;
    void for_each_view(VertexIndex hub, bool from_edges, auto&& visit) const;

    const IndexVector<VertexIndex, Point>* points_;
    std::uint32_t many_;
    std::vector<std::uint32_t> degree_;  ///< number of edges at each vertex
    std::size_t hubs_ = 0;
    std::vector<Axis> axes_;      ///< ascending by hub
    std::vector<NearHubs> near_;  ///< for each vertex; empty if there are no hubs
};

}  // namespace octetra::verify
