"""The conversions of meshes, and their result."""

import typing
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from .. import _octetra
from . import _versions
from ._common import NONE as NONE, check

if _versions.IS_COMPILED_FOR:
    from ._compiled import from_mesh as _from_mesh, to_mesh as _to_mesh
else:  # nanobind binds DOLFINx's classes, and a module of pybind11 cannot pass their objects
    from ._from_mesh import from_mesh as _from_mesh
    from ._to_mesh import to_mesh as _to_mesh


class Handover(typing.NamedTuple):
    """A DOLFINx mesh, with the cells and vertices of the octetra.Mesh, at the time of conversion, for its cells
    and nodes."""

    mesh: Any  #: the dolfinx.mesh.Mesh
    cell_tags: Any  #: its MeshTags of regions, including ghost cells; None if there are no regions
    facet_tags: Any  #: its MeshTags of facets, on all ranks that have a facet; None if there are none
    cells: NDArray[np.int32]  #: (owned cells,): the cell of the octetra.Mesh for each DOLFINx cell
    vertices: NDArray[np.int32]  #: (nodes,): the vertex of the octetra.Mesh for each row of mesh.geometry.x, or NONE


def to_mesh(mesh: _octetra.Mesh, *, ghosts: Optional[str] = "face", tags: bool = True) -> Handover:
    """Collective. Converts the mesh for DOLFINx, on the same communicator.

    Every cell stays on its rank and keeps its number. `ghosts` selects the ghost cells of each rank: those with a
    common "face" or "vertex", or None. Integrals over interior facets require ghosts by faces. Without `tags`,
    regions and tagged facets are not converted; tagged facets require that DOLFINx numbers all facets.
    """
    return Handover(*_to_mesh(mesh, ghosts, tags))


def from_mesh(mesh: Any, cell_tags: Any = None, facet_tags: Any = None) -> Tuple[_octetra.Mesh, Handover]:
    """Collective. Converts a DOLFINx mesh for Octetra, on the same communicator; returns the mesh and the
    correspondence of cells and vertices.

    The mesh must consist of affine tetrahedra. Every cell stays on its rank; inverted cells are reversed. Tags,
    dolfinx MeshTags of integers or None on all ranks, become region tags, 0 for cells without a tag, and tagged
    facets. Cells and vertices have the order in which they were passed to create_mesh(), if the mesh still has
    this information; output then does not depend on the number of ranks.
    """
    check(mesh.comm, _fault_of_cell_tags(mesh, cell_tags))
    made, cells, vertices = _from_mesh(mesh, cell_tags, facet_tags)
    return made, Handover(mesh, cell_tags, facet_tags, cells, vertices)


def _fault_of_cell_tags(mesh: Any, tags: Any) -> str:
    if tags is None or tags.dim != 3 or len(tags.indices) == 0:
        return ""
    cells = mesh.topology.index_map(3)
    count, last = cells.size_local + cells.num_ghosts, tags.indices.max()
    return "" if last < count else f"tags of cells up to number {last}, but the mesh has {count}: no such cell"
