"""Meshes to and from DMPlex, the unstructured meshes of PETSc, through petsc4py.

    from octetra.petsc import from_plex, points_of, to_plex

    plex = to_plex(mesh)            # a petsc4py.PETSc.DMPlex, distributed as the mesh is
    back = from_plex(plex).mesh
"""

from typing import Any, NamedTuple, Optional

from numpy.typing import NDArray
from petsc4py import PETSc  # type: ignore[import]  # which starts PETSc

from . import Mesh, _petsc


class Points(NamedTuple):
    """The points of a plex of to_plex(): cells first, from 0, then vertices, faces and edges, each kind by
    the mesh's local numbers (of faces and edges, those of number_faces() and number_edges())."""

    first_vertex: int
    first_face: int
    first_edge: int
    end: int


class FromPlex(NamedTuple):
    """A mesh of a plex, and the points that its cells and vertices were: int32 (or int64, as PETSc's
    integers are) of shape (cells,) and (vertices,); -1 for a vertex that the plex does not have here."""

    mesh: Mesh
    cell_points: NDArray[Any]
    vertex_points: NDArray[Any]


def to_plex(mesh: Mesh, comm: Optional[Any] = None, *, cells: str = "Cell Sets",
            faces: str = "Face Sets", edges: str = "Edge Sets", boundary: str = "boundary") -> Any:
    """Collective. The mesh as a petsc4py.PETSc.DMPlex that is distributed in the same way, with faces and
    edges, coordinates, the point SF, and tags as labels of these names; boundary: that of faces behind which
    nothing is, with 1. An empty name leaves its label out.

    comm: an mpi4py communicator with the mesh's ranks in their order; None means all ranks. The plex is a
    picture of the mesh as it is. A cell's vertices are those of the mesh with the first two exchanged.
    """
    address = 0
    if comm is not None:
        from mpi4py import MPI
        address = MPI._addressof(comm)
    return _petsc.to_plex(mesh, address, cells, faces, edges, boundary)


def points_of(plex: Any) -> Points:
    """The points of this rank's part of a plex that to_plex() has made."""
    first_vertex, first_face = plex.getDepthStratum(0)
    first_edge, end = plex.getDepthStratum(1)
    return Points(first_vertex, first_face, first_edge, end)


def from_plex(plex: Any, *, cells: str = "Cell Sets", faces: str = "Face Sets",
              edges: str = "Edge Sets") -> FromPlex:
    """Collective. A mesh of a plex of tetrahedra, with labels of these names as tags. Cells stay where they
    are; those of an overlap count on the rank that owns them."""
    if not isinstance(plex, PETSc.DM):
        raise TypeError("plex: a DM of petsc4py")
    return FromPlex(*_petsc.from_plex(plex, cells, faces, edges))
