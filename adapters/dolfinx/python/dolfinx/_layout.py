"""Numbers, owners and points of the cells and vertices of an octetra.Mesh, as DOLFINx's index maps take them."""

import typing
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from .. import _octetra
from ._common import NONE


class Numbering(typing.NamedTuple):
    """Entities of a rank: its own first, then ghosts."""

    own_count: int
    ghosts: NDArray[np.int64]  #: numbers that the owners give to the ghosts
    owners: NDArray[np.int32]  #: ranks of these owners


class Layout(typing.NamedTuple):
    """A rank's part with its ghost cells. Node i of DOLFINx's geometry is vertex i of its topology."""

    nodes: Numbering
    vertices: NDArray[np.int32]  #: (nodes,): vertices of the octetra.Mesh, or NONE
    node_of_vertex: NDArray[np.int32]
    points: NDArray[np.float64]
    vertex_numbers: NDArray[np.int64]  #: (nodes,): numbers of vertices in files
    cells: Numbering
    corners: NDArray[np.int32]  #: (cells, 4): nodes, ghost cells last
    cell_numbers: NDArray[np.int64]  #: (cells,): numbers in the whole mesh
    regions: NDArray[np.int32]


def layout_of(mesh: _octetra.Mesh, ghosts: Optional[str]) -> Layout:
    """Collective."""
    made = _own_layout(mesh)
    return made if ghosts is None else _with_ghosts(mesh, made, mesh.ghosts(ghosts))


def _own_layout(mesh: _octetra.Mesh) -> Layout:
    vertices, cells = mesh.vertex_sharing.index_map(), mesh.cell_index_map()
    order, count = vertices.entities, vertices.owned_count
    node_of_vertex = np.empty(len(order), np.int32)
    node_of_vertex[order] = np.arange(len(order))
    nothing = np.empty(0, np.int64)
    return Layout(nodes=Numbering(count, vertices.numbers[order[count:]], vertices.copy_owners),
                  vertices=order, node_of_vertex=node_of_vertex,
                  points=mesh.points[order], vertex_numbers=mesh.vertex_numbers[order],
                  cells=Numbering(len(mesh.cells), nothing, nothing.astype(np.int32)),
                  corners=node_of_vertex[mesh.cells],
                  cell_numbers=cells.rank_begin[mesh.rank] + np.arange(len(mesh.cells)),
                  regions=mesh.regions)


def _with_ghosts(mesh: _octetra.Mesh, own: Layout, ghosts: _octetra.Ghosts) -> Layout:
    """Collective. Owners of ghost cells say which numbers the vertices have that only these cells have."""
    known, count = len(own.points), len(ghosts.points)
    numbers = ghosts.values(mesh.vertex_sharing.index_map().numbers[mesh.cells])
    owners = ghosts.values(mesh.vertex_sharing.owners[mesh.cells])
    is_new = ghosts.cells >= known
    new_numbers, new_owners = np.empty(count, np.int64), np.empty(count, np.int32)
    new_numbers[ghosts.cells[is_new] - known] = numbers[is_new]
    new_owners[ghosts.cells[is_new] - known] = owners[is_new]
    node_of_vertex = np.concatenate([own.node_of_vertex, np.arange(known, known + count, dtype=np.int32)])
    cells = mesh.cell_index_map().rank_begin[ghosts.owner_ranks] + ghosts.owner_cells
    nodes = own.nodes
    return own._replace(
        nodes=Numbering(nodes.own_count, _joined(nodes.ghosts, new_numbers), _joined(nodes.owners, new_owners)),
        vertices=_joined(own.vertices, np.full(count, NONE)),
        points=_joined(own.points, ghosts.points),
        vertex_numbers=_joined(own.vertex_numbers, ghosts.vertex_numbers),
        cells=Numbering(own.cells.own_count, cells, ghosts.owner_ranks),
        corners=_joined(own.corners, node_of_vertex[ghosts.cells]),
        cell_numbers=_joined(own.cell_numbers, cells),
        regions=_joined(own.regions, ghosts.regions))


def _joined(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    return np.concatenate([a, b])
