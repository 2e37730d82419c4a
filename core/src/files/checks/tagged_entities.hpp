#pragma once

#include <octetra/core/mesh.hpp>
#include <octetra/core/repeated_cells.hpp>

namespace octetra {

/// The first entry of a list of facets or edges that is in conflict with the cells or an earlier
/// entry.
template <class I>
struct WrongEntry {
    I entry = I::none();    ///< none: there is no such entry
    I earlier = I::none();  ///< has the same vertices and another marker; none: no cell has entry
};

struct WrongFacets {
    WrongEntry<FacetIndex> tagged;
    /// Two cells on the same side of a tagged facet, the first such pair in the order of cells.
    CellPair overlap;
    FacetIndex common = FacetIndex::none();  ///< the facet
};

/// Checks the tagged facets. Vertex numbers must be in range, and cells positive. Takes temporary
/// memory of 8 bytes per vertex and 4 per facet.
[[nodiscard]] WrongFacets find_wrong_facets(const Mesh& mesh);

/// Checks the tagged edges, likewise.
[[nodiscard]] WrongEntry<EdgeIndex> find_wrong_edge(const Mesh& mesh);

}  // namespace octetra
