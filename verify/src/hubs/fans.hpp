#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "hubs/axial_view.hpp"
#include "hubs/directions.hpp"
#include "hubs/hubs.hpp"
#include "lookup/box_tree.hpp"

namespace octetra::verify {

/// Edges, faces or cells at or near hubs, searchable by the entities that they may meet elsewhere.
/// Their boxes overlap too much to be useful, but their directions from the hub do not, because
/// entities that do not cross lie side by side. Each hub therefore has a tree of boxes around
/// directions: in cylindrical coordinates if the hub has an axis, otherwise in x, y and z. Keeps a
/// pointer to the points.
template <std::size_t N>
class Fans {
public:
    using Vertices = std::array<VertexIndex, N>;
    struct Entity {
        Apex apex;  ///< the viewpoint
        Vertices vertices;
        std::uint32_t number = 0;  ///< assigned by the caller

        /// Returns whether it contains the whole apex. (Entities near an apex contain none of it,
        /// or one end.)
        [[nodiscard]] bool is_at_apex() const {
            return std::count_if(vertices.begin(), vertices.end(), [this](VertexIndex v) {
                       return apex.has(v);
                   }) == (apex.is_edge() ? 2 : 1);
        }
    };

    Fans(const IndexVector<VertexIndex, Point>& points, const Hubs& hubs,
         std::vector<Entity> entities)
        : points_(&points), fans_(fans_of(std::move(entities), hubs)), boxes_(boxes_of_fans()) {}

    [[nodiscard]] bool empty() const { return fans_.empty(); }

    /// Calls visit(entity) for each entity that may have a point in common with a vertex, edge or
    /// face, except for entities at a hub that this contains. Adds the number of boxes tested to
    /// `search_tests`.
    template <std::size_t M>
    void for_each_near(const std::array<VertexIndex, M>& vertices, std::uint64_t& search_tests,
                       auto&& visit) const {
        static_assert(M <= 3);
        const Bounds box = bounds_of_vertices(vertices);
        boxes_.for_each_meeting(box, [&](std::uint32_t number) {
            ++search_tests;
            const Fan& fan = fans_[number];
            const auto is_of_apex = [&](VertexIndex v) { return fan.apex.has(v); };
            if (fan.at_apex && std::any_of(vertices.begin(), vertices.end(), is_of_apex)) return;
            const auto visit_if_close = [&](std::uint32_t i) {
                if (bounds_of_vertices(fan.entities[i].vertices).meets(box)) {
                    visit(fan.entities[i]);
                }
            };
            std::array<Direction, M> directions;
            const std::span rays(directions.data(), directions_of(fan, vertices, directions));
            if (fan.axial) {
                const auto wanted = fan.axial->wanted(rays);
                const auto meets = [&](const Bounds& b) { return wanted.meets(b); };
                fan.directions.for_each_meeting(Counting<decltype(meets)>(meets, &search_tests),
                                                visit_if_close);
            } else {
                const Cone cone(rays);
                const auto meets = [&](const Bounds& b) { return !cone.misses(b); };
                fan.directions.for_each_meeting(Counting<decltype(meets)>(meets, &search_tests),
                                                visit_if_close);
            }
        });
    }

private:
    template <class Meets>
    struct Counting {
        Meets may_meet;
        std::uint64_t* search_tests;

        Counting(Meets test, std::uint64_t* count) : may_meet(test), search_tests(count) {}
        [[nodiscard]] bool meets(const Bounds& directions) const {
            ++*search_tests;
            return may_meet(directions);
        }
    };

    struct Fan {
        Apex apex;
        bool at_apex = false;  ///< whether all entities contain the apex, or none
        Viewpoint viewpoint;
        std::optional<AxialView> axial;  ///< set if directions are relative to an axis
        std::vector<Entity> entities;
        BoxTree directions;
    };

    template <std::size_t M>
    [[nodiscard]] Bounds bounds_of_vertices(const std::array<VertexIndex, M>& vertices) const {
        Bounds bounds;
        for (const VertexIndex v : vertices) bounds.take((*points_)[v]);
        return bounds;
    }

    /// Returns the box of the directions of an entity's vertices other than those of the apex. The
    /// directions of all its points are convex combinations of these.
    [[nodiscard]] Bounds directions_box(const Entity& entity, const Viewpoint& from,
                                        const std::optional<AxialView>& axial) const {
        std::array<Direction, N> directions;
        std::size_t count = 0;
        for (const VertexIndex v : entity.vertices) {
            if (!entity.apex.has(v)) directions[count++] = from.towards((*points_)[v]);
        }
        const std::span rays(directions.data(), count);
        return axial ? axial->bounds_of_entity(rays) : bounds_of_directions(rays);
    }

    /// As above, for other vertices; returns their number.
    template <std::size_t M>
    std::size_t directions_of(const Fan& fan, const std::array<VertexIndex, M>& vertices,
                              std::array<Direction, M>& directions) const {
        std::size_t count = 0;
        for (const VertexIndex v : vertices) {
            if (!fan.apex.has(v)) directions[count++] = fan.viewpoint.towards((*points_)[v]);
        }
        return count;
    }

    [[nodiscard]] std::vector<Fan> fans_of(std::vector<Entity> entities, const Hubs& hubs) const {
        const auto key = [](const Entity& e) {
            return std::tuple(e.apex, e.is_at_apex(), e.vertices, e.number);
        };
        std::sort(entities.begin(), entities.end(),
                  [&](const Entity& s, const Entity& t) { return key(s) < key(t); });
        std::vector<Fan> fans;
        for (auto next = entities.begin(); next != entities.end();) {
            const Apex apex = next->apex;
            const bool at_apex = next->is_at_apex();
            const Viewpoint viewpoint = viewpoint_of(apex, *points_);
            std::optional<AxialView> axial;
            if (const auto axis = hubs.axis_at(apex)) axial.emplace(*axis);
            std::vector<Entity> members;
            std::vector<Bounds> directions;
            for (; next != entities.end() && next->apex == apex && next->is_at_apex() == at_apex;
                 ++next) {
                members.push_back(*next);
                directions.push_back(directions_box(*next, viewpoint, axial));
            }
            const auto cut = axial ? BoxTree::Cut::longest_side : BoxTree::Cut::most_room;
            fans.push_back({apex, at_apex, viewpoint, axial, std::move(members),
                            BoxTree(std::move(directions), cut)});
        }
        return fans;
    }

    [[nodiscard]] BoxTree boxes_of_fans() const {
        std::vector<Bounds> boxes;
        for (const Fan& fan : fans_) {
            Bounds& box = boxes.emplace_back();
            for (const Entity& entity : fan.entities) box.take(bounds_of_vertices(entity.vertices));
        }
        return BoxTree(std::move(boxes));
    }

    const IndexVector<VertexIndex, Point>* points_;
    std::vector<Fan> fans_;
    BoxTree boxes_;
};

}  // namespace octetra::verify
