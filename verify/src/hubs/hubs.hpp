#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "hubs/directions.hpp"
#include "mesh/judged_mesh.hpp"

namespace octetra::verify {

/// From where a fan of entities is seen: a vertex, or an edge.
struct Apex {
    VertexIndex a = VertexIndex::none();
    VertexIndex b = VertexIndex::none();  ///< none() of a vertex

    [[nodiscard]] bool is_none() const { return a.is_none(); }
    [[nodiscard]] bool is_edge() const { return !b.is_none(); }
    [[nodiscard]] bool has(VertexIndex v) const { return v == a || v == b; }
    friend constexpr auto operator<=>(const Apex&, const Apex&) = default;
};

[[nodiscard]] Viewpoint viewpoint_of(const Apex& apex,
                                     const IndexVector<VertexIndex, Point>& points);

/// Vertices and edges with so many cells that not all pairs of these can be looked at. What is at a
/// hub, or near one and much longer than wide as seen from there, has a box that tells little, and
/// a direction that tells much.
class Hubs {
public:
    explicit Hubs(const JudgedMesh& judged);

    [[nodiscard]] bool none() const { return hubs_ == 0; }

    /// From where an edge, face or cell is looked at by its directions; none: it is found by its
    /// box. Edges are looked at from vertices only.
    [[nodiscard]] Apex apex_of(std::span<const VertexIndex> entity) const;

    /// Where the axis of an apex leads that many cells surround: the apex itself if it is an edge,
    /// or the first edge at a vertex that is a hub. Nothing if there is none, or it is unknown.
    [[nodiscard]] std::optional<Vector> axis_at(const Apex& apex) const;

private:
    /// Some of the hubs that are nearest to a vertex, counted in edges.
    using NearHubs = std::array<VertexIndex, 4>;
    struct Axis {
        VertexIndex hub;
        Apex edge;  ///< which has the hub, and is one itself
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
    std::vector<std::uint32_t> degree_;  ///< of each vertex: how many edges it has
    std::size_t hubs_ = 0;
    std::vector<Axis> axes_;      ///< ascending by hub
    std::vector<NearHubs> near_;  ///< of each vertex; empty where there is no hub
};

}  // namespace octetra::verify
