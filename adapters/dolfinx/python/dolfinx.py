"""Conversions between meshes of Octetra and DOLFINx.

    mesh, _ = octetra.dolfinx.from_mesh(domain)          # once
    now = octetra.dolfinx.to_mesh(mesh)                  # now.mesh is a dolfinx.mesh.Mesh
    step = mesh.refine(marks)                            # one for each cell of now.mesh
    finer = octetra.dolfinx.to_mesh(mesh)
    u = octetra.dolfinx.carry(u, step, now, finer)

Every rank converts its own part. Functions are collective if their docstring says so.
"""

import typing
from typing import Any, Optional, Tuple

import dolfinx.fem  # type: ignore[import]
import dolfinx.mesh  # type: ignore[import]
import numpy as np
import ufl  # type: ignore[import]
from mpi4py import MPI
from numpy.typing import ArrayLike, NDArray

from . import _dolfinx, _octetra

__all__ = ["NONE", "Handover", "carry", "from_mesh", "function", "parents", "to_mesh", "vertex_values"]

#: The entry in Handover.vertices of a node that belongs only to ghost cells.
NONE = np.int32(-1)


class Handover(typing.NamedTuple):
    """A DOLFINx mesh, with the cells and vertices of the octetra.Mesh, at the time of conversion, for its cells and nodes."""

    mesh: Any  #: the dolfinx.mesh.Mesh
    cell_tags: Any  #: its MeshTags of regions, including ghost cells; None if there are no regions
    facet_tags: Any  #: its MeshTags of facets, on all ranks that have a facet; None if there are none
    cells: NDArray[np.int32]  #: for each DOLFINx cell owned by this rank, the cell of octetra.Mesh
    vertices: NDArray[np.int32]  #: for each row of mesh.geometry.x, the vertex of octetra.Mesh, or NONE


def to_mesh(mesh: _octetra.Mesh, *, ghosts: Optional[str] = "face", tags: bool = True) -> Handover:
    """Collective. Converts the mesh for DOLFINx, on the same communicator.

    Every cell stays on its rank and keeps its number. `ghosts` selects the ghost cells of each rank: those
    with a common "face" or "vertex", or None. Integrals over interior facets require ghosts by faces, which
    DOLFINx's create_mesh also uses. Without `tags`, regions and tagged facets are not converted; tagged
    facets require that DOLFINx numbers all facets.
    """
    made, cell_tags, facet_tags, cells, vertices = _dolfinx.to_mesh(mesh, ghosts, tags)
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
    dolfinx_mesh = dolfinx.mesh.Mesh(made, domain)
    return Handover(dolfinx_mesh, _tags(dolfinx_mesh, 3, cell_tags),
                    _tags(dolfinx_mesh, 2, facet_tags), cells, vertices)


def from_mesh(mesh: Any, cell_tags: Any = None, facet_tags: Any = None) -> Tuple[_octetra.Mesh, Handover]:
    """Collective. Converts a DOLFINx mesh for Octetra, on the same communicator; returns the mesh and the
    correspondence of cells and vertices.

    The mesh must consist of affine tetrahedra. Every cell stays on its rank; inverted cells are reversed.
    Tags, dolfinx MeshTags of integers or None on all ranks, become region tags, 0 for cells without a tag,
    and tagged facets. Cells and vertices have the order in which they were passed to create_mesh(), if the
    mesh still has this information; output then does not depend on the number of ranks.
    """
    _check(mesh.comm, _fault_of_cell_tags(mesh, cell_tags))
    made, cells, vertices = _dolfinx.from_mesh(mesh._mesh, _arrays(cell_tags), _arrays(facet_tags))
    return made, Handover(mesh, cell_tags, facet_tags, cells, vertices)


def vertex_values(u: Any, handover: Handover) -> NDArray[Any]:
    """Collective. Returns the values of a function u, piecewise linear (Lagrange, degree 1) on handover.mesh, at
    the vertices of the octetra.Mesh: of shape (vertices,), or (vertices, k) for k components."""
    _check(handover.mesh.comm, _fault_of_space(u.function_space, handover))
    u.x.scatter_forward()
    nodes, has_vertex = _nodes(handover)
    size = u.function_space.dofmap.bs
    dofs = _dofs_of_nodes(u.function_space, handover)[nodes]
    values = u.x.array.reshape(-1, size)[dofs]
    made = np.empty_like(values)
    made[handover.vertices[has_vertex]] = values
    return made if size > 1 else made.ravel()


def function(values: ArrayLike, handover: Handover, space: Any = None) -> Any:
    """Collective. Returns the function with these values at the vertices of the octetra.Mesh, of shape (vertices,)
    or (vertices, k), in `space`, of degree 1 on handover.mesh, or in a new space."""
    values = np.asarray(values)
    nodes, has_vertex = _nodes(handover)
    fault = _fault_of_space(space, handover) if space is not None else ""
    if values.ndim not in (1, 2) or len(values) != len(nodes):
        fault = f"values for {len(nodes)} vertices are required, but these have the shape {values.shape}"
    _check(handover.mesh.comm, fault)
    if space is None:
        linear = ("Lagrange", 1)
        space = (dolfinx.fem.FunctionSpace(handover.mesh, linear) if values.ndim == 1 else
                 dolfinx.fem.VectorFunctionSpace(handover.mesh, linear, values.shape[1]))
    made = dolfinx.fem.Function(space)
    of_dofs = made.x.array.reshape(-1, space.dofmap.bs)
    of_nodes = values.reshape(len(values), space.dofmap.bs)[handover.vertices[has_vertex]]
    of_dofs[_dofs_of_nodes(space, handover)[nodes]] = of_nodes
    made.x.scatter_forward()
    return made


def carry(u: Any, step: _octetra.Adaptation, before: Handover, after: Handover, space: Any = None) -> Any:
    """Collective. Transfers a piecewise linear function on before.mesh to after.mesh, the mesh after the step. After
    refinement the function is the same; after coarsening it is the interpolant at the remaining vertices."""
    return function(step.transfer_vertices(vertex_values(u, before)), after, space)


def parents(step: _octetra.Adaptation, before: Handover,
            after: Handover) -> Tuple[NDArray[np.int32], NDArray[np.int8]]:
    """Returns, for a refinement step, the parent in before.mesh of each cell of after.mesh owned by this rank,
    (cells,), and for each facet of the cell the facet of the parent that contains it, 0 to 3, or -1, (cells, 4).
    Facet i is opposite corner i. DOLFINx's refinement returns the same information."""
    if step.is_coarser:
        raise _octetra.InputError("parents: the step must be a refinement, not a coarsening")
    if (step.vertex_count_before, len(step.cells.parents)) != (len(_nodes(before)[0]), len(after.cells)):
        raise _octetra.InputError("parents: the step did not transform the first mesh into the second")
    dolfinx_cell = np.empty(len(before.cells), np.int32)
    dolfinx_cell[before.cells] = np.arange(len(before.cells))
    cells = dolfinx_cell[step.cells.parents][after.cells]
    old = np.arange(step.vertex_count_before, dtype=np.int32)
    ends = np.concatenate([np.stack([old, old], axis=1), step.new_vertex_ends])
    child = ends[_corners(after)]
    parent = _corners(before)[cells]
    # For each corner of the child, the parent's corners that it is, or lies between.
    between = np.zeros((len(cells), 4, 4), bool)
    for end in range(2):
        between |= child[:, :, end, None] == parent[:, None, :]
    facets = np.full((len(cells), 4), -1, np.int8)
    for facet in range(4):
        misses = ~between[:, [k for k in range(4) if k != facet]].any(axis=1)
        facets[:, facet] = np.where(misses.any(axis=1), misses.argmax(axis=1), -1)
    return cells, facets


def _check(comm: Any, fault: str) -> None:
    """Collective. Raises the fault of the lowest rank with one on all ranks."""
    first = comm.allreduce(comm.size if fault == "" else comm.rank, MPI.MIN)
    if first < comm.size:
        raise _octetra.InputError(f"rank {first}: " + comm.bcast(fault, root=first))


def _fault_of_space(space: Any, handover: Handover) -> str:
    of_space, own = space.mesh.geometry.x, handover.mesh.geometry.x
    is_same = of_space.shape == own.shape and of_space.ctypes.data == own.ctypes.data
    return "" if is_same else "the function's mesh is not that of this handover"


def _fault_of_cell_tags(mesh: Any, tags: Any) -> str:
    if tags is None or tags.dim != 3 or len(tags.indices) == 0:
        return ""
    cells = mesh.topology.index_map(3)
    count, last = cells.size_local + cells.num_ghosts, tags.indices.max()
    return "" if last < count else f"tags of cells up to number {last}, but the mesh has {count}: no such cell"


def _tags(mesh: Any, dimension: int, arrays: Any) -> Any:
    return None if arrays is None else dolfinx.mesh.meshtags(mesh, dimension, *arrays)


def _arrays(tags: Any) -> Any:
    return None if tags is None else (tags.dim, tags.indices, tags.values)


def _nodes(handover: Handover) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Returns the rows of the geometry with a vertex of the octetra.Mesh: indices, and a boolean for each row."""
    has_vertex = handover.vertices != NONE
    return np.flatnonzero(has_vertex), has_vertex


def _corners(handover: Handover) -> NDArray[Any]:
    """Returns the vertices of octetra.Mesh of each cell owned by this rank, in DOLFINx's order."""
    nodes = handover.mesh.geometry.dofmap.array.reshape(-1, 4)[:len(handover.cells)]
    return handover.vertices[nodes]


def _dofs_of_nodes(space: Any, handover: Handover) -> NDArray[Any]:
    """Returns the dof, or block of dofs, at each row of the geometry."""
    element = space.ufl_element()
    if element.family() != "Lagrange" or element.degree() != 1:
        raise _octetra.InputError(f"a function in {element}, not in a Lagrange space of degree 1")
    nodes = handover.mesh.geometry.dofmap.array
    dofs = np.empty(len(handover.vertices), np.int32)
    dofs[nodes] = space.dofmap.list.array
    return dofs
