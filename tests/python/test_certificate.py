"""Certificates of shapes."""

import pytest
from conftest import world

import octetra


def test_certificate_bounds_a_kuhn_cube(mesh):
    found = mesh.certify_shapes(worst=2)
    assert found.closed and found.holds_to_generation is None
    assert found.cells == found.closed_cells == 384
    assert found.max_shapes == 1
    assert found.bounds["min_dihedral"] <= 45 < found.bounds["min_dihedral"] + 1e-8
    assert found.bounds["max_dihedral"] >= 120 > found.bounds["max_dihedral"] - 1e-8
    assert abs(found.bounds["min_eta"] - 0.432 ** (1 / 3)) < 1e-10
    assert abs(found.bounds["min_solid"] - 0.2617993878) < 1e-9
    assert [cell["cell"] for cell in found.worst] == [0, 1]
    assert found.worst[0]["closed"] and found.worst[0]["generations"] == 1
    assert repr(found) == "<octetra.ShapeCertificate: 45 to 120 degrees, at any level>"
    mine = world.rank == 0
    one = octetra.from_arrays([[0, 0, 0], [7, 0, 0], [2, 5, 0], [1, 2, 6]],
                              [[0, 1, 2, 3]] if mine else [])
    limited = one.certify_shapes(limit=20)
    assert not limited.closed and limited.holds_to_generation == 1
    assert one.certify_shapes().max_shapes == 40


def test_certificate_of_a_refined_mesh_is_refused_alike_on_all_ranks(mesh):
    mesh.refine(scheme="8t", cells=[0])
    with pytest.raises(octetra.InputError, match="has been refined"):
        mesh.certify_shapes()


@pytest.mark.parametrize("arguments", [{"limit": 0}, {"limit": -1}, {"limit": "many"}, {"worst": None}, {"other": 1}])
def test_wrong_arguments_are_refused(mesh, arguments):
    with pytest.raises(octetra.InputError):
        mesh.certify_shapes(**arguments)
