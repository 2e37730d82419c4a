"""Conversion of an octetra.Mesh to a DOLFINx mesh in Python, for DOLFINx 0.9 and later."""

import importlib
from typing import Any, Optional, Tuple

import basix.ufl  # type: ignore[import]
import numpy as np
import ufl  # type: ignore[import]
from numpy.typing import NDArray

from .. import _octetra
from . import _versions
from ._common import check
from ._layout import Layout, layout_of

cpp = _versions.dolfinx.cpp
fem: Any = importlib.import_module("dolfinx.fem")
la: Any = importlib.import_module("dolfinx.la")
meshes: Any = importlib.import_module("dolfinx.mesh")

#: Added to the marker of a facet, so that no marker is 0. Sums of both are exact in float64.
_MARKED = 2.0**33


def to_mesh(mesh: _octetra.Mesh, ghosts: Optional[str], tags: bool) -> Tuple[Any, ...]:
    fault = "" if ghosts in (None, "face", "vertex") else "ghosts: 'face', 'vertex' or None"
    if 4 * len(mesh.cells) > np.iinfo(np.int32).max:
        fault = "a rank has more cells than DOLFINx can number, 536,870,911"
    check(mesh.comm, fault)
    layout = layout_of(mesh, ghosts if mesh.rank_count > 1 else None)
    made = _assembled(mesh.comm, layout)
    cell_tags = _cell_tags(mesh.comm, layout, made) if tags else None
    facet_tags = _facet_tags(mesh, layout, made) if tags else None
    return made, cell_tags, facet_tags, np.arange(len(mesh.cells), dtype=np.int32), layout.vertices


def _assembled(comm: Any, layout: Layout) -> Any:
    """Collective. DOLFINx's create_mesh() determines by communication which ranks share a vertex, and an order of
    cells; an octetra.Mesh has both."""
    element: Any = basix.ufl.element("Lagrange", "tetrahedron", 1, shape=(3,))
    coordinates = fem.coordinate_element(element.basix_element)
    nodes, cells = _versions.index_map(comm, *layout.nodes), _versions.index_map(comm, *layout.cells)
    topology = _versions.topology(comm, nodes, cells, layout.corners, layout.cell_numbers)
    geometry = cpp.mesh.Geometry_float64(nodes, layout.corners, coordinates._cpp_object, layout.points,
                                         layout.vertex_numbers)
    return meshes.Mesh(cpp.mesh.Mesh_float64(comm, topology, geometry), ufl.Mesh(element))


def _cell_tags(comm: Any, layout: Layout, made: Any) -> Any:
    """Collective. Regions of own cells and ghosts."""
    if comm.allreduce(len(layout.regions)) == 0:
        return None
    cells = np.arange(len(layout.regions), dtype=np.int32)
    return meshes.meshtags(made, 3, cells, layout.regions)


def _facet_tags(mesh: _octetra.Mesh, layout: Layout, made: Any) -> Any:
    """Collective. A facet is tagged on one rank, which tells the owner, which tells all ranks that have it."""
    if mesh.comm.allreduce(len(mesh.facets)) == 0:
        return None
    made.topology.create_entities(2)
    facets = made.topology.connectivity(2, 0).array.reshape(-1, 3)
    row = _equal_rows(facets, layout.node_of_vertex[mesh.facets], len(layout.points))
    markers = la.vector(made.topology.index_map(2), dtype=np.float64)
    markers.array[:] = 0
    markers.array[row >= 0] = _MARKED + mesh.facet_markers[row[row >= 0]]
    markers.scatter_reverse(la.InsertMode.add)
    markers.scatter_forward()
    tagged = np.flatnonzero(markers.array).astype(np.int32)
    values = (markers.array[tagged] - _MARKED).astype(np.int32)
    return meshes.meshtags(made, 2, tagged, values)


def _equal_rows(wanted: NDArray[Any], rows: NDArray[Any], count: int) -> NDArray[Any]:
    """The index into `rows` for each row of `wanted` with the same numbers below `count`, or -1."""
    is_in_rows = np.zeros(count, bool)
    is_in_rows[rows] = True
    candidates = np.flatnonzero(is_in_rows[wanted].all(axis=1))
    both = np.sort(np.concatenate([rows, wanted[candidates]]), axis=1)
    _, group = np.unique(both, axis=0, return_inverse=True)
    group = group.ravel()
    row_of_group = np.full(len(both), -1)
    row_of_group[group[:len(rows)]] = np.arange(len(rows))
    found = np.full(len(wanted), -1)
    found[candidates] = row_of_group[group[len(rows):]]
    return found
