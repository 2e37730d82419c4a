"""Successive meshes in one file."""

import numpy as np
import pytest
from conftest import command, near, world

import octetra


def test_bytes_are_those_of_the_command(folder, cube):
    (folder / "script.txt").write_text("refine --sphere 0,0,0,0.5\ncoarsen --sphere 0,0,0,0.2\n")
    mesh = octetra.read(cube)
    with octetra.MeshSeries(folder / "ours.vtkhdf") as series:
        mesh.append_to(series, 0)
        mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 0.5))
        mesh.append_to(series, 1)
        mesh.coarsen(octetra.mark.sphere(mesh, (0, 0, 0), 0.2))
        mesh.append_to(series, time=2.0)
    command("adapt", cube, "--script", folder / "script.txt", "-o", folder / "last.mesh", "--series",
            folder / "theirs.vtkhdf")
    assert (folder / "ours.vtkhdf").read_bytes() == (folder / "theirs.vtkhdf").read_bytes()


def test_fields_are_written_and_those_missing_in_steps_are_reported(folder, mesh):
    h5py = pytest.importorskip("h5py", reason="there is no h5py (Debian: python3-h5py)")
    series = octetra.MeshSeries(str(folder / "all.vtkhdf"), world)
    volumes = octetra.quality.volume(mesh)
    mesh.append_to(series, -0.5, vertex_fields={"x": mesh.points}, cell_fields={"v": volumes})
    mesh.append_to(series, 1e3, cell_fields={"v": volumes})
    assert not (folder / "all.vtkhdf").exists()
    assert "'x' is left out" in series.commit()
    with h5py.File(folder / "all.vtkhdf") as file:
        root = file["VTKHDF"]
        assert root["Steps/Values"][:].tolist() == [-0.5, 1e3]
        assert "x" not in root["PointData"]
        assert np.allclose(root["CellData/v"], 1 / 384)
    with pytest.raises(octetra.InputError, match="committed"):
        mesh.append_to(series, 1e4)
    with pytest.raises(octetra.InputError, match="committed"):
        series.commit()


def test_a_statement_that_raises_leaves_no_file(folder, mesh):
    with pytest.raises(ZeroDivisionError):
        with octetra.MeshSeries(folder / "all.vtkhdf") as series:
            mesh.append_to(series, 0)
            1 / 0
    world.Barrier()
    assert [path.name for path in folder.iterdir()] == ["cube.mesh"]
    with pytest.raises(octetra.InputError, match="discarded"):
        series.commit()


def raised_by_all(raised):
    said = world.allgather(str(raised.value))
    return said == [said[0]] * world.size


def test_errors_are_raised_identically_on_all_ranks_and_the_series_continues(folder, mesh):
    wrong = world.rank == world.size - 1
    with pytest.raises(octetra.InputError):
        octetra.MeshSeries(folder / "all.vtu")
    with pytest.raises(octetra.InputError) as raised:
        octetra.MeshSeries(7 if wrong else folder / "all.vtkhdf")
    assert raised_by_all(raised)
    with octetra.MeshSeries(folder / "all.vtkhdf") as series:
        mesh.append_to(series, 1)
        for time, fields in ((1, {}), (float("nan"), {}), ("noon" if wrong else 2, {}),
                             (2, {"u": np.ones(len(mesh.cells) + wrong)})):
            with pytest.raises(octetra.InputError) as raised:
                mesh.append_to(series, time, cell_fields=fields)
            assert raised_by_all(raised), time
        mesh.append_to(series, 2 + world.rank)  # only the argument of the first rank is used
        mesh.append_to(series, 2.5)
    assert (folder / "all.vtkhdf").exists()


@pytest.mark.skipif(world.size == 1, reason="takes several ranks")
def test_a_series_on_other_ranks_is_refused(folder, cube, mesh):
    alone = octetra.read(cube, world.Split(world.rank))
    alone.refine(near(alone, 0.5))
    with octetra.MeshSeries(folder / "all.vtkhdf") as series:
        with pytest.raises(octetra.InputError, match="have different communicators"):
            alone.append_to(series, 0)
        mesh.append_to(series, 0)
