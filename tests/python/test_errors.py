"""An error on one rank is raised on all; collective calls release the GIL for other threads."""

import threading
import time

import numpy as np
import pytest
from conftest import near, world
from mpi4py import MPI

import octetra

last = world.rank == world.size - 1


def wrong_here(wrong, right):
    return wrong if last else right


def cells_of(mesh):
    return len(mesh.cells)


# The last rank passes a wrong argument, the others do not.
CASES = {
    "marks of another type": lambda m: m.refine(wrong_here([0.5] * cells_of(m), [1] * cells_of(m))),
    "marks of nothing": lambda m: m.coarsen(wrong_here(object(), None)),
    "too few marks": lambda m: m.refine(np.ones(cells_of(m) - wrong_here(1, 0), bool)),
    "a cell that is not there": lambda m: m.refine(cells=wrong_here([10**6], [])),
    "marks and cells": lambda m: m.refine(wrong_here([1] * cells_of(m), None), cells=[]),
    "a scheme": lambda m: m.refine(np.ones(cells_of(m)), scheme=wrong_here("3t", "8t")),
    "too many cells": lambda m: m.refine(np.ones(cells_of(m), bool), max_cells=10),
    "a number of cells below none": lambda m: m.refine(None, max_cells=wrong_here(-1, 10**6)),
    "a number of cells that is a word": lambda m: m.refine_edges([], max_cells=wrong_here("few", None)),
    "a cell of more than 64 bits": lambda m: m.refine(cells=wrong_here([1, 10**30], [])),
    "a cell that is a word": lambda m: m.refine(cells=wrong_here([1, None], [])),
    "a cell below the first": lambda m: m.refine(cells=wrong_here([3, -1], [])),
    "a share that is no number": lambda m: m.rebalance(most_over_mean=wrong_here(float("nan"), 1.1)),
    "a share below the mean": lambda m: m.refine_evenly(most_over_mean=wrong_here(0.5, 0.5)),
    "an edge of no cell": lambda m: m.refine_edges(wrong_here([[0, 10**9]], [])),
    "an edge of three": lambda m: m.refine_edges(wrong_here([[0, 1, 2]], [])),
    "another rank": lambda m: m.migrate(np.full(len(m.roots), wrong_here(99, 0))),
    "negative indicators": lambda m: octetra.mark.doerfler(
        m, np.full(cells_of(m), wrong_here(-1.0, 1.0))),
    "too few indicators": lambda m: octetra.mark.maximum(m, np.ones(wrong_here(1, cells_of(m)))),
    "a path": lambda m: m.write(wrong_here(7, "mesh.vtu")),
    "a checkpoint by another name": lambda m: m.save("mesh.vtu"),
    "an extension": lambda m: m.write("mesh.txt"),
    "a folder that is not there": lambda m: m.save("/no/such/folder/state.octetra"),
    "a field of another size": lambda m: m.save(
        "no.octetra", vertex_fields={"u": np.ones(len(m.points) + wrong_here(1, 0))}),
    "a field of nothing": lambda m: m.save(
        "no.octetra", vertex_fields={"u": wrong_here(None, np.ones(len(m.points)))}),
    "a field of complex numbers": lambda m: m.write(
        "no.vtu", cell_fields={"u": np.ones(cells_of(m), wrong_here(complex, float))}),
    "values of copies": lambda m: m.vertex_sharing.update_copies(np.ones(wrong_here(1, 2))),
    "an operation": lambda m: m.vertex_sharing.combine(np.ones(len(m.points)),
                                                       wrong_here("product", "sum")),
    "values that are objects": lambda m: m.rebalance().cells(
        np.full(cells_of(m), wrong_here(None, 1))),
    "values of no numbers": lambda m: m.vertex_sharing.update_copies(
        np.ones((len(m.points), wrong_here(0, 0)))),
    "an angle that is no number": lambda m: m.verify(min_dihedral=wrong_here(float("nan"), 5)),
    "an angle of more than 180 degrees": lambda m: m.verify(min_dihedral=200),
    "values of ghosts": lambda m: m.ghosts().values(np.ones(cells_of(m) + wrong_here(1, 0))),
    "a kind of ghosts": lambda m: m.ghosts(wrong_here("edge", "face")),
    "a file that is not there": lambda m: octetra.read(wrong_here("no.mesh", "no.mesh")),
    "a partition": lambda m: octetra.load("no.octetra", partition=wrong_here("half", "rcb")),
    "numbers of cells as marks": lambda m: m.refine(wrong_here(np.arange(cells_of(m)), None)),
    "few numbers of cells as marks": lambda m: m.refine(wrong_here([3, 1], None)),
    "no points": lambda m: octetra.from_arrays(wrong_here(None, []), []),
    "no cells": lambda m: octetra.from_arrays([], wrong_here(None, [])),
    "an inverted cell": lambda m: octetra.from_arrays(
        [[0, 0, 0], [0, 1, 0], [1, 0, 0], [0, 0, 1]], wrong_here([[0, 1, 2, 3]], [])),
    "points in a plane": lambda m: octetra.from_arrays(np.zeros((4, wrong_here(2, 3))), []),
    "a number that does not fit": lambda m: octetra.from_arrays(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]], regions=[wrong_here(2**31, 0)]),
}


# The message of a call with a wrong argument on the last rank.
WORDS = {
    "a number of cells below none": "max_cells must be an integer from 0 to 18446744073709551615, not -1",
    "a number of cells that is a word": "max_cells must be an integer .*, not 'few'",
    "a cell of more than 64 bits": f"cells must be integers that fit into 64 bits, not {10**30}$",
    "a cell that is a word": r"cells must be integers of shape \(n,\), not None$",
    "marks of nothing": "marks must be a boolean or integer for each of .* cells, not <object object at",
    "no points": r"points must be numbers of shape \(n, 3\), not None$",
    "no cells": r"cells must be integers of shape \(m, 4\), numbers of points, not None$",
    "another rank": "a cell is assigned to rank 99, but there "
                    + ("is only 1 rank$" if world.size == 1 else f"are only {world.size} ranks$"),
    "a cell below the first": "cells must be integers from 0; the least is -1",
    "a cell that is not there": "cells has number 1000000, and this rank has",
    "a share that is no number": "most_over_mean: .*, from 1; given is nan",
    "a share below the mean": "most_over_mean: .*, from 1; given is 0.5",
    "a field of another size": r"field 'u': values of shape \(\d+,\) for \d+ vertices",
    "a field of nothing": "field 'u': values must be numbers, not None$",
    "a field of complex numbers": "field 'u': values of type complex128: only float64",
    "numbers of cells as marks": "marks .* must be 0 or one other value, .* as cells=",
    "few numbers of cells as marks": r"marks must .* cells \(numbers of cells are passed as cells=\), not",
    "marks of another type": r"marks must be a boolean or integer for each of \d+ cells, not float64 of",
    "values of no numbers": r"values of shape \(\d+, 0\) are no numbers",
    "an angle that is no number": "min_dihedral must be a number from 0 to 180, or None, not nan",
    "an angle of more than 180 degrees": "min_dihedral must be a number from 0 to 180, or None, not 200",
    "a partition": "rank .: partition takes lepp, .*, not 'half'",
    "a checkpoint by another name": r"mesh.vtu: save\(\) writes a checkpoint, .*write\(\) writes",
}


@pytest.mark.parametrize("case", CASES)
def test_what_is_wrong_on_one_rank_is_raised_alike_on_all(mesh, case):
    points, cells = mesh.points, mesh.cells
    with pytest.raises(octetra.Error, match=WORDS.get(case)) as raised:
        CASES[case](mesh)
    said = world.allgather((type(raised.value), str(raised.value)))
    assert said == [said[0]] * world.size
    assert np.array_equal(mesh.points, points) and np.array_equal(mesh.cells, cells)
    mesh.refine(near(mesh, 0.5))
    assert mesh.verify()


@pytest.mark.skipif(world.size == 1, reason="one rank has all points")
def test_a_part_by_local_numbers_is_refused_with_the_cause(mesh):
    words = "vertex_numbers is None, .* ranks pass different points: .*mesh.vertex_numbers.mesh.cells"
    with pytest.raises(octetra.InputError, match=words) as raised:
        octetra.from_arrays(mesh.points, mesh.cells)
    assert len(set(world.allgather(str(raised.value)))) == 1


@pytest.mark.skipif(world.size == 1, reason="ranks have different types")
@pytest.mark.parametrize("moves", [False, True])
def test_values_of_two_types_do_not_move(mesh, moves):
    before = cells_of(mesh)
    move = mesh.migrate(np.full(len(mesh.roots), 0 if moves else world.rank))
    assert move.changed == moves
    words = f"rank {world.size - 1}: the type of the values is int64, and float64 on rank 0"
    with pytest.raises(octetra.InputError, match=words):
        move.cells(np.ones(before, wrong_here(np.int64, float)))
    assert len(move.cells(np.ones(before))) == cells_of(mesh)


# The last rank passes another type of values, or another argument, than the others.
DIFFERENT = {
    "values of another type": lambda m: m.vertex_sharing.update_copies(
        np.ones(len(m.points), wrong_here(np.int64, float))),
    "values of another shape": lambda m: m.vertex_sharing.update_copies(
        np.ones((len(m.points), 3) if last else len(m.points))),
    "values of another shape to combine": lambda m: m.vertex_sharing.combine(
        np.ones((len(m.points), 3) if last else len(m.points))),
    "values of another type to combine": lambda m: m.vertex_sharing.combine(
        np.ones(len(m.points), wrong_here(np.float32, float))),
    "another operation": lambda m: m.vertex_sharing.combine(
        np.ones(len(m.points)), wrong_here("max", "sum")),
    "values of ghosts of another shape": lambda m: m.ghosts().values(
        np.ones((cells_of(m), 3) if last else cells_of(m))),
    "values of ghosts of another type": lambda m: m.ghosts().values(
        np.ones(cells_of(m), wrong_here(np.int64, float))),
    "other ghosts": lambda m: m.ghosts(wrong_here("vertex", "face")),
    "another partition": lambda m: octetra.read(
        "cube.mesh", partition=wrong_here("block", "rcb")),
    "another scheme": lambda m: m.refine(None, scheme=wrong_here("4t", "8t")),
    "another limit": lambda m: m.refine(None, max_cells=wrong_here(5, None)),
    "another balance": lambda m: m.rebalance(most_over_mean=wrong_here(1.5, 1.1)),
    "another angle": lambda m: m.verify(min_dihedral=wrong_here(1.0, None)),
    "another speed": lambda m: m.verify(fast=wrong_here(True, False)),
    "another closure": lambda m: m.verify(
        "cube.mesh", closure=wrong_here("regular", "longest-edge")),
}


@pytest.mark.skipif(world.size == 1, reason="there is no other rank")
@pytest.mark.parametrize("case", DIFFERENT)
def test_an_argument_that_differs_on_one_rank_is_refused_alike_on_all(mesh, cube, case, monkeypatch):
    monkeypatch.chdir(cube.parent)
    with pytest.raises(octetra.InputError, match=f"^rank {world.size - 1}: the .* on rank 0") as raised:
        DIFFERENT[case](mesh)
    said = world.allgather(str(raised.value))
    assert said == [said[0]] * world.size
    assert mesh.verify()


def test_a_file_that_is_no_checkpoint_is_refused_with_the_function_that_reads_it(cube):
    words = r"cube.mesh: is not a checkpoint: .*; octetra.read\(\), .*, reads meshes of other formats$"
    with pytest.raises(octetra.InputError, match=words):
        octetra.load(cube)


def test_an_intercommunicator_is_refused():
    if world.size == 1:
        pytest.skip("it has two groups")
    half = world.Split(world.rank % 2)
    both = half.Create_intercomm(0, world, 1 - world.rank % 2)
    with pytest.raises(octetra.InputError, match="^an intercommunicator has two groups"):
        octetra.read("cube.mesh", both)
    both.Free()
    half.Free()


PATHS = {
    "read": lambda m, path: octetra.read(path),
    "load": lambda m, path: octetra.load(path),
    "write": lambda m, path: m.write(path),
    "save": lambda m, path: m.save(path),
    "verify": lambda m, path: m.verify(path),
    "series": lambda m, path: octetra.MeshSeries(path),
}


@pytest.mark.skipif(world.size == 1, reason="ranks have different paths")
@pytest.mark.parametrize("call", PATHS)
def test_a_path_that_differs_by_rank_is_refused(folder, mesh, call):
    end = {"read": "mesh", "verify": "mesh", "write": "vtu", "series": "vtkhdf"}.get(call, "octetra")
    with pytest.raises(octetra.InputError, match=f"rank {world.size - 1}: the path is .*b.{end}, and"):
        PATHS[call](mesh, folder / wrong_here(f"b.{end}", f"a.{end}"))
    world.Barrier()
    assert list(folder.iterdir()) == [folder / "cube.mesh"]


@pytest.mark.skipif(world.size == 1, reason="ranks have different markers")
def test_a_marker_that_differs_by_rank_is_refused(mesh):
    words = f"rank {world.size - 1}: the marker or group is 2 of dimension 2, and 1 of dimension 2 on"
    with pytest.raises(octetra.InputError, match=words):
        mesh.vertices_of(wrong_here(2, 1))


def test_errors_are_also_pythons_own(mesh):
    assert issubclass(octetra.InputError, ValueError) and issubclass(octetra.InputError, octetra.Error)
    assert issubclass(octetra.SystemFailure, RuntimeError)
    assert issubclass(octetra.SystemFailure, octetra.Error)
    with pytest.raises(octetra.InputError, match=f"rank {world.size - 1}: marks"):
        mesh.refine(wrong_here([0.5] * cells_of(mesh), [1] * cells_of(mesh)))


NAN = float("nan")
CRITERIA = {
    "sphere: the radius is negative: 0,0,0,-1": lambda m: octetra.mark.sphere(m, (0, 0, 0), -1),
    "sphere takes 4 finite numbers .*'nan,0,0,1'": lambda m: octetra.mark.sphere(m, (NAN, 0, 0), 1),
    "box: each coordinate of the first corner": lambda m: octetra.mark.box(m, (0, 0, 1), (1, 1, 0)),
    "random takes a number from 0 to 1, not '2'": lambda m: octetra.mark.random(m, 2),
    "max_volume takes a number above 0, not '-1'": lambda m: octetra.mark.larger_than(m, -1),
    "max_volume takes a number above 0, not '0'": lambda m: octetra.mark.larger_than(m, 0),
}


@pytest.mark.parametrize("words", CRITERIA)
def test_criteria_are_refused_as_on_the_command_line(mesh, words):
    with pytest.raises(octetra.InputError, match=words):
        CRITERIA[words](mesh)


def test_sharers_of_a_vertex_that_is_not_there_are_an_index_error(mesh):
    vertices = len(mesh.points)
    mesh.vertex_sharing.sharers(vertices - 1)
    for vertex in (vertices, 10**6, -1):
        with pytest.raises(IndexError, match=f"entity {vertex}, and this rank has {vertices}"):
            mesh.vertex_sharing.sharers(vertex)


COLLECTIVE = {
    "refine": lambda m: m.refine(near(m, 0.5)),
    "refine_evenly": lambda m: m.refine_evenly(near(m, 0.5)),
    "coarsen": lambda m: m.coarsen(near(m, 0.5)),
    "rebalance": lambda m: m.rebalance(),
    "count_cells": lambda m: m.count_cells(),
    "verify": lambda m: m.verify(),
    "write": lambda m: m.write("/dev/null/no.vtu"),
    "number_edges": lambda m: m.number_edges(),
    "face_neighbours": lambda m: m.face_neighbours(),
    "ghosts": lambda m: m.ghosts(),
    "doerfler": lambda m: octetra.mark.doerfler(m, np.ones(len(m.cells))),
    "statistics": lambda m: octetra.quality.statistics(m),
    "combine": lambda m: m.vertex_sharing.combine(np.ones(len(m.points))),
    "read": lambda m: octetra.read("no.mesh"),
}


@pytest.mark.skipif(world.size == 1 or MPI.Query_thread() < MPI.THREAD_MULTIPLE,
                    reason="one rank waits for another, by two threads")
@pytest.mark.parametrize("name", COLLECTIVE)
def test_other_threads_run_while_a_rank_waits_in_a_collective_call(mesh, name):
    def call():
        try:
            COLLECTIVE[name](mesh)
        except octetra.Error:
            assert name in ("write", "read")

    words = world.Dup()
    if world.rank != 0:
        words.recv(source=0)  # arrives only when rank 0 waits for this rank and has a free thread
        call()
    else:
        thread = threading.Thread(target=call)
        thread.start()
        time.sleep(0.05)
        for rank in range(1, world.size):
            words.send(None, dest=rank)
        thread.join()
    words.Free()


@pytest.mark.skipif(world.size == 1, reason="one rank waits for another")
def test_a_mesh_that_a_thread_waits_for_is_refused_to_others(mesh):
    words = world.Dup()
    if world.rank != 0:
        words.recv(source=0)
        mesh.count_cells()
    else:
        thread = threading.Thread(target=mesh.count_cells)
        thread.start()
        time.sleep(0.05)
        with pytest.raises(octetra.SystemFailure, match="another thread"):
            mesh.points
        for rank in range(1, world.size):
            words.send(None, dest=rank)
        thread.join()
        assert len(mesh.points)
    words.Free()


CLASSES = [member for member in vars(octetra._octetra).values()
           if isinstance(member, type) and not issubclass(member, BaseException)]


@pytest.mark.parametrize("kind", CLASSES)
def test_an_object_made_without_init_is_refused(kind):
    def use():
        raw = kind.__new__(kind)
        for name, member in vars(kind).items():
            if isinstance(member, property):
                getattr(raw, name)
        raw.commit()

    with pytest.raises(TypeError):
        use()
    with pytest.raises(TypeError):
        object.__new__(kind)
    with pytest.raises((TypeError, octetra.InputError)):  # a series without a path
        kind()
