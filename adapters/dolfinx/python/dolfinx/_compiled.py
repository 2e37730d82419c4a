"""Conversions by the compiled adapter, for DOLFINx 0.5."""

from typing import Any, Optional, Tuple

import dolfinx.mesh  # type: ignore[import]
import ufl  # type: ignore[import]

from .. import _dolfinx, _octetra  # type: ignore[attr-defined]


def to_mesh(mesh: _octetra.Mesh, ghosts: Optional[str], tags: bool) -> Tuple[Any, ...]:
    made, cell_tags, facet_tags, cells, vertices = _dolfinx.to_mesh(mesh, ghosts, tags)
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
    dolfinx_mesh = dolfinx.mesh.Mesh(made, domain)
    return (dolfinx_mesh, _tags(dolfinx_mesh, 3, cell_tags), _tags(dolfinx_mesh, 2, facet_tags),
            cells, vertices)


def from_mesh(mesh: Any, cell_tags: Any, facet_tags: Any) -> Tuple[Any, ...]:
    return _dolfinx.from_mesh(mesh._mesh, _arrays(cell_tags), _arrays(facet_tags))


def _tags(mesh: Any, dimension: int, arrays: Any) -> Any:
    return None if arrays is None else dolfinx.mesh.meshtags(mesh, dimension, *arrays)


def _arrays(tags: Any) -> Any:
    return None if tags is None else (tags.dim, tags.indices, tags.values)
