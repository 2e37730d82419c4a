"""Meshes transferred to DOLFINx and back: cells, points, tags, functions, parents."""

import numpy as np
import pytest
from conftest import centroids, command, near, total, world

pytest.importorskip("dolfinx", reason="there is no dolfinx (Debian: python3-dolfinx-real)")
pytest.importorskip("octetra.dolfinx", reason="the adapter to DOLFINx is not built")

import ufl  # noqa: E402
from dolfinx import cpp, fem  # noqa: E402
from dolfinx.mesh import CellType, GhostMode, create_box, create_mesh  # noqa: E402
from mpi4py import MPI  # noqa: E402

import octetra  # noqa: E402
import octetra.dolfinx as od  # noqa: E402


@pytest.fixture
def composite(folder):
    """A mesh of two regions, with marked facets on its sides and between the regions."""
    command("generate", "two-material", "-o", folder / "composite.mesh")
    return octetra.read(folder / "composite.mesh")


def corners(domain):
    """(cells, 4, 3): corners of this rank's cells, followed by its ghosts."""
    return domain.geometry.x[domain.geometry.dofmap.array.reshape(-1, 4)]


def owned(domain):
    return domain.topology.index_map(3).size_local


def integral(expression):
    return total(fem.assemble_scalar(fem.form(expression)))


def one(domain):
    return fem.Constant(domain, 1.0)


def areas(triangles):
    a, b, c = np.moveaxis(triangles, 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def gathered(rows):
    """The rows of all ranks, sorted."""
    rows = np.concatenate(world.allgather(rows))
    return rows[np.lexsort(rows.T)]


TETRAHEDRA = ufl.VectorElement("Lagrange", "tetrahedron", 1)


def by(rank_of_cell):
    """A partitioner; rank_of_cell(numbers) returns the ranks of this rank's cells. DOLFINx 0.5
    finds shared entities through neighbouring cells, so each cell is also sent to the ranks of its
    neighbours, whether or not ghosts are requested."""
    def partition(comm, ranks, dimension, cells, ghosts):
        own = np.asarray(rank_of_cell(np.arange(cells.num_nodes)), np.int32)
        rank_of = np.concatenate(comm.allgather(own))
        graph = cpp.mesh.build_dual_graph(comm, cells, dimension)
        lists = [[rank, *sorted({*rank_of[graph.links(c)]} - {rank})] for c, rank in enumerate(own)]
        offsets = np.cumsum([0, *map(len, lists)], dtype=np.int32)
        return cpp.graph.AdjacencyList_int32(np.array(sum(lists, []), np.int32), offsets)

    return partition


def box(comm, rank_of_cell, n=4, **options):
    """DOLFINx's mesh of a cube."""
    return create_box(comm, [np.zeros(3), np.ones(3)], [n, n, n], ghost_mode=GhostMode.none,
                      partitioner=by(rank_of_cell), **options)


def spread(numbers):
    """Unlike the choice of any partitioner."""
    return numbers * 7 % 5 % world.size


def marked_facets(mesh):
    """The facets of all ranks: vertex numbers, ascending, and the marker."""
    facets = np.sort(mesh.vertex_numbers[mesh.facets].astype(np.int64), axis=1)
    return gathered(np.column_stack([facets, mesh.facet_markers]))


@pytest.mark.parametrize("ghosts", (None, "face", "vertex"))
def test_cells_and_points_are_those_of_the_mesh(composite, ghosts):
    composite.refine(near(composite, 0.5))
    now = od.to_mesh(composite, ghosts=ghosts)
    own = owned(now.mesh)
    assert own == len(composite.cells)
    assert np.array_equal(now.cells, np.arange(own))
    assert np.array_equal(corners(now.mesh)[:own], composite.points[composite.cells])
    at = now.vertices != od.NONE
    assert np.array_equal(now.mesh.geometry.x[at], composite.points[now.vertices[at]])
    assert np.array_equal(np.sort(now.vertices[at]), np.arange(len(composite.points)))
    assert np.array_equal(np.array(now.mesh.geometry.input_global_indices)[at],
                          composite.vertex_numbers[now.vertices[at]])
    cells, nodes = now.mesh.topology.index_map(3), now.mesh.topology.index_map(0)
    assert (cells.size_global, nodes.size_global) == (composite.count_cells(), composite.vertex_count)
    assert ghosts is not None or (cells.num_ghosts == 0 and at.all())
    assert nodes.size_local == (composite.vertex_sharing.owners == world.rank).sum()


@pytest.mark.parametrize("ghosts", ("face", "vertex"))
def test_ghosts_are_the_cells_that_their_ranks_have(composite, ghosts):
    now = od.to_mesh(composite, ghosts=ghosts)
    for dimension, here in ((3, corners(now.mesh).reshape(-1, 12)), (0, now.mesh.geometry.x)):
        numbers = now.mesh.topology.index_map(dimension)
        everything = np.concatenate(world.allgather(here[:numbers.size_local]))
        assert np.array_equal(here[numbers.size_local:], everything[numbers.ghosts])
        starts = np.array(world.allgather(numbers.local_range[0]))
        ranks = np.searchsorted(starts, numbers.ghosts, side="right") - 1
        assert (everything.shape[0], *numbers.owners) == (numbers.size_global, *ranks)
    theirs = composite.ghosts(ghosts)
    assert len(corners(now.mesh)) == len(composite.cells) + len(theirs.cells)
    assert world.size == 1 or total(len(theirs.cells)) > 0


def test_dolfinx_finds_as_many_edges_and_facets_as_in_a_mesh_of_its_own_making(composite):
    numbers, starts = composite.vertex_numbers, composite.vertex_sharing.owners
    points = np.zeros((composite.vertex_count, 3))
    points[numbers[starts == world.rank]] = composite.points[starts == world.rank]
    points = world.allreduce(points)  # create_mesh takes each from any rank, once
    points = points if world.rank == 0 else points[:0]
    theirs = create_mesh(world, numbers[composite.cells].astype(np.int64), points, ufl.Mesh(TETRAHEDRA),
                         GhostMode.none, by(lambda cells: np.full_like(cells, world.rank)))
    for ghosts in (None, "face", "vertex"):
        ours = od.to_mesh(composite, ghosts=ghosts).mesh
        for dimension in (1, 2):
            for domain in (theirs, ours):
                domain.topology.create_entities(dimension)
        for domain in (theirs, ours):
            domain.topology.create_connectivity(2, 3)
        for dimension in range(4):
            counts = [d.topology.index_map(dimension).size_global for d in (theirs, ours)]
            assert counts[0] == counts[1]
        outside = [total(len(cpp.mesh.exterior_facet_indices(d.topology))) for d in (theirs, ours)]
        assert outside[0] == outside[1] > 0


def test_regions_and_marked_facets_are_tags_of_cells_and_facets(composite):
    composite.refine(near(composite, 0.5))
    now = od.to_mesh(composite)
    own = owned(now.mesh)
    assert np.array_equal(now.cell_tags.indices, np.arange(len(corners(now.mesh))))
    assert np.array_equal(now.cell_tags.values[:own], composite.regions)
    ghost_regions = composite.ghosts("face").regions
    assert np.array_equal(now.cell_tags.values[own:], ghost_regions)
    volumes = octetra.quality.volume(composite)
    dx = ufl.Measure("dx", now.mesh, subdomain_data=now.cell_tags)
    for region in (1, 2):
        expected = total(volumes[composite.regions == region].sum())
        assert expected > 0.01
        assert integral(one(now.mesh) * dx(region)) == pytest.approx(expected, rel=1e-12)
    sizes = areas(composite.points[composite.facets])
    ds = ufl.Measure("ds", now.mesh, subdomain_data=now.facet_tags)
    dS = ufl.Measure("dS", now.mesh, subdomain_data=now.facet_tags)
    markers = np.unique(np.concatenate(world.allgather(composite.facet_markers)))
    assert len(markers) > 1
    c = one(now.mesh)
    for marker in map(int, markers):
        expected = total(sizes[composite.facet_markers == marker].sum())
        found = integral(c * ds(marker)) + integral(ufl.avg(c) * dS(marker))
        assert found == pytest.approx(expected, rel=1e-12), marker


def test_a_facet_is_tagged_on_every_rank_that_has_it(composite):
    for ghosts in (None, "face", "vertex"):
        now = od.to_mesh(composite, ghosts=ghosts)
        nodes = now.mesh.topology.connectivity(2, 0).array.reshape(-1, 3)
        numbers = np.sort(np.array(now.mesh.geometry.input_global_indices)[nodes], axis=1)
        markers = {tuple(row[:3]): row[3] for row in marked_facets(composite)}
        expected = np.array([markers.get(tuple(row), -99) for row in numbers])
        found = np.full(len(numbers), -99)
        found[now.facet_tags.indices] = now.facet_tags.values
        assert np.array_equal(found, expected)


def test_a_mesh_without_tags_has_none(mesh):
    whole = octetra.from_arrays(mesh.points, mesh.vertex_numbers[mesh.cells],
                                vertex_numbers=mesh.vertex_numbers)
    now = od.to_mesh(whole)
    assert now.cell_tags is None and now.facet_tags is None
    tagged = od.to_mesh(mesh, tags=False)
    assert tagged.facet_tags is None and tagged.mesh.topology.index_map(2) is None


@pytest.mark.parametrize("ghosts", (None, "face"))
def test_a_mesh_comes_back_with_its_cells_points_and_tags(composite, ghosts):
    composite.refine(near(composite, 0.5))
    now = od.to_mesh(composite, ghosts=ghosts)
    again, back = od.from_mesh(now.mesh, now.cell_tags, now.facet_tags)
    assert np.array_equal(again.points[again.cells], composite.points[composite.cells])
    assert np.array_equal(again.vertex_numbers, composite.vertex_numbers)
    assert np.array_equal(again.cells, composite.cells)
    assert np.array_equal(again.regions, composite.regions)
    assert np.array_equal(marked_facets(again), marked_facets(composite))
    assert np.array_equal(back.cells, now.cells)
    assert np.array_equal(back.vertices, now.vertices)


def test_cells_of_dolfinx_stay_on_their_ranks_and_are_turned_round_where_inverted(cube):
    whole = octetra.read(cube, MPI.COMM_SELF)
    cells = whole.cells.astype(np.int64)
    cells[::3, :2] = cells[::3, 1::-1]
    first = slice(None if world.rank == 0 else 0)
    domain = create_mesh(world, cells[first], whole.points[first], ufl.Mesh(TETRAHEDRA),
                         GhostMode.none, by(spread))
    mesh, handover = od.from_mesh(domain)
    assert len(mesh.cells) == owned(domain)
    ours = np.sort(mesh.points[mesh.cells[handover.cells]], axis=1)
    assert np.array_equal(ours, np.sort(corners(domain), axis=1))
    assert np.array_equal(mesh.points[handover.vertices], domain.geometry.x)
    assert (octetra.quality.volume(mesh) > 0).all()
    a, b, c, d = np.moveaxis(corners(domain), 1, 0)
    inverted = (np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0).sum()
    assert 0 < total(inverted) < mesh.count_cells()
    assert mesh.verify()


def test_tags_of_dolfinx_become_regions_and_marked_facets():
    domain = box(world, spread)
    own = owned(domain)
    middles = corners(domain).mean(axis=1)
    left = np.flatnonzero(middles[:, 0] < 0.5).astype(np.int32)
    cells = cpp_tags(domain, 3, left, np.full(len(left), 7, np.int32))
    domain.topology.create_entities(2)
    x = domain.geometry.x[facet_nodes(domain)]
    marker = np.where((x[:, :, 0] == 0).all(axis=1), 3, 0) + np.where((x[:, :, 1] == 1).all(axis=1), 5, 0)
    marked = np.flatnonzero(marker).astype(np.int32)
    facets = cpp_tags(domain, 2, marked, marker[marked].astype(np.int32))
    mesh, handover = od.from_mesh(domain, cells, facets)
    assert np.array_equal(mesh.regions[handover.cells], np.where(middles[:own, 0] < 0.5, 7, 0))
    sizes = areas(mesh.points[mesh.facets])
    for value in (3, 5):
        assert total(sizes[mesh.facet_markers == value].sum()) == pytest.approx(1)
    assert total(sizes.sum()) == pytest.approx(2)
    mesh.refine(near(mesh, 0.6))
    now = od.to_mesh(mesh)
    ds = ufl.Measure("ds", now.mesh, subdomain_data=now.facet_tags)
    assert integral(one(now.mesh) * ds(3)) == pytest.approx(1)
    assert np.array_equal(now.cell_tags.values[:owned(now.mesh)] == 7, centroids(mesh)[:, 0] < 0.5)


def facet_nodes(domain):
    """Rows in the geometry of the vertices of each facet."""
    vertices = domain.topology.connectivity(3, 0).array
    node = np.empty(vertices.max(initial=-1) + 1, np.int64)
    node[vertices] = domain.geometry.dofmap.array
    return node[domain.topology.connectivity(2, 0).array.reshape(-1, 3)]


def cpp_tags(domain, dimension, indices, values):
    from dolfinx.mesh import meshtags

    return meshtags(domain, dimension, indices, values)


def test_files_do_not_depend_on_the_ranks_of_the_dolfinx_mesh(folder):
    for comm, name in ((world, "spread.mesh"), (MPI.COMM_SELF, f"alone.{world.rank}.mesh")):
        there = spread if comm.size > 1 else np.zeros_like
        mesh, _ = od.from_mesh(box(comm, there))
        for radius in (0.7, 0.4):
            mesh.refine(near(mesh, radius))
        mesh.write(folder / name)
    world.Barrier()
    expected = (folder / "alone.0.mesh").read_bytes()
    assert (folder / "spread.mesh").read_bytes() == expected


def linear(x):
    return 2 * x[0] - 3 * x[1] + 0.5 * x[2] + 1


def wave(x):
    return np.sin(3 * x[0]) * x[1] + x[2]


def function_on(domain, values):
    u = fem.Function(fem.FunctionSpace(domain, ("Lagrange", 1)))
    u.interpolate(values)
    return u


def test_a_function_goes_along_with_every_step(composite):
    before = od.to_mesh(composite)
    u, v = function_on(before.mesh, linear), function_on(before.mesh, wave)
    for radius in (0.8, 0.5):
        step = composite.refine(near(composite, radius))
        after = od.to_mesh(composite)
        old, u = u, od.carry(u, step, before, after)
        assert np.allclose(u.x.array, function_on(after.mesh, linear).x.array, rtol=0, atol=1e-13)
        sums = integral(old * ufl.dx), integral(u * ufl.dx)
        assert sums[1] == pytest.approx(sums[0], rel=1e-12)
        kept = od.vertex_values(v, before)
        sums = [integral(v * v * ufl.dx)]
        v = od.carry(v, step, before, after)
        sums.append(integral(v * v * ufl.dx))
        assert sums[1] == pytest.approx(sums[0], rel=1e-12)
        assert np.array_equal(od.vertex_values(v, after), step.transfer_vertices(kept))
        before = after
    kept = od.vertex_values(v, before)
    step = composite.coarsen(near(composite, 0.3))
    assert step.changed
    after = od.to_mesh(composite)
    v = od.carry(v, step, before, after)
    assert np.array_equal(od.vertex_values(v, after), kept[step.vertices_before])


def test_a_function_moves_with_cells_and_may_be_a_vector(composite):
    now = od.to_mesh(composite)
    u = fem.Function(fem.VectorFunctionSpace(now.mesh, ("Lagrange", 1)))
    u.interpolate(lambda x: np.stack([linear(x), x[1], x[2] ** 2]))
    values = od.vertex_values(u, now)
    assert values.shape == (len(composite.points), 3)
    assert np.allclose(values[:, 0], linear(composite.points.T), rtol=0, atol=1e-14)
    composite.refine(near(composite, 0.3))  # so that ranks are unbalanced
    composite.coarsen(np.ones(len(composite.cells), bool))
    move = composite.migrate((composite.roots * 3 % world.size).astype(np.int32))
    after = od.to_mesh(composite)
    moved = od.function(move.vertices(values), after)
    expected = fem.Function(moved.function_space)
    expected.interpolate(lambda x: np.stack([linear(x), x[1], x[2] ** 2]))
    assert np.allclose(moved.x.array, expected.x.array, rtol=0, atol=1e-14)


def test_children_lie_in_their_parents_and_their_facets_in_those_of_parents(composite):
    before = od.to_mesh(composite)
    step = composite.refine(near(composite, 0.6))
    after = od.to_mesh(composite)
    cells, facets = od.parents(step, before, after)
    parent, child = corners(before.mesh)[cells], corners(after.mesh)[:owned(after.mesh)]
    edges = np.moveaxis(parent[:, 1:] - parent[:, :1], 1, 2)
    b = np.linalg.solve(edges[:, None], (child - parent[:, :1])[..., None])[..., 0]
    b = np.concatenate([1 - b.sum(axis=2, keepdims=True), b], axis=2)  # (cells, corner, of parent)
    assert b.min(initial=0) > -1e-9
    shares = octetra.quality.volume(composite)
    sums = np.bincount(cells, shares, minlength=owned(before.mesh))
    old = np.abs(np.linalg.det(corners(before.mesh)[:, 1:] - corners(before.mesh)[:, :1])) / 6
    assert np.allclose(sums, old[:len(sums)], rtol=1e-12)
    for facet in range(4):
        others = [k for k in range(4) if k != facet]
        on = (np.abs(b[:, others]) < 1e-9).all(axis=1)  # (cells, facet of parent)
        expected = np.where(on.any(axis=1), on.argmax(axis=1), -1)
        assert np.array_equal(facets[:, facet], expected)


def test_tags_that_dolfinx_carries_by_our_parents_are_those_that_we_hand_over(composite):
    before = od.to_mesh(composite, ghosts=None)
    step = composite.refine(near(composite, 0.6))
    after = od.to_mesh(composite, ghosts=None)
    cells, facets = od.parents(step, before, after)
    tags = cpp.refinement.transfer_cell_meshtag(before.cell_tags, after.mesh._mesh, cells)
    assert np.array_equal(tags.indices, after.cell_tags.indices)
    assert np.array_equal(tags.values, after.cell_tags.values)
    for domain in (before.mesh, after.mesh):
        domain.topology.create_connectivity(2, 3)
        domain.topology.create_connectivity(3, 2)
    tags = cpp.refinement.transfer_facet_meshtag(before.facet_tags, after.mesh._mesh, cells,
                                                 facets.ravel())
    assert np.array_equal(tags.indices, after.facet_tags.indices)
    assert np.array_equal(tags.values, after.facet_tags.values)


def test_parents_are_numbered_as_in_the_mesh_that_dolfinx_made():
    domain = box(world, spread)
    mesh, before = od.from_mesh(domain)
    step = mesh.refine(near(mesh, 0.6))
    after = od.to_mesh(mesh)
    cells, _ = od.parents(step, before, after)
    low, high = corners(domain).min(axis=1)[cells], corners(domain).max(axis=1)[cells]
    child = corners(after.mesh)[:owned(after.mesh)]
    assert (child >= low[:, None]).all() and (child <= high[:, None]).all()
    unchanged = np.bincount(cells, minlength=owned(domain)) == 1
    same = unchanged[cells]
    assert total(same.sum()) > 0
    assert np.array_equal(np.sort(child[same], axis=1), np.sort(corners(domain)[cells[same]], axis=1))


def solve(domain):
    """Solves -laplace u = 0 with a linear function on the boundary."""
    space = fem.FunctionSpace(domain, ("Lagrange", 1))
    exact = fem.Function(space)
    exact.interpolate(linear)
    domain.topology.create_connectivity(2, 3)
    facets = cpp.mesh.exterior_facet_indices(domain.topology)
    fixed = fem.dirichletbc(exact, fem.locate_dofs_topological(space, 2, facets))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    a, right = ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, fem.Constant(domain, 0.0) * v * ufl.dx
    options = {"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-13, "ksp_atol": 1e-14}
    return fem.petsc.LinearProblem(a, right, [fixed], petsc_options=options).solve(), exact


def test_dolfinx_solves_and_sees_jumps_on_the_mesh(composite):
    import dolfinx.fem.petsc  # noqa: F401

    composite.refine(near(composite, 0.5))
    for ghosts in (None, "face"):
        now = od.to_mesh(composite, ghosts=ghosts)
        u, exact = solve(now.mesh)
        u.x.scatter_forward()
        assert np.abs(u.x.array - exact.x.array).max(initial=0) < 1e-9
    faces = np.concatenate([areas(composite.points[np.delete(composite.cells, k, axis=1)])
                            for k in range(4)])
    outside = integral(one(now.mesh) * ufl.ds)
    inside = integral(ufl.avg(one(now.mesh)) * ufl.dS)
    assert outside + 2 * inside == pytest.approx(total(faces.sum()), rel=1e-12)
    n = ufl.FacetNormal(now.mesh)
    jumps = integral(ufl.jump(ufl.grad(exact), n) ** 2 * ufl.dS)
    assert jumps == pytest.approx(0, abs=1e-20)
    assert integral(ufl.jump(ufl.grad(function_on(now.mesh, wave)), n) ** 2 * ufl.dS) > 1e-3


def test_a_rank_may_be_without_cells():
    mine = world.rank == world.size - 1
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    mesh = octetra.from_arrays(points, [[0, 1, 2, 3]] if mine else [], regions=[7] if mine else [])
    for ghosts in (None, "face"):
        mesh.refine(np.ones(len(mesh.cells), bool))
        now = od.to_mesh(mesh, ghosts=ghosts)
        assert integral(one(now.mesh) * ufl.dx) == pytest.approx(1 / 6)
        again, _ = od.from_mesh(now.mesh, now.cell_tags)
        assert np.array_equal(again.regions, mesh.regions)


def test_what_is_wrong_is_raised_alike_on_all_ranks(composite):
    hexahedra = box(world, spread, cell_type=CellType.hexahedron)
    with pytest.raises(octetra.InputError, match="not tetrahedra"):
        od.from_mesh(hexahedra)
    with pytest.raises(octetra.InputError, match="'face', 'vertex' or None"):
        od.to_mesh(composite, ghosts="edge" if world.rank == 0 else "face")
    now = od.to_mesh(composite)
    with pytest.raises(octetra.InputError, match="are not of cells"):
        od.from_mesh(now.mesh, now.facet_tags)
    with pytest.raises(octetra.InputError, match="degree 1"):
        od.vertex_values(fem.Function(fem.FunctionSpace(now.mesh, ("Lagrange", 2))), now)
    last = world.rank == world.size - 1
    tags = cpp_tags(now.mesh, 2, np.array([10**8 if last else 0], np.int32), np.array([1], np.int32))
    with pytest.raises(octetra.InputError, match="no such facet"):
        od.from_mesh(now.mesh, None, tags)
    tags = cpp_tags(now.mesh, 3, np.array([10**8 if last else 0], np.int32), np.array([1], np.int32))
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
