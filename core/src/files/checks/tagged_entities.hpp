#pragma once

#include <octetra/core/mesh.hpp>
#include <octetra/core/repeated_cells.hpp>

namespace octetra {

/// The first entry of a list of facets or edges that cannot be right.
template <class I>
struct WrongEntry {
    I entry = I::none();    ///< none: there is no such entry
    I earlier = I::none();  ///< has the same vertices and another marker; none: no cell has entry's
};

struct WrongFacets {
    WrongEntry<FacetIndex> tagged;
    /// Two cells that lie on the same side of a tagged facet, the first such in the order of cells.
    CellPair overlap;
    FacetIndex common = FacetIndex::none();  ///< the facet
};

/// Judges the tagged facets. Vertex numbers must be in range, and cells positive.
/// Takes 8 bytes per vertex and 4 per facet meanwhile.
[[nodiscard]] WrongFacets find_wrong_facets(const Mesh& mesh);

/// Judges the tagged edges, likewise.
[[nodiscard]] WrongEntry<EdgeIndex> find_wrong_edge(const Mesh& mesh);

}  // namespace octetra
