"""Conversions between meshes and DMPlex, the unstructured meshes of PETSc, and matrices between levels, with petsc4py.

    from octetra.petsc import from_plex, points_of, to_plex

    plex = to_plex(mesh)            # a petsc4py.PETSc.DMPlex with the distribution of the mesh
    back = from_plex(plex).mesh
    matrices = interpolations(mesh.levels())  # for PETSc's multigrid, PCMG
"""

from typing import Any, List, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc  # type: ignore[import]  # initialises PETSc

from . import Level, Mesh, _petsc


class Points(NamedTuple):
    """The points of a plex created by to_plex(): cells first, from 0, then vertices, faces and edges, each kind
    in the order of the mesh's local numbers (faces and edges as in number_faces() and number_edges())."""

    first_vertex: int
    first_face: int
    first_edge: int
    end: int


class FromPlex(NamedTuple):
    """A mesh created from a plex, and the plex points of its cells and vertices: int32 (or int64, as PETSc's
    integers) of shape (cells,) and (vertices,); -1 for a vertex that is not in this rank's plex."""

    mesh: Mesh
    cell_points: NDArray[Any]
    vertex_points: NDArray[Any]


def to_plex(mesh: Mesh, comm: Optional[Any] = None, *, cells: str = "Cell Sets",
            faces: str = "Face Sets", edges: str = "Edge Sets", boundary: str = "boundary") -> Any:
    """Collective. Converts the mesh into a petsc4py.PETSc.DMPlex with the same distribution, with faces and edges,
    coordinates, the point SF, and tags as labels with these names; boundary is the label, with value 1, of
    faces on the boundary. An empty name omits the label.

    comm: an mpi4py communicator with the mesh's ranks in the same order; None means all ranks. The plex is
    independent of later changes of the mesh. The vertices of a cell are those of the mesh with the first two
    exchanged.
    """
    address = 0
    if comm is not None:
        from mpi4py import MPI
        address = MPI._addressof(comm)
    return _petsc.to_plex(mesh, address, cells, faces, edges, boundary)


def points_of(plex: Any) -> Points:
    """Returns the points of this rank's part of a plex created by to_plex()."""
    first_vertex, first_face = plex.getDepthStratum(0)
    first_edge, end = plex.getDepthStratum(1)
    return Points(first_vertex, first_face, first_edge, end)


def from_plex(plex: Any, *, cells: str = "Cell Sets", faces: str = "Face Sets",
              edges: str = "Edge Sets") -> FromPlex:
    """Collective. Creates a mesh from a plex of tetrahedra, with labels of these names as tags. Cells stay on their
    ranks; cells of an overlap are taken on the rank that owns them."""
    if not isinstance(plex, PETSc.DM):  # type: ignore[attr-defined]
        raise TypeError("plex must be a DM of petsc4py")
    return FromPlex(*_petsc.from_plex(plex, cells, faces, edges))


def interpolations(levels: List[Level], comm: Optional[Any] = None) -> List[Any]:
    """Collective. Returns for each level but the last the petsc4py.PETSc.Mat that interpolates P1 values to the next
    level. Rows and columns are those of vectors in the order of the levels' vertex_sharing.index_map().

    comm: an mpi4py communicator with the mesh's ranks in the same order; None means all ranks.
    """
    owned = [level.vertex_sharing.index_map().owned_count for level in levels]
    matrices = []
    for k, level in enumerate(levels[:-1]):
        begin, columns, values = level.prolongation()
        rows = (begin.astype(PETSc.IntType), columns.astype(PETSc.IntType), values)  # type: ignore[attr-defined]
        sizes = ((owned[k + 1], None), (owned[k], None))
        matrices.append(PETSc.Mat().createAIJ(sizes, csr=rows, comm=comm))  # type: ignore[attr-defined]
    return matrices


def with_components(matrix: Any, components: int) -> Any:
    """Collective. Returns the petsc4py.PETSc.Mat that applies a matrix to each component of vectors in which all
    components of a row are together; the matrix itself for one component."""
    if components == 1:
        return matrix
    begin, columns, values = matrix.getValuesCSR()
    lengths = np.repeat(np.diff(begin), components)
    entry = np.repeat(np.repeat(begin[:-1], components), lengths) + _positions(lengths)
    component = np.repeat(np.tile(np.arange(components), len(begin) - 1), lengths)
    rows = (np.concatenate([[0], np.cumsum(lengths)]).astype(PETSc.IntType),  # type: ignore[attr-defined]
            (columns[entry] * components + component).astype(PETSc.IntType), values[entry])  # type: ignore[attr-defined]
    sizes = tuple((own * components, None) for own in matrix.getLocalSize())
    made = PETSc.Mat().create(matrix.comm)  # type: ignore[attr-defined]
    made.setSizes(sizes)
    made.setBlockSizes(components, components)
    made.setType("aij")
    made.setPreallocationCSR(rows)
    return made


def _positions(lengths: NDArray[Any]) -> NDArray[Any]:
    """0, 1, ... within each run of these lengths."""
    return np.arange(lengths.sum()) - np.repeat(np.cumsum(lengths) - lengths, lengths)
