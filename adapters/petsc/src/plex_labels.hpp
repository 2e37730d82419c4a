#pragma once

#include <petscdmplex.h>

#include <span>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::petsc {

/// A point of a plex and the marker that it has.
struct MarkedPoint {
    PetscInt point = 0;
    Marker marker = 0;
};

/// Not collective, but that all processes make the label. Points ascend.
void set_label(DM plex, const std::string& name, std::span<const MarkedPoint> points);

/// Not collective. What the label says of points from `begin` to `end`, ascending by marker, then
/// by point; nothing where there is no such label.
[[nodiscard]] std::vector<MarkedPoint> points_of_label(DM plex, const std::string& name,
                                                       PetscInt begin, PetscInt end);

}  // namespace octetra::petsc
