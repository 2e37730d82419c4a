"""Arguments of a wrong type, unknown ones and missing ones are refused alike on all ranks by collective
functions, in words that name the argument, what is expected and what was passed."""

import collections
import inspect
import pathlib
import re

import numpy as np
import pytest
from conftest import world

import octetra

last = world.rank == world.size - 1


class Call:
    """Calls a function with wrong arguments on the last rank, and with right ones on the others."""

    def __init__(self, *right, **named):
        self.right, self.named = right, named

    def __call__(self, function, *wrong, **named):
        return function(*wrong, **named) if last else function(*self.right, **self.named)


def ones(mesh):
    return np.ones(len(mesh.points))


def step_of(mesh):
    return mesh.refine(cells=[])


def unexpected(name, parameters, word):
    """The message of this interpreter for an unknown argument of a function with these parameters.
    From Python 3.13 on it ends with a suggestion."""
    scope = {}
    exec(f"def {name}({parameters}): pass", scope)
    with pytest.raises(TypeError) as raised:
        scope[name](**{word: None})
    assert str(raised.value).startswith(f"{name}() got an unexpected keyword argument '{word}'")
    return str(raised.value)


# The message of the call on the last rank, which all ranks get.
CASES = {
    unexpected("refine", "marks=None, *, cells=None, scheme='8t', max_cells=None", "mark"):
        lambda m: Call()(m.refine, mark=None),
    "refine() takes from 0 to 1 positional arguments but 2 were given": lambda m: Call()(
        m.refine, None, None),
    "refine_edges() missing 1 required positional argument: 'edges'": lambda m: Call([])(m.refine_edges),
    "refine() got multiple values for argument 'marks'": lambda m: Call()(m.refine, None, marks=None),
    "scheme must be a string, not 8": lambda m: Call()(m.refine, scheme=8),
    "scheme must be a string, not None": lambda m: Call()(m.refine_edges, [], scheme=None)
    if last else m.refine_edges([]),
    "scheme must be '8t', '4t' or '2t', not '8'": lambda m: Call()(m.refine, scheme="8"),
    "max_cells must be an integer from 0 to 18446744073709551615, not 'a'": lambda m: Call()(
        m.refine, max_cells="a"),
    "max_cells must be an integer from 0 to 18446744073709551615, not 18446744073709551616":
        lambda m: Call()(m.refine, max_cells=2**64),
    "max_cells must be an integer from 0 to 18446744073709551615, not 1.5": lambda m: Call()(
        m.refine_evenly, max_cells=1.5),
    "most_over_mean must be a number, not 'a'": lambda m: Call()(m.rebalance, most_over_mean="a"),
    "may_forget_history must be True or False, not None": lambda m: Call()(
        m.refine_evenly, may_forget_history=None),
    "coarsen() takes from 0 to 1 positional arguments but 2 were given": lambda m: Call()(
        m.coarsen, None, None),
    "migrate() missing 1 required positional argument: 'rank_of_root'": lambda m: Call(
        np.zeros(len(m.roots), int))(m.migrate),
    "recall_history() takes 0 positional arguments but 1 was given": lambda m: Call()(m.recall_history, 1),
    "count_cells() takes 0 positional arguments but 1 was given": lambda m: Call()(m.count_cells, 1),
    unexpected("number_edges", "", "all"): lambda m: Call()(m.number_edges, all=True),
    "face_neighbours() takes 0 positional arguments but 1 was given": lambda m: Call()(
        m.face_neighbours, 1),
    "cell_index_map() takes 0 positional arguments but 1 was given": lambda m: Call()(m.cell_index_map, 1),
    "levels() takes from 0 to 1 positional arguments but 2 were given": lambda m: Call()(m.levels, 2.0, 3),
    "growth must be a number, not 'a'": lambda m: Call()(m.levels, "a"),
    "prolongation() takes 0 positional arguments but 1 was given": lambda m: Call()(m.levels()[0].prolongation, 1),
    "index_map() takes 0 positional arguments but 1 was given": lambda m: Call()(
        m.vertex_sharing.index_map, 1),
    "statistics() takes 1 positional argument but 2 were given": lambda m: Call(m)(
        octetra.quality.statistics, m, m),
    "by must be a string, not 3": lambda m: Call()(m.ghosts, 3),
    "by must be 'face' or 'vertex', not 'edge'": lambda m: Call()(m.ghosts, "edge"),
    "operation must be a string, not 3": lambda m: Call(ones(m))(m.vertex_sharing.combine, ones(m), 3),
    "update_copies() missing 1 required positional argument: 'values'": lambda m: Call(ones(m))(
        m.vertex_sharing.update_copies),
    "marker must be an integer from -2147483648 to 2147483647, or the name of a group, not 1099511627776":
        lambda m: Call(1)(m.vertices_of, 2**40),
    "dimension must be an integer from -2147483648 to 2147483647, not 'facets'": lambda m: Call(1)(
        m.vertices_of, 1, dimension="facets"),
    "step must be an octetra.Adaptation, not 3": lambda m: Call(step_of(m), ones(m))(
        m.transfer_conservatively, 3, ones(m)),
    "series must be an octetra.MeshSeries, not None": lambda m: Call(octetra.MeshSeries("no.vtkhdf"), 1)(
        m.append_to, None, 1),
    "theta must be a number, not 'half'": lambda m: Call(m, np.ones(len(m.cells)))(
        octetra.mark.doerfler, m, np.ones(len(m.cells)), "half"),
    "path must be a string or an os.PathLike, not 3": lambda m: Call("no.mesh")(octetra.read, 3),
    "path must be a string or an os.PathLike, not None": lambda m: Call("no.vtu")(m.write, None),
    "partition must be a string, not 3": lambda m: Call("no.mesh")(octetra.read, "no.mesh", partition=3),
    unexpected("load", "path, comm=None, *, partition='rcb'", "parts"): lambda m: Call("no.octetra")(
        octetra.load, "no.octetra", parts=3),
    "MeshSeries() missing 1 required positional argument: 'path'": lambda m: Call("no.vtkhdf")(
        octetra.MeshSeries),
    "from_arrays() missing 1 required positional argument: 'cells'": lambda m: Call([], [])(
        octetra.from_arrays, []),
    "index_base must be an integer from 0 to 4294967295, not -1": lambda m: Call([], [])(
        octetra.from_arrays, [], [], index_base=-1),
    "vertex_fields must be a dict {name: array}, not [1.0]": lambda m: Call("no.vtu")(
        m.write, "no.vtu", vertex_fields=[1.0]),
    "the name of a field must be a string, not 1": lambda m: Call("no.vtu")(
        m.write, "no.vtu", vertex_fields={1: ones(m)}),
    "time must be a number, not 'a'": lambda m: Call("no.octetra")(m.save, "no.octetra", time="a"),
    "step must be an integer from -9223372036854775808 to 9223372036854775807, not 1.5":
        lambda m: Call("no.octetra")(m.save, "no.octetra", step=1.5),
    "step must be an integer from -9223372036854775808 to 9223372036854775807, not 'a'":
        lambda m: Call("no.octetra")(m.save, "no.octetra", step="a"),
    "text must be a string, not 3": lambda m: Call("no.octetra")(m.save, "no.octetra", text=3),
    "expression must be a string, not 3": lambda m: Call(m, "x < 1")(octetra.mark.where, m, 3),
    "column 3: = assigns; a comparison for equality is ==\n  x = 1\n    ^": lambda m: Call(m, "x < 1")(
        octetra.mark.where, m, "x = 1"),
    "backgrounds must be a list of octetra.Background, not 3": lambda m: Call(m, "x < 1", None, None, [])(
        octetra.mark.where, m, "x < 1", None, None, 3),
    "as_background() takes either vertex_values or cell_values": lambda m: Call("h", np.ones(len(m.points)))(
        m.as_background, "h"),
    "gradation must be above 1, not 1.0": lambda m: Call(m, "x")(octetra.mark.size, m, "x", 1.0),
    "gradation must be a number, not 'a'": lambda m: Call(m, "x")(octetra.mark.size, m, "x", "a"),
    "column 2: a number or variable is missing at the end\n  -\n   ^": lambda m: Call(m, "x")(
        octetra.mark.size, m, "-"),
    "levels must be an integer from -2147483648 to 2147483647, not 'a'": lambda m: Call(m)(
        octetra.Fit, m, levels="a"),
    "next() missing 1 required positional argument: 'sizes'": lambda m: Call(np.ones(len(m.cells)))(
        octetra.Fit(m).next),
    "sizes must be numbers of shape (n,), not <U1 of shape ()": lambda m: Call(np.ones(len(m.cells)))(
        octetra.Fit(m).misfit_cells, "a"),
    "cells_after() missing 1 required positional argument: 'marks'": lambda m: Call(None)(m.cells_after),
    "count must be an integer from 0 to 18446744073709551615, not -1": lambda m: Call(None, 9)(
        m.marks_within, None, -1),
    "coarse must be a string or an os.PathLike, not 3": lambda m: Call()(m.verify, 3),
    "fast must be True or False, not 'x'": lambda m: Call()(m.verify, fast="x"),
    "min_dihedral must be a number, not 'x'": lambda m: Call()(m.verify, min_dihedral="x"),
    "closure must be 'longest-edge' or 'regular', not 'even'": lambda m: Call()(
        m.verify, closure="even"),
    "closure='regular' requires coarse, the mesh that was refined": lambda m: Call()(
        m.verify, closure="regular"),
}


@pytest.mark.parametrize("words", CASES)
def test_an_argument_that_one_rank_refuses_is_an_error_on_all(mesh, words, monkeypatch, folder):
    monkeypatch.chdir(folder)
    points = mesh.points
    with pytest.raises(octetra.InputError) as raised:
        CASES[words](mesh)
    assert str(raised.value) == f"rank {world.size - 1}: {words}"
    assert np.array_equal(mesh.points, points)
    assert mesh.verify()


def test_a_long_argument_is_named_by_its_type(mesh):
    with pytest.raises(octetra.InputError, match="not an object of type ndarray$"):
        mesh.write("no.vtu", vertex_fields=np.ones(100))


@pytest.mark.skipif(world.size == 1, reason="there is no other rank")
def test_edges_are_not_exchanged_with_vertices(mesh):
    edges = mesh.number_edges()
    sharing = edges.sharing if last else mesh.vertex_sharing
    words = f"rank {world.size - 1}: the type of the values is int64 for each edge.*, and int64 for each vertex"
    for call in (sharing.update_copies, sharing.combine):
        with pytest.raises(octetra.InputError, match=words):
            call(np.ones(len(sharing.owners), int))


LOCAL = {
    "mesh must be an octetra.Mesh, not 3": lambda m: octetra.mark.sphere(3, (0, 0, 0), 1),
    "centre must be three numbers, not (0, 0)": lambda m: octetra.mark.sphere(m, (0, 0), 1),
    "radius must be a number, not None": lambda m: octetra.mark.sphere(m, (0, 0, 0), None),
    "box() missing 1 required positional argument: 'high'": lambda m: octetra.mark.box(m, (0, 0, 0)),
    "tag must be an integer from -2147483648 to 2147483647, or the name of a group of cells, "
    "not 1099511627776": lambda m: octetra.mark.region(m, 2**40),
    "seed must be an integer from 0 to 18446744073709551615, not -1": lambda m: octetra.mark.random(
        m, 0.5, seed=-1),
    "volume must be a number, not 'a'": lambda m: octetra.mark.larger_than(m, "a"),
    "mesh must be an octetra.Mesh, not None": lambda m: octetra.quality.volume(None),
    "how must be a string, not 3": lambda m: step_of(m).transfer_cells(np.ones(len(m.cells)), 3),
    "how must be 'copied', 'averaged' or 'divided', not 'halved'": lambda m: step_of(m).transfer_cells(
        np.ones(len(m.cells)), "halved"),
    "transfer_vertices() takes 1 positional argument but 2 were given": lambda m: step_of(
        m).transfer_vertices(ones(m), "copied"),
    "entity must be an integer from -9223372036854775808 to 9223372036854775807, not 'a'":
        lambda m: m.vertex_sharing.sharers("a"),
    "path must be a string or an os.PathLike, not 3": lambda m: octetra.saved_state(3),
    "boundary() takes 0 positional arguments but 1 was given": lambda m: m.boundary(1),
    "comm must be a communicator of mpi4py or None, not 3": lambda m: octetra.read("no.mesh", 3),
}


@pytest.mark.parametrize("words", LOCAL)
def test_functions_that_are_not_collective_refuse_arguments_in_the_same_words(mesh, words):
    with pytest.raises(octetra.InputError) as raised:
        LOCAL[words](mesh)
    assert str(raised.value) == words


def test_what_converts_is_accepted(mesh, folder):
    path = folder / "state.octetra"
    fields = collections.ChainMap({"u": ones(mesh)})  # a mapping, and no dict
    mesh.save(path, vertex_fields=fields, time=np.float32(1.5), step=np.int64(3), text="a\tb\n")
    assert octetra.saved_state(str(path)) == {"time": 1.5, "step": 3, "text": "a\tb\n"}
    assert mesh.verify(fast=np.True_, min_dihedral=np.float32(1))
    mesh.refine(max_cells=np.uint32(10**6))
    assert mesh.vertices_of(marker=np.int16(1), dimension=2).any()
    assert octetra.quality.volume(mesh=mesh).sum() > 0
    world.Barrier()


def test_a_mesh_has_no_constructor():
    for make in (octetra.Mesh, lambda: octetra.Mesh.__new__(octetra.Mesh)):
        with pytest.raises(TypeError, match="Mesh cannot be constructed: functions of octetra return"):
            make()


def test_functions_have_signatures_and_no_name_of_cpp(mesh):
    words = "marks=None, *, cells=None, scheme='8t', closure='longest-edge', max_cells=None)"
    assert str(inspect.signature(octetra.Mesh.refine)) == f"(self, {words}"
    assert str(inspect.signature(mesh.refine)) == f"({words}"
    assert str(inspect.signature(octetra.read)) == "(path, comm=None, *, partition='rcb')"
    modules = (octetra._octetra, octetra.mark, octetra.quality)
    things = [thing for module in modules for thing in vars(module).values()]
    things += [member for thing in things if isinstance(thing, type) for member in vars(thing).values()]
    assert not [thing for thing in things if "::" in (getattr(thing, "__doc__", None) or "")]


def test_the_docstring_of_save_names_its_defaults():
    assert "0.0, 0 or ''" in octetra.Mesh.save.__doc__ and "control characters" in octetra.Mesh.save.__doc__


def documented(kind):
    """The functions in a row of the table of collective and local functions in docs/python.md."""
    page = pathlib.Path(__file__).parents[2] / "docs" / "python.md"
    row = re.search(rf"^\| {kind} \|.*$", page.read_text(), re.MULTILINE).group().rsplit(" | ", 1)[1]
    names, prefix = set(), ""
    for name in re.findall(r"`([\w.]+)`", row.replace("`mesh.points`", "")):
        prefix, _, last = name.rpartition(".") if "." in name else (prefix, "", name)
        names.add(f"{prefix}.{last}")
    return names


def test_the_page_says_which_functions_are_collective():
    kinds = {"collective": set(), "local": set()}
    scopes = {"octetra": octetra, "octetra.mark": octetra.mark, "octetra.quality": octetra.quality}
    scopes |= {name: thing for name, thing in vars(octetra).items() if isinstance(thing, type)}
    for scope, members in scopes.items():
        for name, member in vars(members).items():
            if callable(member) and not isinstance(member, type) and not name.startswith("_"):
                is_collective = member.__doc__.startswith("Collective.")
                kinds["collective" if is_collective else "local"].add(f"{scope}.{name}")
    assert octetra.MeshSeries.__init__.__doc__.startswith("Collective.")
    assert "Collective." in octetra.Fit.__init__.__doc__
    kinds["collective"] |= {"octetra.MeshSeries", "octetra.Fit"}
    assert {kind: documented(kind) for kind in kinds} == kinds
