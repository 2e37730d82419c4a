#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/incidence.hpp"

namespace octetra::distributed {

/// The position of a shared edge or face in the list of an interface.
struct SharedPosition {
    std::uint32_t interface = 0;
    std::uint32_t position = 0;

    friend auto operator<=>(const SharedPosition&, const SharedPosition&) = default;
};

/// The number of an entry among the edges, or faces, of all interfaces, in unspecified order.
using SharedIndex = Index<struct SharedRole>;

/// Finds the shared edges (N = 2) or faces (N = 3) by their vertices. An edge has an entry for each
/// rank that shares it.
template <std::size_t N>
class SharedEntities {
public:
    using Vertices = std::array<VertexIndex, N>;

    /// An empty index.
    SharedEntities() = default;
    SharedEntities(std::size_t vertex_count, const std::vector<Interface>& interfaces)
        : SharedEntities(vertex_count, interfaces, all_of(interfaces)) {}

    [[nodiscard]] Incidence<SharedIndex, N>& incidence() { return incidence_; }
    void set_vertex_count(std::size_t count) { incidence_.set_vertex_count(count); }
    /// Reserves capacity so that append() cannot fail for added[i] entities of each interface i.
    void make_room(const std::vector<std::size_t>& added, std::vector<Interface>& interfaces) {
        std::size_t total = 0;
        for (std::size_t i = 0; i < interfaces.size(); ++i) {
            auto& list = list_of(interfaces[i]);
            octetra::make_room(list, list.size() + added[i]);
            total += added[i];
        }
        octetra::make_room(places_, places_.size() + total);
        incidence_.make_room(total);
    }

    struct Found {
        SharedIndex index;
        SharedPosition place;
        std::size_t edge = 0;  ///< position of the edge in the entity
    };

    /// Calls found(Found) for each entity that has the edge.
    void for_each_with(const EdgeVertices& edge, const std::vector<Interface>& interfaces,
                       auto&& found) const {
        const auto vertices_of = [&](SharedIndex i) -> const Vertices& {
            return list_of(interfaces[places_[i].interface])[places_[i].position];
        };
        incidence_.for_each_with(edge, vertices_of, [&](SharedIndex i, std::size_t e) {
            found(Found{i, places_[i], e});
        });
    }

    void replace(SharedIndex i, const Vertices& vertices, std::vector<Interface>& interfaces) {
        Vertices& old = list_of(interfaces[places_[i].interface])[places_[i].position];
        incidence_.replace(i, old, vertices);
        old = vertices;
    }
    void append(std::uint32_t interface, const Vertices& vertices,
                std::vector<Interface>& interfaces) {
        auto& list = list_of(interfaces[interface]);
        places_.push_back({interface, static_cast<std::uint32_t>(list.size())});
        incidence_.append(vertices);
        list.push_back(vertices);
    }

private:
    using All = IndexVector<SharedIndex, Vertices>;

    SharedEntities(std::size_t vertex_count, const std::vector<Interface>& interfaces,
                   const All& all)
        : incidence_(vertex_count, all) {
        places_.reserve(all.size());
        for (std::size_t i = 0; i < interfaces.size(); ++i) {
            for (std::size_t k = 0; k < list_of(interfaces[i]).size(); ++k) {
                places_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)});
            }
        }
    }

    static All all_of(const std::vector<Interface>& interfaces) {
        All all;
        for (const Interface& interface : interfaces) {
            all.insert(all.end(), list_of(interface).begin(), list_of(interface).end());
        }
        return all;
    }
    static auto& list_of(auto& interface) {
        if constexpr (N == 2) {
            return interface.edges;
        } else {
            return interface.faces;
        }
    }

    Incidence<SharedIndex, N> incidence_;
    IndexVector<SharedIndex, SharedPosition> places_;
};

}  // namespace octetra::distributed
