"""Calls of DOLFINx that differ between its versions, and functions that several tests of the adapter use."""

import numpy as np
import pytest
from conftest import total, world

pytest.importorskip("dolfinx", reason="there is no dolfinx (Debian: python3-dolfinx-real)")
pytest.importorskip("octetra.dolfinx", reason="the adapter to DOLFINx is not built")

import dolfinx  # noqa: E402
import dolfinx.fem.petsc  # noqa: E402
import ufl  # noqa: E402
from dolfinx import cpp, fem  # noqa: E402
from dolfinx.mesh import CellType, GhostMode, create_box, create_mesh, meshtags  # noqa: E402
from petsc4py import PETSc  # noqa: E402

VERSION = tuple(int(word) for word in dolfinx.__version__.split(".")[:2])
IS_OLD = VERSION < (0, 9)  # 0.5

if IS_OLD:
    TETRAHEDRA = ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
else:
    import basix.ufl

    TETRAHEDRA = basix.ufl.element("Lagrange", "tetrahedron", 1, shape=(3,))


def lagrange(domain, degree=1, components=None):
    if not IS_OLD:
        shape = () if components is None else ((components,),)
        return fem.functionspace(domain, ("Lagrange", degree, *shape))
    if components is None:
        return fem.FunctionSpace(domain, ("Lagrange", degree))
    return fem.VectorFunctionSpace(domain, ("Lagrange", degree), components)


def nodes_of_cells(domain):
    if VERSION >= (0, 11):
        return domain.geometry.dofmaps[0]
    return domain.geometry.dofmap.array.reshape(-1, 4) if IS_OLD else domain.geometry.dofmap


def corners(domain):
    """(cells, 4, 3): of this rank's cells, ghosts behind them."""
    return domain.geometry.x[nodes_of_cells(domain)]


def owned(domain):
    return domain.topology.index_map(3).size_local


def has_numbered_facets(domain):
    try:
        return domain.topology.index_map(2) is not None
    except RuntimeError:
        return False


def facet_nodes(domain):
    """Rows of the geometry of each facet's vertices."""
    vertices = domain.topology.connectivity(3, 0).array
    node = np.empty(vertices.max(initial=-1) + 1, np.int64)
    node[vertices] = nodes_of_cells(domain).ravel()
    return node[domain.topology.connectivity(2, 0).array.reshape(-1, 3)]


def exterior_facets(domain):
    return (cpp.mesh if IS_OLD else dolfinx.mesh).exterior_facet_indices(domain.topology)


def by(rank_of_cell):
    """A partitioner: rank_of_cell(numbers) gives the rank of each of this rank's cells. DOLFINx 0.5 finds shared
    vertices by cells of neighbours, and requires the ranks of these also where no ghosts are wanted."""
    def old(comm, ranks, dimension, cells, ghosts):
        own = np.asarray(rank_of_cell(np.arange(cells.num_nodes)), np.int32)
        rank_of = np.concatenate(comm.allgather(own))
        graph = cpp.mesh.build_dual_graph(comm, cells, dimension)
        lists = [[rank, *sorted({*rank_of[graph.links(c)]} - {rank})] for c, rank in enumerate(own)]
        offsets = np.cumsum([0, *map(len, lists)], dtype=np.int32)
        return cpp.graph.AdjacencyList_int32(np.array(sum(lists, []), np.int32), offsets)

    def new(comm, ranks, kinds, cells):
        count = len(cells[0]) // cpp.mesh.cell_num_vertices(kinds[0])
        own = np.asarray(rank_of_cell(np.arange(count)), np.int32)
        return cpp.graph.AdjacencyList_int32(own, np.arange(count + 1, dtype=np.int32))

    return old if IS_OLD else new


def spread(numbers):
    """In no order that a partitioner would choose."""
    return numbers * 7 % 5 % world.size


def created(cells, points, rank_of_cell):
    """DOLFINx's mesh of these cells, without ghosts."""
    if IS_OLD:
        return create_mesh(world, cells, points, TETRAHEDRA, GhostMode.none, by(rank_of_cell))
    return create_mesh(world, cells=cells, x=points, e=TETRAHEDRA, partitioner=by(rank_of_cell))


def box(comm, rank_of_cell, n=4, cell_type=CellType.tetrahedron):
    """DOLFINx's mesh of a cube, without ghosts."""
    return create_box(comm, [np.zeros(3), np.ones(3)], [n, n, n], cell_type=cell_type, ghost_mode=GhostMode.none,
                      partitioner=by(rank_of_cell))


def tags_of(domain, dimension, indices, values):
    return meshtags(domain, dimension, np.array(indices, np.int32), np.array(values, np.int32))


def transferred(tags, domain, cells, facets=None):
    """The tags on a refined mesh, by DOLFINx's own transfer."""
    if not IS_OLD:
        return dolfinx.mesh.transfer_meshtag(tags, domain, cells, facets)
    if facets is None:
        return cpp.refinement.transfer_cell_meshtag(tags, domain._mesh, cells)
    return cpp.refinement.transfer_facet_meshtag(tags, domain._mesh, cells, facets)


def integral(expression):
    return total(fem.assemble_scalar(fem.form(expression)))


def one(domain):
    return fem.Constant(domain, 1.0)


def areas(triangles):
    a, b, c = np.moveaxis(triangles, 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def linear(x):
    return 2 * x[0] - 3 * x[1] + 0.5 * x[2] + 1


def wave(x):
    return np.sin(3 * x[0]) * x[1] + x[2]


def function_on(space, values):
    u = fem.Function(space)
    u.interpolate(values)
    return u


def solve(domain):
    """-laplace u = 0 with a linear function on the boundary."""
    space = lagrange(domain)
    exact = function_on(space, linear)
    domain.topology.create_connectivity(2, 3)
    fixed = fem.dirichletbc(exact, fem.locate_dofs_topological(space, 2, exterior_facets(domain)))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    a, right = ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, fem.Constant(domain, 0.0) * v * ufl.dx
    options = {"petsc_options": {"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-13, "ksp_atol": 1e-14}}
    if VERSION >= (0, 10):
        options["petsc_options_prefix"] = "solve_"
    return fem.petsc.LinearProblem(a, right, bcs=[fixed], **options).solve(), exact


def assembled(a, right):
    """The matrix and the vector of two forms."""
    matrix = fem.petsc.assemble_matrix(fem.form(a))
    matrix.assemble()
    vector = fem.petsc.assemble_vector(fem.form(right))
    vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    return matrix, vector
