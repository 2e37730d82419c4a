"""Adaptive runs in other programs, and the cost of transferring a mesh to them."""

from measuring import BEGUN_AGAIN, Case, Figure, driver, median, script
from peers import name_of

RANKS = (1, 2)
PATIENCE = 1200  # seconds for a program that sometimes hangs, and otherwise takes seven minutes
RUN, HAND_OVER, PLEX = "bench/python/adaptive_run.py", "bench/python/hand_over.py", "bench/peers/peer_dmplex"


def ranks_text(ranks):
    return name_of("", ranks)[2:]


# --- a run with DOLFINx


def total(lines, key):
    return sum(median(lines, "levels", level, key) for level in range(len(lines[0]["levels"])))


def common_levels(lines):
    """Steps that all runs have made; DOLFINx begins none after two minutes in the mesh part."""
    return min(len(line["levels"]) for of_run in lines.values() for line in of_run)


def run_figures(lines):
    steps = common_levels(lines)
    cells = [level["cells"] for level in lines[name_of("octetra", 1)][0]["levels"]]
    made = [Figure("steps of both", steps, ""), Figure("cells in the end", cells[steps - 1], "")]
    for ranks in RANKS:
        of, words = {p: lines[name_of(p, ranks)] for p in ("octetra", "DOLFINx")}, ranks_text(ranks)
        of = {program: cut(of_run, steps) for program, of_run in of.items()}
        ours, theirs = (total(of[program], "seconds") for program in ("octetra", "DOLFINx"))
        last = [median(of[program], "levels", -1, "seconds") for program in ("octetra", "DOLFINx")]
        made += [Figure(f"the mesh, octetra, {words}", ours, "s"),
                 Figure(f"of that handing over, {words}", total(of["octetra"], "hand_over_seconds"), "s"),
                 Figure(f"the mesh, DOLFINx, {words}", theirs, "s"),
                 Figure(f"the mesh: speed against DOLFINx, {words}", theirs / ours, "times", at_least=50),
                 Figure(f"the same of the last step, {words}", last[1] / last[0], "times")]
        made += [Figure(f"all else, {program}, {words}", total(of[program], "other_seconds"), "s")
                 for program in of]
    for step in range(steps):
        made += [Figure(f"step {step + 1}, {cells[step]:,} cells: speed against DOLFINx, {ranks_text(ranks)}",
                        median(lines[name_of("DOLFINx", ranks)], "levels", step, "seconds")
                        / median(lines[name_of("octetra", ranks)], "levels", step, "seconds"), "times")
                 for ranks in RANKS]
    memory = [median(lines[name_of(program, 1)], "peak_bytes") for program in ("DOLFINx", "octetra")]
    again = sum(line[BEGUN_AGAIN] for of_run in lines.values() for line in of_run)
    return made + [Figure("peak memory of the whole run with DOLFINx's refine against ours, 1 rank",
                          memory[0] / memory[1], "times"),
                   Figure("runs that crashed or did not end, and were begun again", again, "")]


def cut(of_run, steps):
    return [line | {"levels": line["levels"][:steps]} for line in of_run]


def other_cells(lines):
    """Lists the runs whose cells differ from those of the first in common steps; there must be
    none."""
    steps = common_levels(lines)
    found = {name: [level["cells"] for level in line["levels"][:steps]]
             for name, of_run in lines.items() for line in of_run}
    expected = next(iter(found.values()))
    return [f"{name} has {cells} cells, not {expected}" for name, cells in found.items()
            if cells != expected]


def run_in_dolfinx(cubes, steps):
    return Case("a run of adaptive steps in DOLFINx", [
        script(name_of(program, ranks), RUN, f"{program.lower()} --cubes {cubes} --steps {steps}", ranks,
               PATIENCE)
        for ranks in RANKS for program in ("octetra", "DOLFINx")], run_figures, wrong=other_cells, at_most=1)


# --- handing over


def hand_over_figures(lines):
    made = []
    for ranks in RANKS:
        of_run, words = lines[ranks_text(ranks)], ranks_text(ranks)
        create = median(of_run, "ways", "create_mesh, no ghosts", "seconds")
        made += [Figure(f"cells, {words}", of_run[0]["cells"], ""),
                 Figure(f"create_mesh of DOLFINx, {words}", create, "s")]
        for way in ("to_mesh, no ghosts", "to_mesh, ghosts by face", "from_mesh"):
            spent = median(of_run, "ways", way, "seconds")
            made += [Figure(f"{way}, {words}", 1e3 * spent, "ms"),
                     Figure(f"{way}, of create_mesh, {words}", spent / create, "times", at_most=2)]
    return made


def hand_over_to_dolfinx(cubes):
    """Each run is the minimum of five."""
    return Case("handing a mesh to DOLFINx", [
        script(ranks_text(ranks), HAND_OVER, str(cubes), ranks, PATIENCE) for ranks in RANKS],
        hand_over_figures, at_most=1)


# --- DMPlex


def plex_figures(lines):
    made = []
    for ranks in RANKS:
        of_run, words = lines[ranks_text(ranks)], ranks_text(ranks)
        for level, first in enumerate(of_run[0]["dmplex"]):
            at = f"{first['cells']:,} cells"
            theirs = median(of_run, "dmplex", level, "seconds")
            refine = median(of_run, "octetra", level, "refine_seconds")
            both = median(of_run, "octetra", level, "seconds")
            made += [Figure(f"{at}: DMRefine, {words}", theirs, "s"),
                     Figure(f"{at}: refine, {words}", refine, "s"),
                     Figure(f"{at}: refine and to_plex, {words}", both, "s"),
                     Figure(f"{at}: speed of refine against DMRefine, {words}", theirs / refine, "times",
                            at_least=50 if first is of_run[0]["dmplex"][-1] else None),
                     Figure(f"{at}: the same with to_plex, {words}", theirs / both, "times")]
        made.append(Figure(f"to_plex against DMPlexCreateFromCellListParallelPetsc of the same cells, {words}",
                           median(of_run, "cell_list", "hand_over_seconds") / median(of_run, "cell_list", "seconds"),
                           "times", at_most=2))
    return made


def other_cells_of_plex(lines):
    return [f"{name}: DMPlex has {theirs['cells']} cells, octetra {ours['cells']}"
            for name, of_run in lines.items() for line in of_run
            for theirs, ours in zip(line["dmplex"], line["octetra"], strict=True)
            if theirs["cells"] != ours["cells"]]


def beside_dmplex(cubes, levels, seconds):
    return Case("beside DMPlex, which refines all cells or none", [
        driver(ranks_text(ranks), PLEX, f"{cubes} {levels} {seconds}", ranks, patience=PATIENCE)
        for ranks in RANKS], plex_figures, wrong=other_cells_of_plex, at_most=1)
