"""Meshes from files and arrays, and their properties."""

import gc
import sys
from fractions import Fraction

import numpy as np
import pytest
from conftest import command, near, run_alone, total, world
from mpi4py import MPI

import octetra

ARRAYS = {"points": (np.float64, 3), "cells": (np.int32, 4), "facets": (np.int32, 3),
          "edges": (np.int32, 2), "vertex_numbers": (np.int64, None), "roots": (np.int64, None)}


def test_arrays_have_the_types_and_shapes_that_are_documented(mesh):
    for name, (kind, columns) in ARRAYS.items():
        array = getattr(mesh, name)
        assert array.dtype == kind, name
        assert array.shape[1:] == (() if columns is None else (columns,)), name
    assert total(len(mesh.cells)) == mesh.count_cells() == 384
    assert mesh.vertex_count == 125
    assert mesh.regions.shape == (0,)
    assert mesh.facet_markers.shape == (len(mesh.facets),)
    assert (mesh.rank, mesh.rank_count) == (world.rank, world.size)


def test_arrays_are_no_copies_and_cannot_be_written_to(mesh):
    for name in ARRAYS:
        array = getattr(mesh, name)
        same = getattr(mesh, name)
        assert array.ctypes.data == same.ctypes.data, name
        assert not array.flags.owndata, name
        with pytest.raises(ValueError):
            array[...] = 0
        with pytest.raises(ValueError):
            array.setflags(write=True)


def test_views_stay_as_they_are_when_the_mesh_moves_on_and_when_it_goes(mesh):
    seen = []

    def look():
        for name in ARRAYS:
            array = getattr(mesh, name)
            seen.append((name, array, array.copy()))

    for radius in (0.8, 0.3, 0.15, 0.1):
        look()
        mesh.refine(near(mesh, radius))
    mesh.refine(np.ones(len(mesh.cells), bool))
    look()
    mesh.coarsen(near(mesh, 0.5))
    look()
    mesh.rebalance(most_over_mean=1.0)
    look()
    del mesh
    gc.collect()
    np.ones(1_000_000)  # reuses released memory
    for name, array, copy in seen:
        assert np.array_equal(array, copy), name


def test_a_view_is_of_the_mesh_as_it_was_and_a_new_one_of_the_mesh_as_it_is(mesh):
    before = mesh.points
    step = mesh.refine(np.ones(len(mesh.cells), bool))
    assert len(before) == step.vertex_count_before < len(mesh.points)
    assert np.array_equal(before, mesh.points[:len(before)])
    ends = step.new_vertex_ends
    assert np.array_equal(mesh.points[len(before):],
                          (mesh.points[ends[:, 0]] + mesh.points[ends[:, 1]]) / 2)


def test_what_arrays_have_come_from_is_the_mesh_of_the_file(folder, cube):
    whole = octetra.read(cube, world)
    whole.write(folder / "whole.mesh")
    again = octetra.from_arrays(
        whole.points, whole.vertex_numbers[whole.cells], facets=whole.vertex_numbers[whole.facets],
        facet_markers=whole.facet_markers, vertex_numbers=whole.vertex_numbers,
        cell_numbers=whole.roots, index_base=1, comm=world)
    assert np.array_equal(again.cells, whole.cells)
    facets = [np.sort(m.vertex_numbers[m.facets], axis=1) for m in (whole, again)]
    assert np.array_equal(*facets)
    assert np.array_equal(again.facet_markers, whole.facet_markers)
    for m in (whole, again):
        m.refine(near(m, 0.4))
    assert np.array_equal(again.points, whole.points)
    assert again.verify()


def test_one_tetrahedron_is_made_of_lists(folder):
    mine = world.rank == 0
    mesh = octetra.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                               [[0, 1, 2, 3]] if mine else [], regions=[7] if mine else [],
                               point_attributes=[0, 1, 2, 3])
    mesh.refine([1] if mine else [])
    assert mesh.count_cells() == 8
    assert mesh.regions.tolist() == [7] * (8 if mine else 0)
    assert mesh.verify()


def exact_sign(corners):
    """Of the determinant of the three edges from the first corner, in fractions."""
    (a, b, c), (d, e, f), (g, h, i) = [[Fraction(x) - Fraction(y) for x, y in zip(corner, corners[0])]
                                       for corner in corners[1:].tolist()]
    volume = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return (volume > 0) - (volume < 0)


def test_orientations_are_exact_where_rounding_has_the_wrong_sign():
    random = np.random.default_rng(1)
    corners = random.random((400, 4, 3))
    corners[:, 3] = corners[:, :3].mean(axis=1)  # flat, but for rounding
    corners[::2, 3, 2] = np.nextafter(corners[::2, 3, 2], 2)
    expected = [exact_sign(cell) for cell in corners]
    cells = np.arange(1600).reshape(-1, 4)
    found = octetra.orientations(corners.reshape(-1, 3), cells)
    assert found.dtype == np.int8 and found.tolist() == expected
    assert (np.sign(np.linalg.det(corners[:, 1:] - corners[:, :1])) != expected).any()
    assert octetra.orientations(np.eye(4, 3), [[3, 0, 1, 2], [0, 3, 1, 2]]).tolist() == [1, -1]
    assert octetra.orientations(np.zeros((4, 3)), [[0, 1, 2, 3]]).tolist() == [0]
    with pytest.raises(octetra.InputError, match="no point 4"):
        octetra.orientations(np.zeros((4, 3)), [[0, 1, 2, 4]])


def test_a_mesh_tells_its_communicator_attributes_and_markers(folder):
    mine = world.rank == 0
    mesh = octetra.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                               [[0, 1, 2, 3]] if mine else [], point_markers=[5, 6, 7, 8],
                               point_attributes=[[0, 1], [1, 2], [2, 3], [3, 4]])
    mesh.refine([1] if mine else [])
    n = len(mesh.points)
    assert mesh.vertex_attributes.shape == (n, 2)
    assert np.allclose(mesh.vertex_attributes[:, 1], mesh.points @ [1, 2, 3] + 1 if n else [])
    assert mesh.vertex_markers().tolist() == ([5, 6, 7, 8] + 6 * [0])[:n]
    assert mesh.vertices_of(6, dimension=0).tolist() == [v == 1 for v in range(n)]
    assert MPI.Comm.Compare(mesh.comm, world) == MPI.CONGRUENT
    assert mesh.comm.allreduce(len(mesh.cells)) == 8
    alone = octetra.from_arrays(np.zeros((0, 3)), [], comm=MPI.COMM_SELF)
    assert (alone.comm.size, alone.vertex_attributes.shape) == (1, (0, 0))
    assert octetra.__version__.count(".") == 2


def test_the_communicator_says_which_ranks_have_a_mesh(cube):
    alone = octetra.read(cube, world.Split(world.rank))
    assert (alone.rank, alone.rank_count, len(alone.cells)) == (0, 1, 384)
    with pytest.raises(octetra.InputError):
        octetra.read(cube, comm=3)


WITHOUT_MPI4PY = """
import sys
sys.modules["mpi4py"] = None
import octetra
mesh = octetra.read(sys.argv[1])
mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 0.5))
mesh.write(sys.argv[2])
print(mesh.rank_count)
"""


@pytest.mark.skipif(world.size > 1, reason="starts processes")
@pytest.mark.parametrize("ranks", (None, 2))
def test_without_mpi4py_the_module_runs_mpi_itself(folder, cube, ranks, mpirun):
    words = [sys.executable, "-c", WITHOUT_MPI4PY, cube, folder / "fine.mesh"]
    if ranks is not None:
        words = [mpirun, ranks, *words]
    assert "".join(run_alone(*words).split()) == str(ranks or 1) * (ranks or 1)
    command("refine", cube, "--sphere", "0,0,0,0.5", "-o", folder / "expected.mesh")
    assert (folder / "fine.mesh").read_bytes() == (folder / "expected.mesh").read_bytes()
