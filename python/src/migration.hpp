#pragma once

#include <cstddef>

#include <octetra/distributed/migration.hpp>

#include "held_mesh.hpp"

namespace octetra::python {

/// A migration, and the numbers of cells and vertices of this rank before it.
struct Moved {
    od::Communicator processes;
    std::size_t cells_before = 0;
    std::size_t vertices_before = 0;
    od::Migration migration;
};

}  // namespace octetra::python
