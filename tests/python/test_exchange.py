"""Sharing of vertices, edges, faces and cells; marks by estimators; verdicts."""

import numpy as np
import pytest
from conftest import centroids, command, near, total, world

import octetra


@pytest.fixture
def fine(mesh):
    mesh.refine(near(mesh, 0.5))
    mesh.rebalance(most_over_mean=1.0)
    return mesh


def test_every_vertex_has_one_owner_and_sharers_agree(fine):
    sharing = fine.vertex_sharing
    assert total(int((sharing.owners == world.rank).sum())) == fine.vertex_count
    for rank in range(world.size):
        if rank != world.rank:
            mine = fine.vertex_numbers[sharing.with_rank.get(rank, [])]
            theirs = world.sendrecv(mine, dest=rank, source=rank)
            assert np.array_equal(mine, theirs)
    listed = {rank: set(of.tolist()) for rank, of in sharing.with_rank.items()}
    for vertex in range(len(fine.points)):
        sharers = [rank for rank in sorted(listed) if vertex in listed[rank]]
        assert sharing.sharers(vertex).tolist() == sharers
        assert (vertex in sharing.shared) == bool(sharers)


def test_copies_get_the_values_of_their_owner(fine):
    sharing = fine.vertex_sharing
    own = np.where(sharing.owners == world.rank, fine.vertex_numbers, 0)
    assert np.array_equal(sharing.update_copies(own), fine.vertex_numbers)
    names = np.array([f"rank {world.rank}"] * len(own))
    assert sharing.update_copies(names).tolist() == [f"rank {r}" for r in sharing.owners]


@pytest.mark.parametrize("kind", (np.float64, np.float32, np.int32, np.int64))
def test_values_are_combined_over_all_that_have_a_vertex(fine, kind):
    sharing = fine.vertex_sharing
    cells_at = np.bincount(fine.cells.ravel(), minlength=len(fine.points))
    sums = sharing.combine(np.stack([cells_at, 2 * cells_at], axis=1).astype(kind))
    assert sums.dtype == kind
    assert total(int(sums[sharing.owners == world.rank, 0].sum())) == 4 * fine.count_cells()
    assert np.array_equal(2 * sums[:, 0], sums[:, 1])
    rank = np.full(len(fine.points), world.rank, kind)
    for operation, choose in (("min", min), ("max", max)):
        expected = [choose(world.rank, *sharing.sharers(v).tolist()) if len(sharing.sharers(v))
                    else world.rank for v in range(len(rank))]
        assert sharing.combine(rank, operation).tolist() == expected


def test_booleans_are_true_on_all_that_have_a_vertex_where_they_are_on_one(fine):
    sharing = fine.vertex_sharing
    mine = np.zeros((len(fine.points), 2), bool)
    mine[:, 1] = sharing.owners == world.rank
    found = sharing.combine(mine, "or")
    assert found.dtype == bool and not found[:, 0].any() and found[:, 1].all()
    with pytest.raises(octetra.InputError, match="must be 'or' for booleans"):
        sharing.combine(mine)


def numbers_anywhere(mesh, vertices):
    """The global numbers of these vertices of all ranks."""
    return np.unique(np.concatenate(world.allgather(mesh.vertex_numbers[vertices])))


def test_sets_of_vertices_are_complete_on_all_ranks(fine):
    cells, opposite = fine.boundary()
    faces = [np.delete(fine.cells[c], f) for c, f in zip(cells, opposite)]
    own = np.unique(np.array(faces, int))
    found = fine.boundary_vertices()
    assert found.dtype == bool
    assert np.array_equal(found, np.isin(fine.vertex_numbers, numbers_anywhere(fine, own)))
    assert world.size == 1 or total(int(found.sum()) - len(own)) > 0
    marked = 0
    for marker in np.unique(np.concatenate(world.allgather(fine.facet_markers))):
        own = np.unique(fine.facets[fine.facet_markers == marker])
        found = fine.vertices_of(marker)
        assert np.array_equal(found, np.isin(fine.vertex_numbers, numbers_anywhere(fine, own)))
        marked += total(int(found.sum()))
    assert marked > 0
    assert not fine.vertices_of(12345).any() and not fine.vertices_of(1, dimension=1).any()
    with pytest.raises(octetra.InputError, match="the mesh has no named groups"):
        fine.vertices_of("wall")
    with pytest.raises(octetra.InputError, match="a dimension is one of 0, 1, 2 and 3, not 7"):
        fine.vertices_of(1, dimension=7)


def test_edges_and_faces_are_numbered_identically_on_all_ranks(fine):
    for sides, per_cell, corners in ((fine.number_edges(), 6, 2), (fine.number_faces(), 4, 3)):
        assert sides.vertices.shape == (len(sides.numbers), corners)
        assert sides.of_cells.shape == (len(fine.cells), per_cell)
        sharing = sides.sharing
        assert total(int((sharing.owners == world.rank).sum())) == sides.count
        assert np.array_equal(sharing.combine(sides.numbers.astype(np.int64), "max"), sides.numbers)
        ends = np.sort(fine.vertex_numbers[sides.vertices].astype(np.int64), axis=1)
        assert np.array_equal(sharing.update_copies(ends), ends)
        whole = set(map(tuple, np.sort(sides.vertices[sides.of_cells[:, 0]], axis=1).tolist()))
        first = fine.cells[:, :2] if corners == 2 else fine.cells[:, 1:]
        assert whole == set(map(tuple, np.sort(first, axis=1).tolist()))


def normals(mesh, faces):
    a, b, c = (mesh.points[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def test_boundary_faces_and_facets_are_oriented_outward(fine):
    cells, opposite = fine.boundary()
    faces = fine.boundary_faces()
    assert faces.dtype == np.int32 and faces.shape == (len(cells), 3)
    inward = fine.points[fine.cells[cells, opposite]] - fine.points[faces[:, 0]]
    assert np.all((normals(fine, faces) * inward).sum(axis=1) < 0)
    corners = octetra.cell_faces[opposite]
    assert np.array_equal(np.take_along_axis(fine.cells[cells], corners, axis=1), faces)
    flux = (normals(fine, faces) * fine.points[faces[:, 0]]).sum() / 2
    assert total(flux) == pytest.approx(3)  # three times the volume
    oriented = {tuple(np.sort(f)): f.tolist() for f in faces}
    for facet, listed in zip(fine.oriented_facets(), fine.facets):
        assert facet.tolist() == oriented[tuple(np.sort(listed))]  # all are on the boundary


def test_signs_of_faces_say_to_which_side_their_normals_point(fine):
    faces = fine.number_faces()
    assert faces.outward.dtype == np.int8
    for f in range(4):
        of_cell = faces.vertices[faces.of_cells[:, f]]
        inward = fine.points[fine.cells[:, f]] - fine.points[of_cell[:, 0]]
        leaves = -np.sign((normals(fine, of_cell) * inward).sum(axis=1))
        assert np.array_equal(leaves, faces.outward[:, f])
    both_sides = np.zeros(len(faces.vertices), np.int64)
    np.add.at(both_sides, faces.of_cells, faces.outward)  # the normal leaves one of the two cells
    both_sides = faces.sharing.combine(both_sides)
    own = faces.sharing.owners == world.rank
    assert total(int(np.abs(both_sides[own]).sum())) == total(len(fine.boundary_faces()))
    ends = fine.cells[:, octetra.cell_edges]
    edges = fine.number_edges()
    assert np.array_equal(np.sort(ends, axis=2), edges.vertices[edges.of_cells])


def test_what_a_rank_owns_is_numbered_consecutively(fine):
    edges, faces = fine.number_edges(), fine.number_faces()
    for sharing, names in ((fine.vertex_sharing, fine.vertex_numbers), (edges.sharing, edges.numbers),
                           (faces.sharing, faces.numbers)):
        index_map = sharing.index_map()
        begin, end = index_map.rank_begin[world.rank:world.rank + 2]
        assert index_map.rank_begin.dtype == index_map.numbers.dtype == np.int64
        assert len(index_map.rank_begin) == world.size + 1
        own = index_map.entities[:index_map.owned_count]
        assert np.array_equal(index_map.numbers[own], np.arange(begin, end))
        assert np.array_equal(np.flatnonzero(sharing.owners == world.rank), own)
        copies = index_map.entities[index_map.owned_count:]
        assert np.array_equal(sharing.owners[copies], index_map.copy_owners)
        pairs = np.unique(np.concatenate(world.allgather(
            np.stack([names, index_map.numbers], axis=1))), axis=0)
        assert np.array_equal(np.sort(pairs[:, 1]), np.arange(index_map.rank_begin[-1]))
    cells = fine.cell_index_map()
    assert cells.rank_begin[-1] == fine.count_cells() and cells.owned_count == len(fine.cells)
    files = np.concatenate(world.allgather(fine.cell_numbers()))
    assert np.array_equal(np.sort(files), np.arange(fine.count_cells()))


def test_neighbours_are_mutual_and_the_boundary_is_where_there_are_none(fine):
    ranks, cells = fine.face_neighbours()
    assert ranks.shape == cells.shape == (len(fine.cells), 4)
    on_boundary = sorted(map(tuple, np.argwhere(ranks == -1).tolist()))
    assert sorted(map(tuple, np.stack(fine.boundary(), axis=1).tolist())) == on_boundary
    links = world.allgather([(world.rank, c, int(ranks[c, f]), int(cells[c, f]))
                             for c, f in np.argwhere(ranks >= 0).tolist()])
    links = sorted(link for of_rank in links for link in of_rank)
    assert links == sorted((r2, c2, r1, c1) for r1, c1, r2, c2 in links)
    assert total(len(on_boundary)) == len(
        np.unique(np.concatenate(world.allgather(fine.vertex_numbers[np.concatenate(
            [np.delete(fine.cells[c], f)[None] for c, f in on_boundary] or [np.zeros((0, 3), int)]
        ).astype(int)])), axis=0))


@pytest.mark.parametrize("by", ("face", "vertex"))
def test_ghosts_are_the_cells_of_others_and_have_their_values(fine, by):
    ghosts = fine.ghosts(by)
    points = np.concatenate([fine.points, ghosts.points])
    middles = points[ghosts.cells].mean(axis=1)
    assert np.allclose(ghosts.values(centroids(fine)), middles)
    own = np.stack([np.full(len(fine.cells), world.rank), np.arange(len(fine.cells))], axis=1)
    assert np.array_equal(ghosts.values(own), np.stack([ghosts.owner_ranks, ghosts.owner_cells], 1))
    numbers = np.concatenate([fine.vertex_numbers, ghosts.vertex_numbers])
    assert len(np.unique(numbers)) == len(numbers)
    ranks, _ = fine.face_neighbours()
    across = int(((ranks >= 0) & (ranks != world.rank)).sum())
    assert len(ghosts.cells) <= across if by == "face" else len(ghosts.cells) >= across / 4


def test_the_marks_of_an_estimator_are_the_fewest_that_reach_the_share(fine):
    indicators = np.random.default_rng(world.rank).random(len(fine.cells))
    everyone = np.sort(np.concatenate(world.allgather(indicators)))[::-1]
    marks = octetra.mark.doerfler(fine, indicators, 0.3)
    assert marks.dtype == bool
    fewest = int(np.searchsorted(np.cumsum(everyone), 0.3 * everyone.sum())) + 1
    assert total(int(marks.sum())) == fewest
    assert indicators[marks].min(initial=1) >= everyone[fewest - 1]
    largest = octetra.mark.maximum(fine, indicators, 0.5)
    assert np.array_equal(largest, indicators >= 0.5 * everyone[0])
    part = octetra.mark.fraction(fine, indicators, 0.25)
    assert total(int(part.sum())) == -(-len(everyone) // 4)


def test_shapes_are_measured_as_the_command_does(folder, cube, fine):
    angles, eta = octetra.quality.dihedral_angles(fine), octetra.quality.mean_ratio(fine)
    found = octetra.quality.statistics(fine)
    assert angles.shape == (len(fine.cells), 6)
    assert world.allreduce(angles.max(), op=max) == found["dihedral_angle"][1]
    assert world.allreduce(eta.min(), op=min) == found["eta"][0]
    assert found["cells"] == fine.count_cells() and found["vertices"] == fine.vertex_count
    assert total(octetra.quality.volume(fine).sum()) == pytest.approx(1) == found["volume"]
    assert world.allgather(found) == [found] * world.size


def test_the_verifier_judges_the_mesh_alone_and_as_a_refinement(folder, cube, fine):
    assert fine.verify() and fine.verify(cube) and fine.verify(fast=True)
    assert fine.verify(cube).checks["cover"] == "passed"
    narrow = fine.verify(min_dihedral=60)
    assert not narrow.valid and narrow.counts["dihedral_too_small"] > 0
    other = folder / "other.mesh"
    command("generate", "kuhn", "3", "-o", other)
    assert not fine.verify(other)


def test_the_verifier_tells_the_regular_closure_from_the_other(cube):
    verdicts = {}
    for closure in ("regular", "longest-edge"):
        mesh = octetra.read(cube)
        for seed in range(3):
            mesh.refine(octetra.mark.random(mesh, 0.1, seed), closure=closure)
        assert mesh.verify(cube)
        verdicts[closure] = mesh.verify(cube, closure="regular")
    assert verdicts["regular"].checks["regular closure"] == "passed" and verdicts["regular"]
    assert verdicts["longest-edge"].checks["regular closure"] == "failed"
    assert verdicts["longest-edge"].counts["bisected_transition_cell"] > 0
