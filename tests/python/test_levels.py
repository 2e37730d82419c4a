"""Mesh.levels(): nested meshes and the transfer of values between them."""

import importlib
import pathlib

import numpy as np
import pytest
from conftest import near, total, world

import octetra


@pytest.fixture(params=["longest-edge", "regular"])
def levels(mesh, request):
    for share in (0.9, 0.6, 0.4):
        mesh.refine(near(mesh, share), closure=request.param)
    mesh.rebalance(most_over_mean=1.0)
    return mesh.levels()


def test_levels_are_nested_prefixes_that_grow(mesh, levels):
    assert levels[0].step == 0 and levels[-1].vertex_count == mesh.vertex_count
    assert np.array_equal(levels[-1].points, mesh.points)
    assert np.array_equal(levels[-1].cells, mesh.cells)
    for coarse, fine in zip(levels, levels[1:]):
        n = len(coarse.points)
        assert np.array_equal(fine.points[:n], coarse.points)
        assert np.array_equal(fine.vertex_numbers[:n], coarse.vertex_numbers)
        assert np.array_equal(fine.vertex_sharing.owners[:n], coarse.vertex_sharing.owners)
        assert coarse is levels[0] or fine.vertex_count >= 1.7 * coarse.vertex_count


def test_levels_stay_when_the_mesh_goes_on(mesh, levels):
    points, cells = np.array(levels[1].points), np.array(levels[1].cells)
    mesh.coarsen(np.ones(len(mesh.cells), bool))
    assert np.array_equal(levels[1].points, points) and np.array_equal(levels[1].cells, cells)


def volumes(level):
    corners = level.points[level.cells]
    return np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6


def test_parents_contain_their_children(levels):
    for coarse, fine in zip(levels, levels[1:]):
        parents, halvings = fine.parents()
        share = 0.5 ** halvings
        assert np.allclose(volumes(fine),
                           share * volumes(coarse)[parents])
        assert np.array_equal(np.bincount(parents, share, len(coarse.cells)), np.ones(len(coarse.cells)))
        assert np.array_equal(fine.regions, coarse.regions[parents] if len(coarse.regions) else fine.regions)


def test_prolongation_and_its_transpose_agree_with_the_rows(levels):
    for coarse, fine in zip(levels, levels[1:]):
        assert np.array_equal(coarse.prolong(coarse.points), fine.points)
        begin, columns, values = coarse.prolongation()
        columns_of, rows_of = (level.vertex_sharing.index_map() for level in (coarse, fine))
        own = rows_of.entities[:rows_of.owned_count]
        assert len(begin) == len(own) + 1 and np.all(np.add.reduceat(values, begin[:-1]) == 1)
        x = np.zeros(columns_of.rank_begin[-1])
        x[columns_of.numbers] = coarse.points[:, 0]
        x = world.allreduce(x, op=max_of)
        assert np.allclose(np.add.reduceat(values * x[columns], begin[:-1]), fine.points[own, 0])
        r = (fine.vertex_numbers % 7).astype(complex)
        u = (coarse.vertex_numbers % 5).astype(complex)
        mine = columns_of.entities[:columns_of.owned_count]
        sums = total(np.array([(fine.vertex_numbers % 7 * coarse.prolong(u))[own].sum().real,
                               (fine.restrict_residual(r) * u)[mine].sum().real]))
        assert sums[0] == sums[1]


def test_quadratic_and_edge_elements_are_the_same_functions_on_the_next_level(levels, monkeypatch):
    """In the example level_transfer.py."""
    monkeypatch.syspath_prepend(str(pathlib.Path(__file__).resolve().parents[2] / "examples/python"))
    example = importlib.import_module("level_transfer")
    for coarse, fine in zip(levels, levels[1:]):
        (u, v), (fine_u, fine_v) = example.values_on(coarse), example.values_on(fine)
        assert np.allclose(example.prolong_quadratic(coarse, fine, u), fine_u, rtol=0, atol=1e-13)
        assert np.allclose(example.prolong_along_edges(coarse, fine, v), fine_v, rtol=0, atol=1e-13)


def max_of(a, b):
    return np.maximum(a, b)


def test_wrong_arguments_are_refused_on_all_ranks(mesh, levels):
    with pytest.raises(octetra.InputError, match="growth is a finite number from 1 on, not 0.5"):
        mesh.levels(0.5)
    with pytest.raises(octetra.InputError, match="no next level"):
        levels[-1].prolongation()
    with pytest.raises(octetra.InputError, match="no parents"):
        levels[0].parents()
    with pytest.raises(octetra.InputError, match="values must be float64 or complex128, not .?int64"):
        levels[-1].restrict_residual(np.zeros(len(levels[-1].points), np.int64))
    with pytest.raises(octetra.InputError, match="vertices of the level"):
        levels[0].prolong(np.zeros(1))
