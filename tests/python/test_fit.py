"""Fit, cells_after() and marks_within(): meshes of a target size or a number of cells."""

import numpy as np
import pytest
from conftest import near, total
from mpi4py import MPI

import octetra


def longest(mesh):
    ends = mesh.points[mesh.cells[:, octetra.cell_edges]]
    return np.linalg.norm(ends[:, :, 0] - ends[:, :, 1], axis=2).max(axis=1)


def test_cell_values_are_those_of_the_expression(mesh):
    values = np.arange(len(mesh.cells), dtype=float)
    assert np.allclose(mesh.cell_values("longest"), longest(mesh), rtol=1e-15)
    assert np.array_equal(mesh.cell_values("2 * field(q) + 1", cell_fields={"q": values}), 2 * values + 1)


@pytest.mark.parametrize("closure", ["longest-edge", "regular"])
def test_a_mesh_follows_a_moving_size_with_its_data(mesh, closure):
    input_cells, input_vertices = mesh.count_cells(), mesh.vertex_count
    scale = mesh.comm.allreduce(longest(mesh).max(initial=0), op=MPI.MAX)
    x = np.array(mesh.points[:, 0])
    for centre in (0.2, 0.8):
        fit = octetra.Fit(mesh, closure=closure)
        while step := fit.next(sizes := mesh.cell_values(f"{scale} * (0.3 + abs(x - {centre}))")):
            x = step.transfer_vertices(x)
        assert np.array_equal(x, mesh.points[:, 0])
        assert np.all(longest(mesh) <= sizes * (1 + 1e-15))
        assert fit.refined > 0 and fit.misfit_cells(sizes)["too_long"] == 0
    assert fit.coarsened > 0 and mesh.verify()
    fit = octetra.Fit(mesh, closure=closure)
    while fit.next(np.full(len(mesh.cells), np.inf)):
        pass
    assert (mesh.count_cells(), mesh.vertex_count) == (input_cells, input_vertices)
    assert fit.misfit_cells(np.full(len(mesh.cells), np.inf)) == {
        "too_long": 0, "too_short": input_cells, "too_short_roots": input_cells}


@pytest.mark.parametrize("closure", ["longest-edge", "regular"])
def test_marks_within_a_number_of_cells_make_no_more(mesh, closure):
    marks = near(mesh, 0.8)
    all_cells = mesh.cells_after(marks, closure=closure)
    most = (mesh.count_cells() + all_cells) // 2
    chosen = mesh.marks_within(marks, most, closure=closure)
    assert chosen.dtype == bool and not np.any(chosen & ~marks)
    predicted = mesh.cells_after(chosen, closure=closure)
    assert mesh.count_cells() < predicted <= most
    assert np.array_equal(mesh.marks_within(marks, all_cells, closure=closure), marks)
    mesh.refine(chosen, closure=closure)
    assert mesh.count_cells() == predicted
    assert total(chosen.sum()) > 0


def test_other_sizes_are_refused(mesh):
    with pytest.raises(octetra.InputError, match="target sizes for"):
        octetra.Fit(mesh).next(np.ones(len(mesh.cells) + 1))
    with pytest.raises(octetra.InputError, match="the target size of cell 0 is -1, not a number above 0"):
        octetra.Fit(mesh).next(np.full(len(mesh.cells), -1.0))
