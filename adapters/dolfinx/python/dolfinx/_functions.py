"""Functions of DOLFINx on converted meshes, and parents of their cells."""

from typing import Any, Tuple

import basix  # type: ignore[import]
import dolfinx.fem  # type: ignore[import]
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _octetra
from . import _versions
from ._common import NONE, check
from ._handover import Handover


def vertex_values(u: Any, handover: Handover) -> NDArray[Any]:
    """Collective. Returns the values of a function u, piecewise linear (Lagrange, degree 1) on handover.mesh, at
    the vertices of the octetra.Mesh: of shape (vertices,), or (vertices, k) for k components."""
    check(handover.mesh.comm, _fault_of_space(u.function_space, handover))
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
    check(handover.mesh.comm, fault)
    if space is None:
        space = _versions.linear_space(handover.mesh, None if values.ndim == 1 else values.shape[1])
    made = dolfinx.fem.Function(space)
    of_dofs = made.x.array.reshape(-1, space.dofmap.bs)
    of_nodes = values.reshape(len(values), space.dofmap.bs)[handover.vertices[has_vertex]]
    of_dofs[_dofs_of_nodes(space, handover)[nodes]] = of_nodes
    made.x.scatter_forward()
    return made


def carry(u: Any, step: _octetra.Adaptation, before: Handover, after: Handover, space: Any = None) -> Any:
    """Collective. Transfers a function of continuous Lagrange elements, of degree 1 or 2, on before.mesh to
    after.mesh, the mesh after the step, in `space` or in a new space of the same elements.

    After refinement the function is the same. After coarsening a function of degree 1 is the interpolant at the
    remaining vertices; degree 2 is refused.
    """
    if _versions.lagrange_degree(u.function_space) == 2:
        return _carry_quadratic(u, step, before, after, space)
    return function(step.transfer_vertices(vertex_values(u, before)), after, space)


def parents(step: _octetra.Adaptation, before: Handover,
            after: Handover) -> Tuple[NDArray[np.int32], NDArray[np.int8]]:
    """Returns, for a refinement step, the parent in before.mesh of each cell of after.mesh owned by this rank,
    (cells,), and for each facet of the cell the facet of the parent that contains it, 0 to 3, or -1, (cells, 4).
    Facet i is opposite corner i. DOLFINx's refinement returns the same information."""
    cells, corners = _corners_in_parents(step, before, after)
    is_involved = corners > 0
    facets = np.full((len(cells), 4), -1, np.int8)
    for facet in range(4):
        misses = ~is_involved[:, [k for k in range(4) if k != facet]].any(axis=1)
        facets[:, facet] = np.where(misses.any(axis=1), misses.argmax(axis=1), -1)
    return cells, facets


def _corners_in_parents(step: _octetra.Adaptation, before: Handover,
                        after: Handover) -> Tuple[NDArray[np.int32], NDArray[Any]]:
    """Parents of cells, and the barycentric coordinates of each corner of a child in its parent: (cells, corner of
    the child, corner of the parent)."""
    if step.is_coarser:
        raise _octetra.InputError("parents: the step must be a refinement, not a coarsening")
    if (step.vertex_count_before, len(step.cells.parents)) != (len(_nodes(before)[0]), len(after.cells)):
        raise _octetra.InputError("parents: the step did not transform the first mesh into the second")
    dolfinx_cell = np.empty(len(before.cells), np.int32)
    dolfinx_cell[before.cells] = np.arange(len(before.cells))
    cells = dolfinx_cell[step.cells.parents][after.cells]
    now, ends = _vertices_after(step)
    return cells, _coordinates(_corners(after), ends, now[_corners(before)[cells]])


def _vertices_after(step: _octetra.Adaptation) -> Tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Returns the number after the step of each vertex before it, and the ends of the edge that each vertex after it
    halves, or twice the vertex itself."""
    old = step.vertices_before
    if len(old) == 0:
        old = np.arange(step.vertex_count_before + len(step.new_vertex_ends), dtype=np.int32)
        old[step.vertex_count_before:] = NONE
    is_new = old == NONE
    now = np.empty(step.vertex_count_before, np.int32)
    now[old[~is_new]] = np.flatnonzero(~is_new)
    ends = np.repeat(np.arange(len(old), dtype=np.int32)[:, None], 2, axis=1)
    ends[is_new] = step.new_vertex_ends
    return now, ends


def _coordinates(vertices: NDArray[Any], ends: NDArray[Any], parent: NDArray[Any]) -> NDArray[Any]:
    """Barycentric coordinates of vertices (cells, k) in the parent with corners (cells, 4): (cells, k, 4). A vertex
    that is not a corner is the mean of its ends, which have coordinates of their own if the cell was bisected again."""
    made = (vertices[:, :, None] == parent[:, None, :]).astype(float)
    is_made = ~made.any(axis=2)
    if not is_made.any():
        return made
    of_made = ends[vertices[is_made]]
    if (of_made[:, 0] == of_made[:, 1]).any():  # an old vertex that is no corner of the parent
        raise _octetra.InputError("parents: the step did not transform the first mesh into the second")
    made[is_made] = _coordinates(of_made, ends, parent[np.nonzero(is_made)[0]]).mean(axis=1)
    return made


def _carry_quadratic(u: Any, step: _octetra.Adaptation, before: Handover, after: Handover, space: Any) -> Any:
    """Collective. The barycentric coordinates of the nodes of a child in its parent are multiples of a power of two:
    the values there are exact up to rounding."""
    if step.is_coarser:
        raise _octetra.InputError("a function of degree 2, which coarsening does not carry")
    if space is None:
        space = _versions.same_space(u.function_space, after.mesh)
    fault = _fault_of_space(u.function_space, before) or _fault_of_space(space, after)
    if _versions.lagrange_degree(space) != 2:
        fault = "a function of degree 2 for a space of another degree"
    check(after.mesh.comm, fault)
    parent, corners = _corners_in_parents(step, before, after)
    u.x.scatter_forward()
    size = space.dofmap.bs
    old = u.x.array.reshape(-1, size)[_versions.dofs_of_cells(u.function_space)[parent]]
    made = dolfinx.fem.Function(space, dtype=u.x.array.dtype.type)
    of_dofs, dofs = made.x.array.reshape(-1, size), _versions.dofs_of_cells(space)[:len(parent)]
    is_same = (corners == np.eye(4)).all(axis=(1, 2))
    of_dofs[dofs[is_same]] = old[is_same]
    corners, old, dofs = corners[~is_same], old[~is_same], dofs[~is_same]
    edges = np.array(basix.topology(basix.CellType.tetrahedron)[1])
    nodes = np.concatenate([corners, corners[:, edges].mean(axis=2)], axis=1)
    for k in range(nodes.shape[1]):
        of_dofs[dofs[:, k]] = np.einsum("cd,cdi->ci", _quadratic_basis(nodes[:, k], edges), old)
    made.x.scatter_forward()
    return made


def _quadratic_basis(at: NDArray[Any], edges: NDArray[Any]) -> NDArray[Any]:
    """(points, 10): the basis of degree 2 at barycentric coordinates, (points, 4)."""
    return np.concatenate([at * (2 * at - 1), 4 * at[:, edges].prod(axis=2)], axis=1)


def _fault_of_space(space: Any, handover: Handover) -> str:
    of_space, own = space.mesh.geometry.x, handover.mesh.geometry.x
    is_same = of_space.shape == own.shape and of_space.ctypes.data == own.ctypes.data
    return "" if is_same else "the function's mesh is not that of this handover"


def _nodes(handover: Handover) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Returns the rows of the geometry with a vertex of the octetra.Mesh: indices, and a boolean for each row."""
    has_vertex = handover.vertices != NONE
    return np.flatnonzero(has_vertex), has_vertex


def _corners(handover: Handover) -> NDArray[Any]:
    """Returns the vertices of the octetra.Mesh of each cell owned by this rank, in DOLFINx's order."""
    nodes = _versions.nodes_of_cells(handover.mesh)[:len(handover.cells)]
    return handover.vertices[nodes]


def _dofs_of_nodes(space: Any, handover: Handover) -> NDArray[Any]:
    """Returns the dof, or block of dofs, at each row of the geometry."""
    if _versions.lagrange_degree(space) != 1:
        element = space.ufl_element()
        raise _octetra.InputError(f"a function in {element}, not in a Lagrange space of degree 1")
    dofs = np.empty(len(handover.vertices), np.int32)
    dofs[_versions.nodes_of_cells(handover.mesh)] = _versions.dofs_of_cells(space)
    return dofs
