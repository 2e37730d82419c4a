#pragma once

#include <petscdmplex.h>

#include <span>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::petsc {

/// A point of a plex and its marker.
struct MarkedPoint {
    PetscInt point = 0;
    Marker marker = 0;
};

/// Not collective, except that all processes must create the label. Precondition: points ascend.
void set_label(DM plex, const std::string& name, std::span<const MarkedPoint> points);

/// Not collective. Returns the label's values on points from `begin` to `end`, ascending by marker,
/// then by point; empty if there is no such label.
[[nodiscard]] std::vector<MarkedPoint> points_of_label(DM plex, const std::string& name,
                                                       PetscInt begin, PetscInt end);

}  // namespace octetra::petsc
