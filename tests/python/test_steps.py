"""Steps, their results, and equality with the files of the command."""

import importlib
import pathlib

import numpy as np
import pytest
from conftest import PROGRAM, centroids, command, near, run_alone, total, world
from mpi4py import MPI

import octetra


def same(a, b):
    return a.read_bytes() == b.read_bytes()


def test_bytes_are_those_of_the_command(folder, cube):
    mesh = octetra.read(cube)
    for _ in range(2):
        mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 0.5))
    mesh.write(folder / "fine.mesh")
    mesh.write(folder / "fine.vtu")
    mesh.save(folder / "fine.octetra")
    sphere = ("--sphere", "0,0,0,0.5", "--levels", "2")
    for end in ("mesh", "octetra"):
        command("refine", cube, *sphere, "-o", folder / f"expected.{end}")
        assert same(folder / f"fine.{end}", folder / f"expected.{end}"), end
    mesh.coarsen(octetra.mark.box(mesh, (0, 0, 0), (0.2, 0.3, 1)))
    mesh.write(folder / "coarse.mesh")
    command("coarsen", folder / "expected.octetra", "--box", "0,0,0,0.2,0.3,1", "-o",
            folder / "expected_coarse.mesh")
    assert same(folder / "coarse.mesh", folder / "expected_coarse.mesh")


def test_the_regular_closure_is_that_of_the_command_and_carries_values(folder, cube):
    mesh = octetra.read(cube)
    x = mesh.points.copy()
    for radius in (0.5, 0.3):
        step = mesh.refine(octetra.mark.sphere(mesh, (0.1, 0.1, 0.1), radius), closure="regular")
        x = step.transfer_vertices(x)
        assert np.array_equal(x, mesh.points)
        assert (step.vertices_before == -1).sum() == len(step.new_vertex_ends)
        assert len(step.cells.parents) == len(mesh.cells)
    mesh.save(folder / "regular.octetra")
    for radius, source, target in ((0.5, cube, "one.octetra"), (0.3, folder / "one.octetra", "two.octetra")):
        command("refine", source, "--sphere", f"0.1,0.1,0.1,{radius}", "--closure", "regular", "-o", folder / target)
    assert same(folder / "regular.octetra", folder / "two.octetra")
    for wrong in ({}, {"closure": "regular", "scheme": "4t"}, {"closure": "regularly"}):
        with pytest.raises(octetra.InputError, match="closure"):
            mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 1), **wrong)


@pytest.mark.parametrize("criterion, option", [
    (lambda m: octetra.mark.box(m, (0, 0, 0), (0.5, 0.5, 0.5)), ("--box", "0,0,0,0.5,0.5,0.5")),
    (lambda m: octetra.mark.random(m, 0.2, 5), ("--random", "0.2", "--seed", "5")),
    (lambda m: octetra.mark.larger_than(m, 0.001), ("--max-volume", "0.001")),
    (lambda m: octetra.mark.where(m, "x < 0.3 and not boundary"), ("--where", "x < 0.3 and not boundary")),
    (lambda m: octetra.mark.region(m, 2), ("--region", "2")),
])
def test_criteria_mark_the_same_cells_as_the_command(folder, criterion, option):
    command("generate", "two-material", "-o", folder / "in.mesh")
    for scheme in ("8t", "4t", "2t"):
        mesh = octetra.read(folder / "in.mesh", partition="block")
        mesh.refine(criterion(mesh), scheme=scheme)
        mesh.write(folder / "out.mesh")
        command("refine", folder / "in.mesh", *option, "--scheme", scheme, "-o",
                folder / "expected.mesh")
        assert same(folder / "out.mesh", folder / "expected.mesh")


def test_expressions_use_the_fields_of_the_arguments(mesh):
    height = np.asarray(mesh.points)[:, 2]
    index = np.arange(len(mesh.cells))
    corners = height[np.asarray(mesh.cells)]
    low = octetra.mark.where(mesh, "field(h) < 0.4", {"h": height})
    assert low.dtype == bool and np.array_equal(low, corners.mean(axis=1) < 0.4)
    high = octetra.mark.where(mesh, "field_max(h) > 0.8 and field(i) >= 5", {"h": height}, {"i": index})
    assert np.array_equal(high, (corners.max(axis=1) > 0.8) & (index >= 5))


def test_sizes_are_those_of_the_vertices(mesh):
    x, y, z = np.asarray(mesh.points).T
    corners = np.asarray(mesh.points)[np.asarray(mesh.cells)]
    edges = [corners[:, i] - corners[:, j] for i in range(4) for j in range(i)]
    longest = np.max([np.linalg.norm(edge, axis=1) for edge in edges], axis=0)
    size = 0.1 + x / 2
    expected = longest > size[np.asarray(mesh.cells)].mean(axis=1)
    assert 0 < total(expected.sum()) < total(len(expected))
    assert np.array_equal(octetra.mark.size(mesh, size), expected)
    assert np.array_equal(octetra.mark.size(mesh, "2 * size(h)", vertex_fields={"h": size / 2}), expected)
    assert np.array_equal(octetra.mark.size(mesh, 0.3), longest > 0.3)
    # A metric that is isotropic: lengths are divided by the size.
    metric = np.zeros((len(x), 6))
    metric[:, :3] = 1 / 0.3**2
    assert np.array_equal(octetra.mark.size(mesh, metric), longest > 0.3)
    # The sizes of cells grow from that of a corner.
    near = (corners.mean(axis=1) < 0.2).all(axis=1)
    sharp = np.where(near, 0.01, 9.0)
    graded = octetra.mark.size(mesh, "size(h)", 1.5, cell_fields={"h": sharp})
    assert total((longest > sharp).sum()) < total(graded.sum())
    assert np.array_equal(octetra.mark.size(mesh, "size(h)", 1e6, cell_fields={"h": sharp}), longest > sharp)


def test_a_background_keeps_its_values_when_the_mesh_changes(mesh):
    linear = 0.1 + mesh.points @ [0.2, -0.05, 0.1]
    background = mesh.as_background("h", linear)
    least = mesh.as_background("least", cell_values=np.arange(len(mesh.cells)))
    mesh.refine()
    mesh.rebalance(most_over_mean=1.0)
    expected = 0.1 + mesh.points[mesh.cells].mean(axis=1) @ [0.2, -0.05, 0.1]
    assert np.allclose(mesh.cell_values("background(h)", backgrounds=[background]), expected, rtol=1e-13)
    marked = octetra.mark.size(mesh, "background(h)", backgrounds=[background])
    longest = mesh.cell_values("longest")
    is_clear = np.abs(longest - expected) > 1e-12
    assert np.array_equal(marked[is_clear], (longest > expected)[is_clear]) and 0 < total(marked.sum())
    both = octetra.mark.where(mesh, "background(least) >= 0 and background(h) > 0", None, None,
                              [least, background])
    assert both.all()
    with pytest.raises(octetra.InputError, match="no such background mesh; there are h"):
        mesh.cell_values("background(g)", backgrounds=[background])


def test_regions_have_the_names_of_the_file(folder):
    box = pathlib.Path(__file__).resolve().parents[2] / "corpus/meshes/gmsh-box-22.msh"
    mesh = octetra.read(box)
    assert (3, 7, "steel") in mesh.group_names and (2, 4, "interface") in mesh.group_names
    steel = octetra.mark.region(mesh, "steel")
    assert np.array_equal(steel, octetra.mark.region(mesh, 7)) and total(steel.sum()) > 0
    mesh.refine(steel)
    mesh.write(folder / "out.msh")
    command("refine", box, "--region", "steel", "-o", folder / "expected.msh")
    assert same(folder / "out.msh", folder / "expected.msh")
    with pytest.raises(octetra.InputError, match="'glass' of cells; the groups are air above, steel"):
        octetra.mark.region(mesh, "glass")
    without = octetra.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                                  [[0, 1, 2, 3]] if world.rank == 0 else [])
    assert without.group_names == []
    with pytest.raises(octetra.InputError, match="has a name"):
        octetra.mark.region(without, "steel")


@pytest.mark.parametrize("kind", (bool, np.int8, np.uint16, np.int64, list))
def test_marks_are_booleans_or_whole_numbers_of_any_type(folder, cube, kind):
    files = []
    for number, form in enumerate((bool, kind)):
        mesh = octetra.read(cube)
        marks = near(mesh, 0.5)
        if form is list:
            marks = marks.tolist()
        elif form is not bool:
            marks = np.stack([marks.astype(form) * 64, marks.astype(form)], axis=1)[:, 0]  # strided
        mesh.refine(marks)
        mesh.write(folder / f"{number}.mesh")
        files.append(folder / f"{number}.mesh")
    assert same(*files)


def test_cells_that_are_listed_are_marked_and_none_marks_nothing(folder, cube):
    first, second = octetra.read(cube), octetra.read(cube)
    marks = near(first, 0.5)
    first.refine(marks if marks.any() else None)
    second.refine(cells=np.flatnonzero(marks)[::-1])
    assert np.array_equal(first.cells, second.cells)
    assert not first.refine().changed


def test_edges_are_bisected(mesh):
    edges = mesh.number_edges()
    ends = edges.vertices[edges.numbers == 5]
    step = mesh.refine_edges(ends)
    assert step.changed
    new = step.new_vertex_ends
    assert all((new == pair).all(axis=1).any() for pair in ends)


def test_a_step_returns_ancestors(mesh):
    for radius in (0.9, 0.2):
        cells, points = mesh.cells, mesh.points
        step = mesh.refine(near(mesh, radius))
        assert (step.cells.count_before, step.cells.count) == (len(cells), len(mesh.cells))
        parents = step.cells.parents
        low, high = points[cells].min(axis=1)[parents], points[cells].max(axis=1)[parents]
        middle = centroids(mesh)
        assert ((low <= middle) & (middle <= high)).all()
    before, points = len(mesh.cells), mesh.points
    step = mesh.coarsen(np.ones(before, np.uint8))
    assert step.is_coarser
    assert step.cells.coarse_of.shape == step.cells.halvings.shape == (before,)
    assert step.cells.coarse_of.max(initial=0) < max(1, len(mesh.cells))
    assert np.array_equal(points[step.vertices_before], mesh.points)
    with pytest.raises(octetra.InputError):
        step.cells.parents


def volumes(mesh):
    return octetra.quality.volume(mesh)


def test_values_go_along_with_every_step(mesh):
    def linear(m):
        return np.stack([m.points @ [1, 2, 3], m.points @ [3, 0, 1]], axis=1)

    u, mass, density = linear(mesh), volumes(mesh), np.full(len(mesh.cells), 3.0, np.float32)
    for step in (mesh.refine, mesh.refine, mesh.coarsen):
        told = step(near(mesh, 0.6))
        u = told.transfer_vertices(u)
        mass = told.transfer_cells(mass, how="divided")
        density = told.transfer_cells(density, how="averaged")
        assert np.allclose(u, linear(mesh)) and u.shape == (len(mesh.points), 2)
        assert np.allclose(mass, volumes(mesh))
        assert density.dtype == np.float32 and np.all(density == 3)
        u += 0.0  # it belongs to the program
    with pytest.raises(ValueError):
        told.transfer_vertices(np.zeros(told.vertex_count_before + 1))
    with pytest.raises(octetra.InputError):
        told.transfer_cells(np.zeros(told.cells.count_before, np.int16))


def integral(mesh, u):
    return total((volumes(mesh)[:, None] * u[mesh.cells]).sum() / 4)


def test_coarsening_keeps_integrals_where_it_is_asked_to(mesh):
    for _ in range(2):
        mesh.refine(near(mesh, 0.6))
    u = np.sin(40 * mesh.points[:, 0]) + 1j * np.cos(30 * mesh.points[:, 1])
    q = np.exp(1j * centroids(mesh)[:, 2] * 50)
    expected, of_cells = integral(mesh, u), total((q * volumes(mesh)).sum())
    step = mesh.coarsen(near(mesh, 0.5))
    owned = mesh.vertex_sharing.owners == world.rank
    assert step.changed and np.isclose(total(mesh.vertex_volumes()[owned].sum()), 1)
    interpolated = step.transfer_vertices(u)
    kept = mesh.transfer_conservatively(step, u)
    assert kept.dtype == interpolated.dtype == np.complex128
    assert abs(integral(mesh, kept) - expected) < 1e-13 < 1e-6 < abs(
        integral(mesh, interpolated) - expected)
    assert abs(total((step.transfer_cells(q) * volumes(mesh)).sum()) - of_cells) < 1e-13
    with pytest.raises(octetra.InputError, match="real or complex"):
        mesh.transfer_conservatively(step, np.zeros(step.vertex_count_before, np.int64))
    mesh.refine(near(mesh, 0.3))
    with pytest.raises(octetra.InputError, match="did not lead to the current mesh"):
        mesh.transfer_conservatively(step, u)


def test_whole_numbers_are_preserved(mesh):
    tags, tenths = np.full(len(mesh.cells), 7, np.int32), np.full(len(mesh.cells), 0.1)
    for step in (mesh.refine, mesh.refine, mesh.coarsen):
        told = step(near(mesh, 0.6))
        if step == mesh.refine:
            with pytest.raises(ValueError, match="mean"):
                told.transfer_vertices(np.zeros(told.vertex_count_before, np.int64))
            with pytest.raises(ValueError, match="divided"):
                told.transfer_cells(tags, how="divided")
        tags, tenths = told.transfer_cells(tags), told.transfer_cells(tenths)
        assert np.all(tags == 7) and np.all(tenths == 0.1) and tags.dtype == np.int32


def test_values_move_with_cells_and_vertices(mesh):
    mesh.refine(near(mesh, 0.5))
    tags = mesh.root_of_cells.astype("S5")
    roots = mesh.roots[mesh.root_of_cells]
    points, middles = mesh.points.copy(), centroids(mesh)
    move = mesh.migrate((mesh.roots % world.size).astype(np.int8))
    assert move.changed == (world.size > 1)
    assert np.array_equal(move.vertices(points), mesh.points)
    assert np.array_equal(move.cells(middles), centroids(mesh))
    assert np.array_equal(move.cells(roots), mesh.roots[mesh.root_of_cells])
    assert move.cells(tags).dtype == tags.dtype
    assert np.all(mesh.roots % world.size == world.rank)


def test_rebalancing_evens_out_the_ranks_and_changes_no_file(folder, cube):
    mesh, still = octetra.read(cube), octetra.read(cube)
    for m in (mesh, still):
        for _ in range(2):
            m.refine(near(m, 0.5))
    move = mesh.rebalance()
    most = world.allreduce(len(mesh.cells), op=MPI.MAX)
    assert world.size == 1 or (move.changed and most <= 1.2 * total(len(mesh.cells)) / world.size)
    mesh.write(folder / "moved.mesh")
    still.write(folder / "still.mesh")
    assert same(folder / "moved.mesh", folder / "still.mesh")


def test_a_balanced_step_returns_migration_and_adaptation(folder, cube):
    mesh, other = octetra.read(cube), octetra.read(cube)
    marks = near(mesh, 0.5)
    points = mesh.points
    move, step = mesh.refine_evenly(marks, most_over_mean=1.0)
    other.refine(marks)
    assert np.allclose(step.transfer_vertices(move.vertices(points)), mesh.points)
    mesh.write(folder / "even.mesh")
    other.write(folder / "other.mesh")
    assert same(folder / "even.mesh", folder / "other.mesh")


def test_cells_may_replace_roots_that_are_too_heavy(folder, cube):
    mesh, other = octetra.read(cube), octetra.read(cube)
    roots = total(len(mesh.roots))
    for radius in (0.9, 0.5, 0.28, 0.15, 0.08, 0.04):
        mesh.refine_evenly(octetra.mark.sphere(mesh, (0, 0, 0), radius), most_over_mean=1.0,
                           may_forget_history=True)
        other.refine(octetra.mark.sphere(other, (0, 0, 0), radius))
    mesh.rebalance(most_over_mean=1.0, may_forget_history=True)
    assert world.size == 1 or total(len(mesh.roots)) > roots
    mesh.write(folder / "even.mesh")
    other.write(folder / "other.mesh")
    assert same(folder / "even.mesh", folder / "other.mesh")

    assert mesh.has_forgotten_history == (world.size > 1)
    points = np.array(mesh.points)
    while mesh.has_forgotten_history:
        points = mesh.recall_history().vertices(points)
    assert np.array_equal(points, mesh.points)
    assert total(len(mesh.roots)) == roots
    for _ in range(3):
        mesh.coarsen(np.ones(len(mesh.cells), bool))
        other.coarsen(np.ones(len(other.cells), bool))
    mesh.save(folder / "even.octetra")
    other.save(folder / "other.octetra")
    assert same(folder / "even.octetra", folder / "other.octetra")


def test_a_mesh_is_saved_with_fields_and_continues(folder, mesh):
    mesh.refine(near(mesh, 0.5))
    u, q = mesh.points[:, 0].copy(), centroids(mesh).astype(np.float32)
    mesh.save(folder / "state.octetra", vertex_fields={"u": u}, cell_fields={"q": q})
    again, on_vertices, on_cells = octetra.load_with_fields(folder / "state.octetra")
    assert list(on_vertices) == ["u"] and list(on_cells) == ["q"]
    assert np.array_equal(on_vertices["u"], again.points[:, 0])
    assert np.array_equal(on_cells["q"], centroids(again).astype(np.float32))
    plain = octetra.load(folder / "state.octetra", partition="block")
    read = octetra.read(folder / "state.octetra")
    assert mesh.write(folder / "written.octetra", vertex_fields={"u": u}, cell_fields={"q": q}) == ""
    assert same(folder / "written.octetra", folder / "state.octetra")
    for number, m in enumerate((mesh, again, plain, read)):
        m.coarsen(near(m, 0.3))
        m.write(folder / f"{number}.mesh")
        assert same(folder / f"{number}.mesh", folder / "0.mesh")


def test_a_checkpoint_keeps_the_time_the_step_and_a_text(folder, mesh):
    mesh.refine(near(mesh, 0.5))
    mesh.save(folder / "plain.octetra")
    mesh.save(folder / "state.octetra", time=0.5, step=-7, text='{"dt": 0.1,\n "name": "Größe"}')
    assert octetra.saved_state(folder / "plain.octetra") is None
    assert octetra.saved_state(folder / "state.octetra") == {
        "time": 0.5, "step": -7, "text": '{"dt": 0.1,\n "name": "Größe"}'}
    sizes = [(folder / f"{name}.octetra").stat().st_size for name in ("plain", "state")]
    assert sizes[1] - sizes[0] == 24 + len('{"dt": 0.1,\n "name": "Größe"}'.encode())
    again = octetra.load(folder / "state.octetra")
    again.write(folder / "again.mesh")
    mesh.write(folder / "mesh.mesh")
    assert same(folder / "again.mesh", folder / "mesh.mesh")
    if world.rank == 0:
        shown = run_alone(PROGRAM, "info", folder / "state.octetra")
        assert "time 0.5, step -7" in shown and '"name": "Größe"}' in shown
    for wrong in ({"time": float("nan")}, {"text": "\x1b[2J"}, {"step": 2**70}, {"time": "late"}):
        with pytest.raises(octetra.InputError):
            mesh.save(folder / "state.octetra", **wrong)
    if world.size > 1:
        with pytest.raises(octetra.InputError, match="different times, steps or texts"):
            mesh.save(folder / "state.octetra", step=world.rank)
    assert octetra.saved_state(folder / "state.octetra")["step"] == -7


def test_one_name_may_be_on_vertices_and_on_cells(folder, mesh, monkeypatch):
    mesh.refine(near(mesh, 0.5))
    mesh.save(folder / "state.octetra", vertex_fields={"u": mesh.vertex_numbers.astype(np.int64)},
              cell_fields={"u": np.full((len(mesh.cells), 2), 0.5, np.float32)})
    again, on_vertices, on_cells = octetra.load_with_fields(folder / "state.octetra")
    assert np.array_equal(on_vertices["u"], again.vertex_numbers) and on_cells["u"].shape[1] == 2
    monkeypatch.syspath_prepend(pathlib.Path(__file__).resolve().parents[2] / "tools")
    points, cells, on_vertices, on_cells = importlib.import_module("read_checkpoint").read(
        folder / "state.octetra")
    assert np.array_equal(on_vertices["u"][:, 0], np.arange(len(points)))
    assert on_cells["u"].shape == (len(cells), 2) and (on_cells["u"] == 0.5).all()


def test_fields_are_written_for_vtk(folder, mesh):
    lost = mesh.write(folder / "mesh.vtu", vertex_fields={"u": mesh.points},
                      cell_fields={"rank": np.full(len(mesh.cells), 3, np.int32)})
    assert "tagged facets" in lost
    text = (folder / "mesh.vtu").read_bytes()
    assert b'Name="u"' in text and b'Name="rank"' in text
