"""Meshes as DMPlex of petsc4py, and back."""

import importlib
import pathlib
import re

import numpy as np
import pytest
from conftest import near, total, world

import octetra

pytest.importorskip("petsc4py", reason="there is no petsc4py (Debian: python3-petsc4py)")
try:
    from octetra.petsc import from_plex, points_of, to_plex
except ImportError:
    pytest.skip("octetra.petsc is not built", allow_module_level=True)
from petsc4py import PETSc


@pytest.fixture
def refined(mesh):
    mesh.refine(near(mesh, 0.5))
    mesh.rebalance(most_over_mean=1.0)
    return mesh


def test_a_plex_has_the_points_of_the_mesh(refined):
    plex = to_plex(refined)
    points = points_of(plex)
    assert isinstance(plex, PETSc.DMPlex) and plex.getRefCount() == 1
    assert plex.getChart() == (0, points.end)
    assert plex.getHeightStratum(0) == (0, len(refined.cells))
    assert points.first_face - points.first_vertex == len(refined.points)
    assert points.first_edge - points.first_face == len(refined.number_faces().vertices)
    assert points.end - points.first_edge == len(refined.number_edges().vertices)
    assert np.array_equal(plex.getCoordinatesLocal().array.reshape(-1, 3), refined.points)
    for c in range(0, len(refined.cells), 11):
        closure = plex.getTransitiveClosure(c)[0]
        low, high = points.first_vertex, points.first_face
        vertices = closure[(closure >= low) & (closure < high)] - low
        assert vertices.tolist() == refined.cells[c][[1, 0, 2, 3]].tolist()


def test_a_plex_has_the_sharers_of_the_mesh(refined):
    plex = to_plex(refined, world)
    points = points_of(plex)
    leaves = plex.getPointSF().getGraph()[1] if world.size > 1 else []
    owned = np.delete(np.arange(points.end), leaves)
    counts = np.histogram(owned, [0, points.first_vertex, points.first_face, points.first_edge,
                                  points.end])[0]
    assert total(counts).tolist() == [refined.count_cells(), refined.vertex_count,
                                      refined.number_faces().count, refined.number_edges().count]


def test_tags_are_labels_and_are_restored(folder, refined):
    plex = to_plex(refined, faces="walls")
    assert plex.hasLabel("walls") and not plex.hasLabel("Face Sets")
    back = from_plex(plex, faces="walls")
    assert np.array_equal(back.cell_points, np.arange(len(refined.cells)))
    points = points_of(plex)
    assert np.array_equal(refined.points[back.vertex_points - points.first_vertex], back.mesh.points)
    assert np.array_equal(back.mesh.points[back.mesh.cells], refined.points[refined.cells])
    markers = [total(np.bincount(m.facet_markers, minlength=9)) for m in (refined, back.mesh)]
    assert np.array_equal(*markers) and markers[0].sum() > 192
    assert back.mesh.verify()
    assert len(from_plex(plex, faces="").mesh.facets) == 0


def gradients_and_volumes(corners):
    """Gradients of the linear functions that are 1 at one corner, (n, 4, 3), and volumes, (n,)."""
    edges = corners[:, 1:] - corners[:, :1]
    inverse = np.linalg.inv(edges).transpose(0, 2, 1)
    return (np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1),
            np.linalg.det(edges) / 6)


def test_a_linear_function_solves_laplaces_equation_on_a_plex(refined):
    plex = to_plex(refined)
    points = points_of(plex)
    plex.setNumFields(1)
    section = plex.createSection([1], [1, 0, 0, 0])
    plex.setSection(section)
    matrix, u = plex.createMatrix(), plex.createGlobalVector()
    offset = np.array([section.getOffset(p)
                       for p in range(points.first_vertex, points.first_face)], PETSc.IntType)
    gradients, volumes = gradients_and_volumes(refined.points[refined.cells])
    stiffness = np.einsum("nid,njd,n->nij", gradients, gradients, volumes)
    for cell, values in zip(offset[refined.cells], stiffness):
        matrix.setValuesLocal(cell, cell, values, addv=PETSc.InsertMode.ADD_VALUES)
    matrix.assemble()

    exact = 1 + refined.points @ [2, -3, 0.5]
    on_boundary = np.any((refined.points == 0) | (refined.points == 1), axis=1)
    numbers = plex.getLGMap().apply(offset)
    u.setValues(numbers[on_boundary], exact[on_boundary])
    u.assemble()
    right = u.duplicate()
    matrix.zeroRowsColumns(numbers[on_boundary & (refined.vertex_sharing.owners == world.rank)], 1, u,
                           right)
    solver = PETSc.KSP().create(world)
    solver.setType("cg")
    solver.setOperators(matrix)
    solver.setTolerances(rtol=1e-13)
    solver.setInitialGuessNonzero(True)
    solver.solve(right, u)
    local = plex.createLocalVector()
    plex.globalToLocal(u, local)
    assert np.allclose(local.array[offset], exact, atol=1e-10)


def test_the_solver_prints_the_output_of_the_page(cube, monkeypatch, capsys):
    source = pathlib.Path(__file__).resolve().parents[2]
    monkeypatch.syspath_prepend(source / "examples/python")
    page = (source / "docs/petsc.md").read_text()
    table = re.search("    cells  unknowns  integral of u\n(.*\n){4}", page)[0].splitlines()
    importlib.import_module("petsc_poisson").run(cube, 2)
    world.Barrier()
    assert capsys.readouterr().out.splitlines() == (table[:4] if world.rank == 0 else [])


def test_multigrid_on_the_levels_takes_few_iterations_at_every_size(cube, monkeypatch, capsys):
    monkeypatch.syspath_prepend(pathlib.Path(__file__).resolve().parents[2] / "examples/python")
    importlib.import_module("multigrid_poisson").run(cube, 5)
    world.Barrier()
    rows = [[int(word) for word in row.split()] for row in capsys.readouterr().out.splitlines()[1:]]
    assert len(rows) == (6 if world.rank == 0 else 0)
    for _, vertices, levels, iterations in rows[1:]:
        assert levels >= 2 and 3 <= iterations <= 20


def test_other_plexes_than_of_tetrahedra_are_refused():
    with pytest.raises(TypeError):
        from_plex(3)
    flat = PETSc.DMPlex().createBoxMesh([2, 2], simplex=False, comm=world)
    with pytest.raises(octetra.InputError, match="dimension 2"):
        from_plex(flat)
    alone = PETSc.DMDA().create([4], comm=world)
    with pytest.raises(octetra.InputError, match="not a DMPlex"):
        from_plex(alone)
