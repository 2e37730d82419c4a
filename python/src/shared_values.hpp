#pragma once

#include <cstddef>
#include <memory>
#include <variant>

#include <octetra/distributed/sharing.hpp>
#include <octetra/distributed/sides.hpp>

#include "held_mesh.hpp"

namespace octetra::python {

/// The sharers and owners of the vertices, edges or faces of this rank, of which there are `count`.
struct SharedEntities {
    template <class I>
    using Pointer = std::shared_ptr<const od::Sharing<I>>;

    od::Communicator processes;
    std::size_t count = 0;
    std::variant<Pointer<VertexIndex>, Pointer<EdgeIndex>, Pointer<od::FaceIndex>> sharing;
};

}  // namespace octetra::python
