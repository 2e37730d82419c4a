"""Conversion of a DOLFINx mesh to an octetra.Mesh in Python, for DOLFINx 0.9 and later."""

from typing import Any, Dict, Optional, Tuple

import dolfinx.mesh  # type: ignore[import]
import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from .. import _octetra
from . import _versions
from ._common import NONE, check


def from_mesh(mesh: Any, cell_tags: Any, facet_tags: Any) -> Tuple[Any, ...]:
    _check_kind(mesh, cell_tags, facet_tags)
    check(mesh.comm, _fault_of_tags(mesh, cell_tags, facet_tags))
    nodes = _oriented(mesh)
    vertex_numbers = _vertex_numbers(mesh)
    order, cell_numbers = _order_of_cells(mesh)
    tags: Dict[str, Any] = {}
    if cell_tags is not None:
        tags["regions"] = _regions(cell_tags, len(nodes))[order]
    if facet_tags is not None:
        tags["facets"], tags["facet_markers"] = _facets(mesh, facet_tags, vertex_numbers)
    made = _octetra.from_arrays(mesh.geometry.x, vertex_numbers[nodes[order]], vertex_numbers=vertex_numbers,
                                cell_numbers=cell_numbers, comm=mesh.comm, **tags)
    cells = np.empty(len(order), np.int32)
    cells[order] = np.arange(len(order))
    vertices = np.full(len(vertex_numbers), NONE)
    vertices[nodes[order]] = made.cells
    return made, cells, vertices


def _check_kind(mesh: Any, cell_tags: Any, facet_tags: Any) -> None:
    """Raises the errors that are the same on all ranks."""
    if mesh.topology.cell_type != dolfinx.mesh.CellType.tetrahedron:
        raise _octetra.InputError("the cells of the DOLFINx mesh are not tetrahedra")
    if _versions.degree_of_geometry(mesh) != 1 or mesh.geometry.dim != 3:
        raise _octetra.InputError("the cells of the DOLFINx mesh are not affine tetrahedra in space")
    if cell_tags is not None and cell_tags.dim != 3:
        raise _octetra.InputError("cell_tags are not of cells")
    if facet_tags is not None and facet_tags.dim != 2:
        raise _octetra.InputError("facet_tags are not of facets")
    if facet_tags is not None and not _versions.has_facets(mesh):
        raise _octetra.InputError("facet_tags: the DOLFINx mesh has no facets")


def _fault_of_tags(mesh: Any, cell_tags: Any, facet_tags: Any) -> str:
    if cell_tags is not None and cell_tags.indices.min(initial=0) < 0:
        return "cell_tags: a negative cell index"
    if facet_tags is not None and len(facet_tags.indices) > 0:
        facets = mesh.topology.connectivity(2, 0).num_nodes
        if facet_tags.indices.min() < 0 or facet_tags.indices.max() >= facets:
            return "facet_tags: no such facet"
    return ""


def _own_count(mesh: Any) -> int:
    return int(mesh.topology.index_map(3).size_local)


def _oriented(mesh: Any) -> NDArray[np.int32]:
    """(own cells, 4): nodes, the last two exchanged where the cell is inverted."""
    nodes = _versions.nodes_of_cells(mesh)[:_own_count(mesh)].copy()
    inverted = _octetra.orientations(mesh.geometry.x, nodes) < 0
    nodes[inverted, 2:] = nodes[inverted, :1:-1]
    return nodes


def _is_known(comm: Any, numbers: Optional[NDArray[np.int64]], count: int, total: int) -> bool:
    """Collective. Whether all ranks have numbers of an input for `count` entities, below the `total` of the mesh."""
    known = (numbers is not None and len(numbers) == count and
             numbers.min(initial=0) >= 0 and numbers.max(initial=0) < max(total, 1))
    return bool(comm.allreduce(int(known), MPI.MIN))


def _vertex_numbers(mesh: Any) -> NDArray[np.int64]:
    """Collective. (nodes,): numbers in the whole mesh, of the input if they are known."""
    vertices, count = mesh.topology.index_map(0), len(mesh.geometry.x)
    of_input = mesh.geometry.input_global_indices
    if _is_known(mesh.comm, of_input, count, vertices.size_global):
        return of_input  # type: ignore[no-any-return]
    of_vertices = vertices.local_to_global(np.arange(vertices.size_local + vertices.num_ghosts, dtype=np.int32))
    numbers = np.empty(count, np.int64)
    numbers[_node_of_vertex(mesh)] = of_vertices
    return numbers


def _order_of_cells(mesh: Any) -> Tuple[NDArray[Any], Optional[NDArray[np.int64]]]:
    """Collective. Returns own cells in the order of their numbers in the input, with these numbers; in DOLFINx's
    order, without numbers, if the input is unknown."""
    cells, numbers = mesh.topology.index_map(3), _versions.original_cells(mesh)
    own = None if numbers is None else numbers[:cells.size_local]
    if not _is_known(mesh.comm, own, cells.size_local, cells.size_global) or own is None:
        return np.arange(cells.size_local), None
    order = np.argsort(own)
    return order, own[order]


def _node_of_vertex(mesh: Any) -> NDArray[np.int32]:
    vertices = mesh.topology.index_map(0)
    nodes = np.empty(vertices.size_local + vertices.num_ghosts, np.int32)
    nodes[mesh.topology.connectivity(3, 0).array] = _versions.nodes_of_cells(mesh).ravel()
    return nodes


def _regions(tags: Any, count: int) -> NDArray[Any]:
    regions = np.zeros(count, tags.values.dtype)
    is_own = tags.indices < count
    regions[tags.indices[is_own]] = tags.values[is_own]
    return regions


def _facets(mesh: Any, tags: Any, vertex_numbers: NDArray[np.int64]) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Vertex numbers and markers of the tagged facets that an own cell has."""
    if len(tags.indices) == 0:
        return np.empty((0, 3), np.int64), np.empty(0, np.int32)
    vertices = mesh.topology.connectivity(2, 0).array.reshape(-1, 3)
    is_own = np.zeros(len(vertices), bool)
    is_own[mesh.topology.connectivity(3, 2).array.reshape(-1, 4)[:_own_count(mesh)]] = True
    taken = is_own[tags.indices]
    nodes = _node_of_vertex(mesh)[vertices[tags.indices[taken]]]
    return vertex_numbers[nodes], tags.values[taken]
