"""Meshes of Octetra for DOLFINx, and meshes of DOLFINx for Octetra.

    mesh, _ = octetra.dolfinx.from_mesh(domain)          # once
    now = octetra.dolfinx.to_mesh(mesh)                  # now.mesh is a dolfinx.mesh.Mesh
    step = mesh.refine(marks)                            # one for each cell of now.mesh
    finer = octetra.dolfinx.to_mesh(mesh)
    u = octetra.dolfinx.carry(u, step, now, finer)

Every rank hands over its own part. Functions are collective where their docstring says so.
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

#: In Handover.vertices, of a node that only ghost cells have.
NONE = np.int32(-1)


class Handover(typing.NamedTuple):
    """A mesh of DOLFINx, and what its cells and nodes are in the octetra.Mesh, as that was at the time."""

    mesh: Any  #: the dolfinx.mesh.Mesh
    cell_tags: Any  #: its MeshTags of regions, of ghost cells, too; None where there are none
    facet_tags: Any  #: its MeshTags of facets, on all ranks that have a facet; None where there are none
    cells: NDArray[np.int32]  #: of each DOLFINx cell that this rank owns, the cell of octetra.Mesh
    vertices: NDArray[np.int32]  #: of each row of mesh.geometry.x the vertex of octetra.Mesh, or NONE


def to_mesh(mesh: _octetra.Mesh, *, ghosts: Optional[str] = "face", tags: bool = True) -> Handover:
    """Collective. The mesh for DOLFINx, on the same communicator.

    Every cell stays on its rank and keeps its number. `ghosts` are cells of other ranks that each rank has
    beside its own: those with a "face" or a "vertex" in common, or None; integrals over interior facets
    take those by faces, which is what DOLFINx's create_mesh makes, too. Without `tags` neither regions nor
    marked facets are handed over: marked facets make DOLFINx number all facets.
    """
    made, cell_tags, facet_tags, cells, vertices = _dolfinx.to_mesh(mesh, ghosts, tags)
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
    dolfinx_mesh = dolfinx.mesh.Mesh(made, domain)
    return Handover(dolfinx_mesh, _tags(dolfinx_mesh, 3, cell_tags),
                    _tags(dolfinx_mesh, 2, facet_tags), cells, vertices)


def from_mesh(mesh: Any, cell_tags: Any = None, facet_tags: Any = None) -> Tuple[_octetra.Mesh, Handover]:
    """Collective. A mesh of DOLFINx for Octetra, on the same communicator, and what is what.

    It is of affine tetrahedra; every cell stays on its rank, and inverted ones are turned round. Tags,
    dolfinx MeshTags of whole numbers or None on all ranks, become regions, 0 where a cell has none, and
    marked facets. The order of cells and vertices is that in which create_mesh() was given them, if the
    mesh still tells; so what is written does not depend on the number of ranks.
    """
    _check(mesh.comm, _fault_of_cell_tags(mesh, cell_tags))
    made, cells, vertices = _dolfinx.from_mesh(mesh._mesh, _arrays(cell_tags), _arrays(facet_tags))
    return made, Handover(mesh, cell_tags, facet_tags, cells, vertices)


def vertex_values(u: Any, handover: Handover) -> NDArray[Any]:
    """Collective. Of a function u, piecewise linear (Lagrange, degree 1) on handover.mesh, the values at the
    vertices of the octetra.Mesh: (vertices,), or (vertices, k) of one with k components."""
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
    """Collective. The function with these values at the vertices of the octetra.Mesh, of shape (vertices,) or
    (vertices, k): in `space`, of degree 1 on handover.mesh, or in a new one."""
    values = np.asarray(values)
    nodes, has_vertex = _nodes(handover)
    fault = _fault_of_space(space, handover) if space is not None else ""
    if values.ndim not in (1, 2) or len(values) != len(nodes):
        fault = f"values for {len(nodes)} vertices are wanted, and these have the shape {values.shape}"
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
    """Collective. A piecewise linear function on before.mesh as one on after.mesh, the mesh after the step: the
    same function after refinement; after coarsening, that with its values at the vertices that stay."""
    return function(step.transfer_vertices(vertex_values(u, before)), after, space)


def parents(step: _octetra.Adaptation, before: Handover,
            after: Handover) -> Tuple[NDArray[np.int32], NDArray[np.int8]]:
    """Of each cell of after.mesh that this rank owns, the cell of before.mesh that it is or was a piece of,
    (cells,); and of each of its facets the facet of that cell in which it lies, 0 to 3, or -1, (cells, 4).
    Facet i is opposite corner i. Of one step of refinement. This is what DOLFINx's refinement tells, too."""
    if step.is_coarser:
        raise _octetra.InputError("parents: of refinement, and this step was coarsening")
    if (step.vertex_count_before, len(step.cells.parents)) != (len(_nodes(before)[0]), len(after.cells)):
        raise _octetra.InputError("parents: the step did not lead from the one mesh to the other")
    dolfinx_cell = np.empty(len(before.cells), np.int32)
    dolfinx_cell[before.cells] = np.arange(len(before.cells))
    cells = dolfinx_cell[step.cells.parents][after.cells]
    old = np.arange(step.vertex_count_before, dtype=np.int32)
    ends = np.concatenate([np.stack([old, old], axis=1), step.new_vertex_ends])
    child = ends[_corners(after)]
    parent = _corners(before)[cells]
    # Which of the parent's corners each corner of the child is or lies between.
    between = np.zeros((len(cells), 4, 4), bool)
    for end in range(2):
        between |= child[:, :, end, None] == parent[:, None, :]
    facets = np.full((len(cells), 4), -1, np.int8)
    for facet in range(4):
        misses = ~between[:, [k for k in range(4) if k != facet]].any(axis=1)
        facets[:, facet] = np.where(misses.any(axis=1), misses.argmax(axis=1), -1)
    return cells, facets


def _check(comm: Any, fault: str) -> None:
    """Collective. Raises what is wrong on any rank, that of the lowest, on all."""
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
    return "" if last < count else f"tags of cells up to number {last}, and the mesh has {count}: no such cell"


def _tags(mesh: Any, dimension: int, arrays: Any) -> Any:
    return None if arrays is None else dolfinx.mesh.meshtags(mesh, dimension, *arrays)


def _arrays(tags: Any) -> Any:
    return None if tags is None else (tags.dim, tags.indices, tags.values)


def _nodes(handover: Handover) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Rows of the geometry that have a vertex of the octetra.Mesh: their numbers, and a boolean for each row."""
    has_vertex = handover.vertices != NONE
    return np.flatnonzero(has_vertex), has_vertex


def _corners(handover: Handover) -> NDArray[Any]:
    """The vertices of octetra.Mesh of each cell that this rank owns, as DOLFINx has them in order."""
    nodes = handover.mesh.geometry.dofmap.array.reshape(-1, 4)[:len(handover.cells)]
    return handover.vertices[nodes]


def _dofs_of_nodes(space: Any, handover: Handover) -> NDArray[Any]:
    """The dof, of blocks of dofs, at each row of the geometry."""
    element = space.ufl_element()
    if element.family() != "Lagrange" or element.degree() != 1:
        raise _octetra.InputError(f"a function in {element}, and not in a Lagrange space of degree 1")
    nodes = handover.mesh.geometry.dofmap.array
    dofs = np.empty(len(handover.vertices), np.int32)
    dofs[nodes] = space.dofmap.list.array
    return dofs
