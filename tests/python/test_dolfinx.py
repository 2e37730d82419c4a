"""Meshes transferred to DOLFINx and back: cells, points, tags, ghosts."""

import dolfinx_support as support
import numpy as np
import pytest
import ufl
from conftest import centroids, near, total, world
from mpi4py import MPI

import octetra
import octetra.dolfinx as od


def marked_facets(mesh):
    """The facets of all ranks: vertex numbers, ascending, and the marker."""
    facets = np.sort(mesh.vertex_numbers[mesh.facets].astype(np.int64), axis=1)
    return gathered(np.column_stack([facets, mesh.facet_markers]))


def gathered(rows):
    """All ranks' rows in one order."""
    rows = np.concatenate(world.allgather(rows))
    return rows[np.lexsort(rows.T)]


@pytest.mark.parametrize("ghosts", (None, "face", "vertex"))
def test_cells_and_points_are_those_of_the_mesh(composite, ghosts):
    composite.refine(near(composite, 0.5))
    now = od.to_mesh(composite, ghosts=ghosts)
    own = support.owned(now.mesh)
    assert own == len(composite.cells)
    assert np.array_equal(now.cells, np.arange(own))
    assert np.array_equal(support.corners(now.mesh)[:own], composite.points[composite.cells])
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
    for dimension, here in ((3, support.corners(now.mesh).reshape(-1, 12)), (0, now.mesh.geometry.x)):
        numbers = now.mesh.topology.index_map(dimension)
        everything = np.concatenate(world.allgather(here[:numbers.size_local]))
        assert np.array_equal(here[numbers.size_local:], everything[numbers.ghosts])
        starts = np.array(world.allgather(numbers.local_range[0]))
        ranks = np.searchsorted(starts, numbers.ghosts, side="right") - 1
        assert (everything.shape[0], *numbers.owners) == (numbers.size_global, *ranks)
    theirs = composite.ghosts(ghosts)
    assert len(support.corners(now.mesh)) == len(composite.cells) + len(theirs.cells)
    assert world.size == 1 or total(len(theirs.cells)) > 0


def test_dolfinx_finds_as_many_edges_and_facets_as_in_a_mesh_of_its_own_making(composite):
    numbers, owners = composite.vertex_numbers, composite.vertex_sharing.owners
    points = np.zeros((composite.vertex_count, 3))
    points[numbers[owners == world.rank]] = composite.points[owners == world.rank]
    points = world.allreduce(points)  # create_mesh takes each from any rank, once
    points = points if world.rank == 0 else points[:0]
    theirs = support.created(numbers[composite.cells], points, lambda cells: np.full_like(cells, world.rank))
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
        outside = [total(len(support.exterior_facets(d))) for d in (theirs, ours)]
        assert outside[0] == outside[1] > 0


def test_regions_and_marked_facets_are_tags_of_cells_and_facets(composite):
    composite.refine(near(composite, 0.5))
    now = od.to_mesh(composite)
    own = support.owned(now.mesh)
    assert np.array_equal(now.cell_tags.indices, np.arange(len(support.corners(now.mesh))))
    assert np.array_equal(now.cell_tags.values[:own], composite.regions)
    ghost_regions = composite.ghosts("face").regions
    assert np.array_equal(now.cell_tags.values[own:], ghost_regions)
    volumes = octetra.quality.volume(composite)
    dx = ufl.Measure("dx", now.mesh, subdomain_data=now.cell_tags)
    for region in (1, 2):
        expected = total(volumes[composite.regions == region].sum())
        assert expected > 0.01
        assert support.integral(support.one(now.mesh) * dx(region)) == pytest.approx(expected, rel=1e-12)
    sizes = support.areas(composite.points[composite.facets])
    ds = ufl.Measure("ds", now.mesh, subdomain_data=now.facet_tags)
    dS = ufl.Measure("dS", now.mesh, subdomain_data=now.facet_tags)
    markers = np.unique(np.concatenate(world.allgather(composite.facet_markers)))
    assert len(markers) > 1
    c = support.one(now.mesh)
    for marker in map(int, markers):
        expected = total(sizes[composite.facet_markers == marker].sum())
        found = support.integral(c * ds(marker)) + support.integral(ufl.avg(c) * dS(marker))
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
    assert tagged.facet_tags is None and not support.has_numbered_facets(tagged.mesh)


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
    domain = support.created(cells[first], whole.points[first], support.spread)
    mesh, handover = od.from_mesh(domain)
    assert len(mesh.cells) == support.owned(domain)
    ours = np.sort(mesh.points[mesh.cells[handover.cells]], axis=1)
    assert np.array_equal(ours, np.sort(support.corners(domain), axis=1))
    assert np.array_equal(mesh.points[handover.vertices], domain.geometry.x)
    assert (octetra.quality.volume(mesh) > 0).all()
    a, b, c, d = np.moveaxis(support.corners(domain), 1, 0)
    inverted = (np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0).sum()
    assert 0 < total(inverted) < mesh.count_cells()
    assert mesh.verify()


def test_tags_of_dolfinx_become_regions_and_marked_facets():
    domain = support.box(world, support.spread)
    own = support.owned(domain)
    middles = support.corners(domain).mean(axis=1)
    left = np.flatnonzero(middles[:, 0] < 0.5)
    cells = support.tags_of(domain, 3, left, np.full(len(left), 7))
    domain.topology.create_entities(2)
    x = domain.geometry.x[support.facet_nodes(domain)]
    marker = np.where((x[:, :, 0] == 0).all(axis=1), 3, 0) + np.where((x[:, :, 1] == 1).all(axis=1), 5, 0)
    marked = np.flatnonzero(marker)
    facets = support.tags_of(domain, 2, marked, marker[marked])
    mesh, handover = od.from_mesh(domain, cells, facets)
    assert np.array_equal(mesh.regions[handover.cells], np.where(middles[:own, 0] < 0.5, 7, 0))
    sizes = support.areas(mesh.points[mesh.facets])
    for value in (3, 5):
        assert total(sizes[mesh.facet_markers == value].sum()) == pytest.approx(1)
    assert total(sizes.sum()) == pytest.approx(2)
    mesh.refine(near(mesh, 0.6))
    now = od.to_mesh(mesh)
    ds = ufl.Measure("ds", now.mesh, subdomain_data=now.facet_tags)
    assert support.integral(support.one(now.mesh) * ds(3)) == pytest.approx(1)
    assert np.array_equal(now.cell_tags.values[:support.owned(now.mesh)] == 7, centroids(mesh)[:, 0] < 0.5)


def test_files_do_not_depend_on_the_ranks_of_the_dolfinx_mesh(folder):
    for comm, name in ((world, "spread.mesh"), (MPI.COMM_SELF, f"alone.{world.rank}.mesh")):
        there = support.spread if comm.size > 1 else np.zeros_like
        mesh, _ = od.from_mesh(support.box(comm, there))
        for radius in (0.7, 0.4):
            mesh.refine(near(mesh, radius))
        mesh.write(folder / name)
    world.Barrier()
    expected = (folder / "alone.0.mesh").read_bytes()
    assert (folder / "spread.mesh").read_bytes() == expected


def test_a_rank_may_be_without_cells():
    mine = world.rank == world.size - 1
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    mesh = octetra.from_arrays(points, [[0, 1, 2, 3]] if mine else [], regions=[7] if mine else [])
    for ghosts in (None, "face"):
        mesh.refine(np.ones(len(mesh.cells), bool))
        now = od.to_mesh(mesh, ghosts=ghosts)
        assert support.integral(support.one(now.mesh) * ufl.dx) == pytest.approx(1 / 6)
        again, _ = od.from_mesh(now.mesh, now.cell_tags)
        assert np.array_equal(again.regions, mesh.regions)
