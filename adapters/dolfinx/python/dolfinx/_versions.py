"""The versions of DOLFINx, and their differences."""

import importlib
import importlib.util
import re
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

dolfinx: Any = importlib.import_module("dolfinx")  # whose types are those of one version
#: The first two numbers of the version that Python finds.
VERSION = tuple(map(int, re.findall(r"\d+", dolfinx.__version__)[:2]))
IS_COMPILED_FOR = VERSION == (0, 5)


def check_version() -> None:
    """Raises ImportError for a version that is not supported."""
    supported = "supported are 0.9, 0.10 and 0.11, and 0.5.2 by a compiled adapter"
    found = f"octetra.dolfinx: DOLFINx {dolfinx.__version__} is installed"
    if IS_COMPILED_FOR:
        if importlib.util.find_spec("octetra._dolfinx") is None:
            raise ImportError(f"{found}, and Octetra was built without the adapter for it; {supported}")
    elif not (0, 9) <= VERSION <= (0, 11):
        raise ImportError(f"{found}; {supported}")


def nodes_of_cells(mesh: Any) -> NDArray[np.int32]:
    """(cells, 4): rows of mesh.geometry.x, ghost cells last."""
    if VERSION >= (0, 11):
        return mesh.geometry.dofmaps[0]  # type: ignore[no-any-return]
    nodes = mesh.geometry.dofmap
    return nodes.array.reshape(-1, 4) if IS_COMPILED_FOR else nodes  # type: ignore[no-any-return]


def degree_of_geometry(mesh: Any) -> int:
    element = mesh.geometry.cmaps[0] if VERSION >= (0, 11) else mesh.geometry.cmap
    return int(element.degree)


def dofs_of_cells(space: Any) -> NDArray[np.int32]:
    """(cells, dofs of a cell): blocks of dofs, ghost cells last."""
    dofs = space.dofmap.list
    if IS_COMPILED_FOR:
        return dofs.array.reshape(-1, space.dofmap.dof_layout.num_dofs)  # type: ignore[no-any-return]
    return dofs  # type: ignore[no-any-return]


def lagrange_degree(space: Any) -> int:
    """The degree of a space of continuous Lagrange elements; 0 for other spaces."""
    element = space.ufl_element()
    if IS_COMPILED_FOR:
        return int(element.degree()) if element.family() == "Lagrange" else 0
    import basix  # type: ignore[import]

    try:
        element = element.basix_element
    except (AttributeError, NotImplementedError):  # a mixed element, or one of quadrature points
        return 0
    is_lagrange = element.family == basix.ElementFamily.P and not element.discontinuous
    return int(element.degree) if is_lagrange else 0


def linear_space(mesh: Any, components: Optional[int]) -> Any:
    """The Lagrange space of degree 1, scalar where components is None."""
    fem = importlib.import_module("dolfinx.fem")
    if IS_COMPILED_FOR:
        linear = ("Lagrange", 1)
        return (fem.FunctionSpace(mesh, linear) if components is None else
                fem.VectorFunctionSpace(mesh, linear, components))
    return fem.functionspace(mesh, ("Lagrange", 1) if components is None else ("Lagrange", 1, (components,)))


def same_space(space: Any, mesh: Any) -> Any:
    """The space of the same elements on another mesh."""
    fem = importlib.import_module("dolfinx.fem")
    make = fem.FunctionSpace if IS_COMPILED_FOR else fem.functionspace
    return make(mesh, space.ufl_element())


def index_map(comm: Any, own_count: int, ghosts: NDArray[np.int64], owners: NDArray[np.int32]) -> Any:
    """Collective. From 0.9 on."""
    maps = dolfinx.cpp.common.IndexMap
    if comm.size == 1:
        return maps(comm, own_count)
    tag = () if VERSION < (0, 10) else (1,)
    return maps(comm, own_count, ghosts, owners, *tag)


def topology(comm: Any, vertex_map: Any, cell_map: Any, cells: NDArray[np.int32],
             cell_numbers: NDArray[np.int64]) -> Any:
    """Collective. From 0.9 on."""
    lists = dolfinx.cpp.graph.AdjacencyList_int32
    tetrahedron = dolfinx.cpp.mesh.CellType.tetrahedron
    if VERSION >= (0, 10):
        return dolfinx.cpp.mesh.Topology(tetrahedron, vertex_map, cell_map, lists(cells), cell_numbers)
    # In 0.9 create_topology() alone sets original_cell_index, which transfer_meshtag() reads without a check. A
    # topology without cells takes the numbers, and then the cells.
    made = dolfinx.cpp.mesh.create_topology(comm, [tetrahedron], [[]], [cell_numbers.tolist()], [[]], [])
    made.set_index_map(0, vertex_map)
    made.set_index_map(3, cell_map)
    vertices = np.arange(vertex_map.size_local + vertex_map.num_ghosts, dtype=np.int32)
    made.set_connectivity(lists(vertices.reshape(-1, 1)), 0, 0)
    made.set_connectivity(lists(cells), 3, 0)
    return made


def has_facets(mesh: Any) -> bool:
    """From 0.9 on, where connectivity() raises if there are none."""
    try:
        mesh.topology.connectivity(2, 0)
    except RuntimeError:
        return False
    return True


def original_cells(mesh: Any) -> Optional[NDArray[np.int64]]:
    """The numbers that cells had when the mesh was created, or None. From 0.9 on."""
    try:
        return mesh.topology.original_cell_index  # type: ignore[no-any-return]
    except RuntimeError:
        return None
