"""Matrices between the levels of a mesh, for spaces of DOLFINx."""

from typing import Any, List, Tuple

import numpy as np
from numpy.typing import NDArray

from .. import _octetra
from . import _versions
from ._common import check
from ._functions import _corners, _fault_of_space
from ._handover import Handover


def interpolations(levels: List[_octetra.Level], handover: Handover, space: Any) -> List[Any]:
    """Collective. Returns the petsc4py.PETSc.Mat that interpolate from each space to the next one: those of degree 1
    on all levels, and finally `space`, of continuous Lagrange elements of degree 1 or 2 on handover.mesh, the mesh of
    the last level. A space of degree 2 is one more level. Its rows are in the order of DOLFINx's vectors and matrices;
    those of other levels in that of their vertex_sharing.index_map(), with all components of a vertex together.
    """
    from .. import petsc  # requires petsc4py, which DOLFINx itself does not

    check(handover.mesh.comm, _fault(levels, handover, space))
    size = space.dofmap.bs
    matrices = [petsc.with_components(matrix, size) for matrix in petsc.interpolations(levels, handover.mesh.comm)]
    to_space = petsc.with_components(_to_space(levels[-1], handover, space), size)
    if _versions.lagrange_degree(space) == 2:
        return matrices + [to_space]
    return matrices[:-1] + [to_space.matMult(matrix) for matrix in matrices[-1:]]


def _fault(levels: List[_octetra.Level], handover: Handover, space: Any) -> str:
    if len(handover.cells) != len(levels[-1].cells):
        return (f"the last level has {len(levels[-1].cells)} cells on this rank, and the handover "
                f"{len(handover.cells)}")
    if _versions.lagrange_degree(space) not in (1, 2):
        return f"a space of {space.ufl_element()}, not of continuous Lagrange elements of degree 1 or 2"
    return _fault_of_space(space, handover)


def _to_space(level: _octetra.Level, handover: Handover, space: Any) -> Any:
    """Collective. The matrix from the values at the vertices of a level to the (blocks of) dofs of a space on it. The
    dof at a vertex has its value, and that at the middle of an edge the mean of the ends."""
    from petsc4py import PETSc  # type: ignore[import]

    columns, rows = level.vertex_sharing.index_map(), space.dofmap.index_map
    dofs, ends = _ends_of_dofs(handover, space, rows.size_local)
    is_complete = np.array_equal(dofs, np.arange(rows.size_local))
    check(handover.mesh.comm, "" if is_complete else "the rank owns dofs of ghost cells alone")
    numbers = columns.numbers[ends]
    is_middle = numbers[:, 0] != numbers[:, 1]
    begin = np.concatenate([[0], np.cumsum(1 + is_middle)])
    values = np.repeat(np.where(is_middle, 0.5, 1.0), 1 + is_middle)
    is_entry = np.column_stack([np.ones_like(is_middle), is_middle])
    csr = (begin.astype(PETSc.IntType), np.sort(numbers, axis=1)[is_entry].astype(PETSc.IntType), values)
    sizes = ((rows.size_local, None), (columns.owned_count, None))
    return PETSc.Mat().createAIJ(sizes, csr=csr, comm=handover.mesh.comm)


def _ends_of_dofs(handover: Handover, space: Any, own_count: int) -> Tuple[NDArray[Any], NDArray[Any]]:
    """The dofs that this rank owns, ascending, and for each the ends of its edge, or twice its vertex."""
    import basix  # type: ignore[import]

    corners = _corners(handover)
    at = np.column_stack([np.arange(4), np.arange(4)])
    if _versions.lagrange_degree(space) == 2:
        at = np.concatenate([at, basix.topology(basix.CellType.tetrahedron)[1]])
    dofs, first = np.unique(_versions.dofs_of_cells(space)[:len(corners)], return_index=True)
    ends = corners[:, at].reshape(-1, 2)[first]
    is_own = dofs < own_count
    return dofs[is_own], ends[is_own]
