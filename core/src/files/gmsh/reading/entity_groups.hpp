#pragma once

#include <cstdint>
#include <unordered_map>

#include <octetra/core/mesh.hpp>

namespace octetra::gmsh {

/// An entity of the geometry, from `$Entities` or `$PartitionedEntities`.
struct Entity {
    Marker marker = 0;          ///< the tag of its first physical group; 0: none
    bool is_interface = false;  ///< lies between partitions; not part of the geometry
    bool is_missing = false;    ///< not listed, although other entities are
};

/// The entities of a file of version 4.1, by dimension and tag.
class EntityGroups {
public:
    void add(std::int32_t dimension, std::int32_t tag, const Entity& entity, std::uint64_t groups) {
        entities_[key(dimension, tag)] = entity;
        if (groups > 1) ++in_several_;
    }
    /// Returns the entity; an unlisted one has no group.
    [[nodiscard]] Entity find(std::int32_t dimension, std::int32_t tag) const {
        const auto found = entities_.find(key(dimension, tag));
        return found == entities_.end() ? Entity{.is_missing = !entities_.empty()} : found->second;
    }
    /// Returns the number of entities in more than one group.
    [[nodiscard]] std::uint64_t in_several() const { return in_several_; }

private:
    static std::uint64_t key(std::int32_t dimension, std::int32_t tag) {
        return std::uint64_t{static_cast<std::uint32_t>(dimension)} << 32U |
               static_cast<std::uint32_t>(tag);
    }

    std::unordered_map<std::uint64_t, Entity> entities_;
    std::uint64_t in_several_ = 0;
};

}  // namespace octetra::gmsh
