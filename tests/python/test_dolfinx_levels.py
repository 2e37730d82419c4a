"""Matrices between the levels of a mesh, for spaces of DOLFINx."""

import dolfinx_support as support
import numpy as np
import pytest
import ufl
from conftest import near, world
from petsc4py import PETSc

import octetra
import octetra.dolfinx as od


@pytest.fixture
def refined(composite):
    for radius in (0.9, 0.6, 0.4):
        composite.refine(near(composite, radius))
    composite.rebalance(most_over_mean=1.0)
    return composite


def vector_on(level, values):
    """The values (vertices, components) that this rank owns, in the order of the index map."""
    numbers = level.vertex_sharing.index_map()
    own = np.ascontiguousarray(values[numbers.entities[:numbers.owned_count]], float)
    return PETSc.Vec().createWithArray(own.ravel(), (own.size, None))


def own_values(u):
    space = u.function_space
    return u.x.array[:space.dofmap.index_map.size_local * space.dofmap.bs]


def pair(x):
    return np.stack([support.linear(x), x[0] - x[2]])


@pytest.mark.parametrize("components", (None, 2))
@pytest.mark.parametrize("degree", (1, 2))
def test_a_linear_function_of_the_input_is_the_same_in_the_space(refined, degree, components):
    levels, now = refined.levels(), od.to_mesh(refined)
    space = support.lagrange(now.mesh, degree, components)
    function = support.linear if components is None else pair
    matrices = od.interpolations(levels, now, space)
    assert len(matrices) == len(levels) + degree - 2 and len(levels) > 2
    u = vector_on(levels[0], np.atleast_2d(function(levels[0].points.T)).T)
    for matrix in matrices:
        u = matrix * u
    expected = support.function_on(space, function)
    assert np.allclose(u.array, own_values(expected), rtol=0, atol=1e-13)


@pytest.mark.parametrize("degree", (1, 2))
def test_multigrid_on_the_levels_takes_few_iterations(refined, degree):
    now = od.to_mesh(refined)
    space = support.lagrange(now.mesh, degree)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    matrix, right = support.assembled(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx + u * v * ufl.dx, v * ufl.dx)
    solver = PETSc.KSP().create(world)
    solver.setType("cg")
    solver.setTolerances(rtol=1e-8)
    solver.setOperators(matrix)
    mg = solver.getPC()
    mg.setType("mg")
    matrices = od.interpolations(refined.levels(), now, space)
    mg.setMGLevels(len(matrices) + 1)
    for k, interpolation in reversed(list(enumerate(matrices, start=1))):
        mg.setMGInterpolation(k, interpolation)
        mg.getMGSmoother(k).setOperators(matrix)
        mg.getMGSmoother(k).getPC().setType("jacobi")
        matrix = matrix.ptap(interpolation)
    mg.getMGCoarseSolve().setOperators(matrix)
    solution = right.duplicate()
    solver.solve(right, solution)
    assert solver.getConvergedReason() > 0 and solver.getIterationNumber() <= 15
    assert np.allclose(solution.array, 1, rtol=0, atol=1e-5)  # -div grad u + u = 1


def test_levels_of_another_mesh_and_other_spaces_are_refused_on_all_ranks(refined):
    levels, now = refined.levels(), od.to_mesh(refined)
    with pytest.raises(octetra.InputError, match="not of continuous Lagrange elements of degree 1 or 2"):
        od.interpolations(levels, now, support.lagrange(now.mesh, 3))
    with pytest.raises(octetra.InputError, match="cells on this rank, and the handover"):
        od.interpolations(levels[:1], now, support.lagrange(now.mesh))
    with pytest.raises(octetra.InputError, match="not that of this handover"):
        od.interpolations(levels, now, support.lagrange(od.to_mesh(refined).mesh))
