"""Functions of DOLFINx on refined meshes, parents of cells, and errors."""

import dolfinx_support as support
import numpy as np
import pytest
import ufl
from conftest import near, total, world
from dolfinx import fem
from dolfinx.mesh import CellType
from mpi4py import MPI

import octetra
import octetra.dolfinx as od


closures = pytest.mark.parametrize("closure", ["longest-edge", "regular"])


def refine(mesh, radius, closure):
    """A step with the regular closure completes the families at the border of the previous sphere, and bisects some
    of their cells again."""
    return mesh.refine(near(mesh, radius), closure=closure)


@closures
def test_a_function_goes_along_with_every_step(composite, closure):
    before = od.to_mesh(composite)
    u = support.function_on(support.lagrange(before.mesh), support.linear)
    v = support.function_on(support.lagrange(before.mesh), support.wave)
    for radius in (0.5, 0.6, 0.4):
        step = refine(composite, radius, closure)
        after = od.to_mesh(composite)
        old, u = u, od.carry(u, step, before, after)
        expected = support.function_on(support.lagrange(after.mesh), support.linear)
        assert np.allclose(u.x.array, expected.x.array, rtol=0, atol=1e-13)
        sums = support.integral(old * ufl.dx), support.integral(u * ufl.dx)
        assert sums[1] == pytest.approx(sums[0], rel=1e-12)
        kept = od.vertex_values(v, before)
        sums = [support.integral(v * v * ufl.dx)]
        v = od.carry(v, step, before, after)
        sums.append(support.integral(v * v * ufl.dx))
        assert sums[1] == pytest.approx(sums[0], rel=1e-12)
        assert np.array_equal(od.vertex_values(v, after), step.transfer_vertices(kept))
        before = after
    kept = od.vertex_values(v, before)
    step = composite.coarsen(near(composite, 0.3))
    assert step.changed
    after = od.to_mesh(composite)
    v = od.carry(v, step, before, after)
    assert np.array_equal(od.vertex_values(v, after), kept[step.vertices_before])


def quadratic(x):
    return np.stack([x[0] * x[1] - x[2] ** 2 + 1, x[1] * x[2] - 3 * x[0]])


@closures
def test_a_quadratic_function_is_the_same_on_the_refined_mesh(composite, closure):
    before = od.to_mesh(composite)
    u = support.function_on(support.lagrange(before.mesh, 2, 2), quadratic)
    v = support.function_on(support.lagrange(before.mesh, 2), support.wave)
    for radius, ghosts in ((0.5, "face"), (0.6, None), (0.4, "face")):
        step = refine(composite, radius, closure)
        after = od.to_mesh(composite, ghosts=ghosts)
        u = od.carry(u, step, before, after)
        expected = support.function_on(support.lagrange(after.mesh, 2, 2), quadratic)
        assert np.allclose(u.x.array, expected.x.array, rtol=0, atol=1e-13)
        sums = [support.integral(v * v * ufl.dx)]
        v = od.carry(v, step, before, after)
        sums.append(support.integral(v * v * ufl.dx))
        assert sums[1] == pytest.approx(sums[0], rel=1e-12)
        before = after
    other = od.carry(v, composite.refine(closure=closure), before, od.to_mesh(composite), None)
    assert other.function_space.mesh is not before.mesh
    step = composite.coarsen(np.ones(len(composite.cells), bool))
    with pytest.raises(octetra.InputError, match="coarsening"):
        od.carry(other, step, before, od.to_mesh(composite))


def values_of_vector(x):
    return np.stack([support.linear(x), x[1], x[2] ** 2])


def test_a_function_moves_with_cells_and_may_be_a_vector(composite):
    now = od.to_mesh(composite)
    u = support.function_on(support.lagrange(now.mesh, components=3), values_of_vector)
    values = od.vertex_values(u, now)
    assert values.shape == (len(composite.points), 3)
    assert np.allclose(values[:, 0], support.linear(composite.points.T), rtol=0, atol=1e-14)
    composite.refine(near(composite, 0.3))  # so that ranks are unbalanced
    composite.coarsen(np.ones(len(composite.cells), bool))
    move = composite.migrate((composite.roots * 3 % world.size).astype(np.int32))
    after = od.to_mesh(composite)
    moved = od.function(move.vertices(values), after)
    expected = support.function_on(moved.function_space, values_of_vector)
    assert np.allclose(moved.x.array, expected.x.array, rtol=0, atol=1e-14)


@closures
def test_children_lie_in_their_parents_and_their_facets_in_those_of_parents(composite, closure):
    refine(composite, 0.5, closure)
    before = od.to_mesh(composite)
    step = refine(composite, 0.6, closure)
    after = od.to_mesh(composite)
    cells, facets = od.parents(step, before, after)
    parent, child = support.corners(before.mesh)[cells], support.corners(after.mesh)[:support.owned(after.mesh)]
    edges = np.moveaxis(parent[:, 1:] - parent[:, :1], 1, 2)
    b = np.linalg.solve(edges[:, None], (child - parent[:, :1])[..., None])[..., 0]
    b = np.concatenate([1 - b.sum(axis=2, keepdims=True), b], axis=2)  # (cells, corner, of parent)
    assert b.min(initial=0) > -1e-9
    shares = octetra.quality.volume(composite)
    sums = np.bincount(cells, shares, minlength=support.owned(before.mesh))
    old = np.abs(np.linalg.det(support.corners(before.mesh)[:, 1:] - support.corners(before.mesh)[:, :1])) / 6
    assert np.allclose(sums, old[:len(sums)], rtol=1e-12)
    for facet in range(4):
        others = [k for k in range(4) if k != facet]
        on = (np.abs(b[:, others]) < 1e-9).all(axis=1)  # (cells, facet of parent)
        expected = np.where(on.any(axis=1), on.argmax(axis=1), -1)
        assert np.array_equal(facets[:, facet], expected)


@closures
def test_tags_that_dolfinx_carries_by_our_parents_are_those_that_we_hand_over(composite, closure):
    refine(composite, 0.5, closure)
    before = od.to_mesh(composite, ghosts=None)
    step = refine(composite, 0.6, closure)
    after = od.to_mesh(composite, ghosts=None)
    cells, facets = od.parents(step, before, after)
    tags = support.transferred(before.cell_tags, after.mesh, cells)
    assert np.array_equal(tags.indices, after.cell_tags.indices)
    assert np.array_equal(tags.values, after.cell_tags.values)
    for domain in (before.mesh, after.mesh):
        domain.topology.create_connectivity(2, 3)
        domain.topology.create_connectivity(3, 2)
    tags = support.transferred(before.facet_tags, after.mesh, cells, facets.ravel())
    assert np.array_equal(tags.indices, after.facet_tags.indices)
    assert np.array_equal(tags.values, after.facet_tags.values)


def test_parents_are_numbered_as_in_the_mesh_that_dolfinx_made():
    domain = support.box(world, support.spread)
    mesh, before = od.from_mesh(domain)
    step = mesh.refine(near(mesh, 0.6))
    after = od.to_mesh(mesh)
    cells, _ = od.parents(step, before, after)
    low, high = support.corners(domain).min(axis=1)[cells], support.corners(domain).max(axis=1)[cells]
    child = support.corners(after.mesh)[:support.owned(after.mesh)]
    assert (child >= low[:, None]).all() and (child <= high[:, None]).all()
    unchanged = np.bincount(cells, minlength=support.owned(domain)) == 1
    same = unchanged[cells]
    assert total(same.sum()) > 0
    assert np.array_equal(np.sort(child[same], axis=1), np.sort(support.corners(domain)[cells[same]], axis=1))


def test_dolfinx_solves_and_sees_jumps_on_the_mesh(composite):
    composite.refine(near(composite, 0.5))
    for ghosts in (None, "face"):
        now = od.to_mesh(composite, ghosts=ghosts)
        u, exact = support.solve(now.mesh)
        u.x.scatter_forward()
        assert np.abs(u.x.array - exact.x.array).max(initial=0) < 1e-9
    faces = np.concatenate([support.areas(composite.points[np.delete(composite.cells, k, axis=1)])
                            for k in range(4)])
    outside = support.integral(support.one(now.mesh) * ufl.ds)
    inside = support.integral(ufl.avg(support.one(now.mesh)) * ufl.dS)
    assert outside + 2 * inside == pytest.approx(total(faces.sum()), rel=1e-12)
    n = ufl.FacetNormal(now.mesh)
    jumps = support.integral(ufl.jump(ufl.grad(exact), n) ** 2 * ufl.dS)
    assert jumps == pytest.approx(0, abs=1e-20)
    rough = support.function_on(support.lagrange(now.mesh), support.wave)
    assert support.integral(ufl.jump(ufl.grad(rough), n) ** 2 * ufl.dS) > 1e-3


def test_what_is_wrong_is_raised_alike_on_all_ranks(composite):
    hexahedra = support.box(world, support.spread, cell_type=CellType.hexahedron)
    with pytest.raises(octetra.InputError, match="not tetrahedra"):
        od.from_mesh(hexahedra)
    with pytest.raises(octetra.InputError, match="'face', 'vertex' or None"):
        od.to_mesh(composite, ghosts="edge" if world.rank == 0 else "face")
    now = od.to_mesh(composite)
    with pytest.raises(octetra.InputError, match="are not of cells"):
        od.from_mesh(now.mesh, now.facet_tags)
    with pytest.raises(octetra.InputError, match="degree 1"):
        od.vertex_values(fem.Function(support.lagrange(now.mesh, 2)), now)
    last = world.rank == world.size - 1
    tags = support.tags_of(now.mesh, 2, [10**8 if last else 0], [1])
    with pytest.raises(octetra.InputError, match="no such facet"):
        od.from_mesh(now.mesh, None, tags)
    tags = support.tags_of(now.mesh, 3, [10**8 if last else 0], [1])
    with pytest.raises(octetra.InputError, match="no such cell"):
        od.from_mesh(now.mesh, tags)
    with pytest.raises(octetra.InputError, match="vertices are required"):
        od.function(np.ones(3 if last else len(composite.points)), now)
    other = od.to_mesh(octetra.from_arrays(composite.points, composite.cells, comm=MPI.COMM_SELF))
    with pytest.raises(octetra.InputError, match="not that of this handover"):
        od.vertex_values(od.function(np.ones(len(composite.points)), now), other)
    coarse = now
    step = composite.refine(np.ones(len(composite.cells), bool))
    with pytest.raises(octetra.InputError, match="did not transform"):
        od.parents(step, od.to_mesh(composite), coarse)
    step = composite.coarsen(np.ones(len(composite.cells), bool))
    with pytest.raises(octetra.InputError, match="coarsening"):
        od.parents(step, now, od.to_mesh(composite))
