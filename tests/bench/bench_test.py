"""Tests of the results that ./dev bench makes from the output of its programs, and of that output."""

import copy
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
RUN = os.path.join(ROOT, "bench", "run")
sys.path[:0] = [RUN, os.path.join(ROOT, "tools", "equivalence"), os.path.join(ROOT, "bench", "paper"),
                os.path.join(ROOT, "bench")]

import adaptive  # noqa: E402
import files  # noqa: E402
import groups  # noqa: E402
import kept  # noqa: E402
import peers  # noqa: E402
import propagation  # noqa: E402
import prose  # noqa: E402
import results  # noqa: E402
from measuring import (Case, Figure, Run, measure, median, median_ratio,  # noqa: E402
                       printed_by, spread_figure)
from slopes import slope, steepest  # noqa: E402
from running import Failure  # noqa: E402


class Slopes(unittest.TestCase):
    def test_are_the_exponents_of_powers(self):
        xs = [10, 300, 5000, 2e6]
        for exponent in (0.5, 1, 1.05, 2):
            ys = [7 * x ** exponent for x in xs]
            self.assertAlmostEqual(slope(xs, ys), exponent)
            self.assertAlmostEqual(steepest(xs, ys), exponent)

    def test_show_a_late_rise_behind_a_high_beginning(self):
        xs, ys = [1, 10, 100, 1000], [50, 50, 100, 2000]
        self.assertLess(slope(xs, ys), 1)
        self.assertGreater(steepest(xs, ys), 1.25)


class Tries(unittest.TestCase):
    # Waits in its first runs, up to the number in the first argument (a file keeps count), and then
    # prints.
    WAITS = ("n=$(cat count 2>/dev/null || echo 0); echo $((n + 1)) > count; "
             "if [ $n -lt $0 ]; then exec sleep 60; fi; echo done; exit $1")

    def printed(self, waits, status, patience, tries=1):
        with tempfile.TemporaryDirectory() as folder:
            try:
                return printed_by(["sh", "-c", self.WAITS, str(waits), str(status)], folder,
                                  patience)
            finally:
                with open(os.path.join(folder, "count"), encoding="utf-8") as count:
                    self.assertEqual(int(count.read()), tries)

    def test_of_hanging_programs_are_several(self):
        self.assertEqual(self.printed(2, 0, 0.5, tries=3), ("done\n", 2))
        self.assertEqual(self.printed(0, 0, 0.5), ("done\n", 0))

    def test_of_programs_that_always_hang_are_six(self):
        with self.assertRaisesRegex(Failure, "ended after 0.2 s"):
            self.printed(9, 0, 0.2, tries=6)

    def test_of_crashing_programs_are_several(self):
        for end in ("kill -SEGV $$", "exit 139",
                    "echo '*** An error occurred in MPI_Waitany' >&2; exit 15"):
            with tempfile.TemporaryDirectory() as folder:
                words = f"if [ -e was ]; then echo done; exit; fi; touch was; {end}"
                self.assertEqual(printed_by(["sh", "-c", words], folder, 5), ("done\n", 1), end)

    def test_of_failing_programs_are_one(self):
        with self.assertRaisesRegex(Failure, "status 3"):
            self.printed(0, 3, 0.5)
        with self.assertRaisesRegex(Failure, "status 3"):
            self.printed(0, 3, None)


class SentencesOfPages(unittest.TestCase):
    FIGURES = {"times a/b": [0.5, 12.34], "none": []}

    def told(self, text):
        return prose.told(text, self.FIGURES.__getitem__)

    def test_have_the_figures_that_they_ask_for(self):
        self.assertEqual(self.told("It is @times a/b@ and\nat most @most times a/b@."), "It is 0.5 to 12.3 and at most 12.3.\n")

    def test_are_kept_only_while_their_conditions_hold(self):
        self.assertEqual(self.told("So.\n<!-- holds: times a/b > 0.4 -->\n<!-- holds: some times a/b < 1 -->\n"), "So.\n")
        for wrong in ("times a/b > 0.6", "some times a/b < 0.5", "times a/b = 0.5", "none > 0"):
            with self.assertRaisesRegex(prose.NotTrue, "line 2: "):
                self.told(f"So.\n<!-- holds: {wrong} -->\n")

    def test_are_wrapped_again_but_not_in_a_link_and_not_in_a_table(self):
        link, table = "[" + "link " * 5 + "it](there.md)", "| " + "cell " * 40 + "|"
        lines = self.told("word\n" * 21 + link + f"\n\n{table}").splitlines()
        self.assertEqual(lines, [" ".join(["word"] * 21), link, "", table])


class Figures(unittest.TestCase):
    def test_are_medians_of_alternating_runs(self):
        order, values = [], {"a": iter([9, 1, 3]), "b": iter([2, 2, 8])}

        def run(name):
            def line(_):
                order.append(name)
                return {"levels": [{"seconds": next(values[name])}]}
            return Run(name, line)
        case = Case("both", [run("a"), run("b")], lambda lines: [
            Figure(name, median(of_run, "levels", -1, "seconds"), "s")
            for name, of_run in lines.items()])
        made = measure(case, None, 3)
        self.assertEqual(order, ["a", "b"] * 3)
        self.assertEqual([figure["value"] for figure in made["figures"]], [3, 2])
        self.assertEqual([run["times"] for run in made["runs"]], [3, 3])

    def test_of_ratios_compare_runs_of_the_same_turn(self):
        # Twice as fast throughout, but the machine was slow in the second turn of the one and in
        # the third turn of the other.
        slow, fast = [{"s": 10}, {"s": 30}, {"s": 10}], [{"s": 5}, {"s": 5}, {"s": 15}]
        self.assertEqual(median_ratio(slow, fast, "s"), 2)
        with self.assertRaises(ValueError):
            median_ratio(slow, fast[:2], "s")

    def test_of_short_runs_use_more_repetitions(self):
        case = Case("short", [Run("a", lambda _: {})], lambda lines: [], multiple=3)
        self.assertEqual(measure(case, None, 5)["runs"][0]["times"], 15)

    def test_show_the_dispersion_of_runs(self):
        lines = [{"s": value} for value in (3, 1, 8)]
        case = {"name": "a case", "figures": [spread_figure("time", "s", lines, "s").as_dict()]}
        self.assertEqual(list(results.rows(case, quick=False)),
                         ["| a case | time | 3 s (1 to 8) |  |  |"])

    def test_count_the_time_of_files_once(self):
        # While one rank reads, the other waits.
        def of_rank(*seconds):
            return {"of_rank": seconds}
        profile = {"phases": [
            {"phase": "read", "computing_seconds": of_rank(3, 0),
             "communicating_seconds": of_rank(0, 3)},
            {"phase": "write", "computing_seconds": of_rank(1, 2),
             "communicating_seconds": of_rank(1, 1)},
            {"phase": "write", "computing_seconds": of_rank(1, 2),
             "communicating_seconds": of_rank(0, 0)}]}
        self.assertEqual(files.of_phase(profile, "read"), 3)
        self.assertEqual(files.of_phase(profile, "write"), 5)

    def test_meet_their_targets_or_do_not(self):
        self.assertTrue(Figure("", 3, "", at_most=3).as_dict()["met"])
        self.assertFalse(Figure("", 3.1, "", at_most=3).as_dict()["met"])
        self.assertTrue(Figure("", 3, "", at_least=3).as_dict()["met"])
        self.assertFalse(Figure("", 2.9, "", at_least=3).as_dict()["met"])
        self.assertNotIn("met", Figure("", 3, "").as_dict())

    def test_of_a_peer_with_other_cells_are_called_wrong(self):
        def lines(ours, theirs):
            return {"octetra, 1 rank": [{"levels": [{"cells": ours}]}],
                    "DOLFINx, 1 rank": [{"levels": [{"cells": theirs}]}]}
        self.assertEqual(peers.other_counts(lines(8, 8)), [])
        self.assertEqual(len(peers.other_counts(lines(8, 9))), 1)

    def adaptive_run(self, cells, seconds, handing=0.0):
        return [{"levels": [{"cells": c, "seconds": seconds * c, "hand_over_seconds": handing, "other_seconds": 1}
                            for c in cells], "peak_bytes": 1, "begun_again": 0}]

    def test_of_adaptive_runs_are_of_the_steps_that_all_have_made(self):
        lines = {f"{program}, {words}": self.adaptive_run(cells, seconds, 0.5)
                 for words in ("1 rank", "2 ranks")
                 for program, cells, seconds in (("octetra", [2, 8, 20], 1), ("DOLFINx", [2, 8], 60))}
        self.assertEqual(adaptive.other_cells(lines), [])
        found = {figure.name: figure for figure in adaptive.run_figures(lines)}
        self.assertEqual((found["steps of both"].value, found["cells in the end"].value), (2, 8))
        speed = found["the mesh: speed against DOLFINx, 2 ranks"]
        self.assertEqual((speed.value, speed.at_least), (60, 50))
        self.assertEqual(found["of that handing over, 1 rank"].value, 1)
        lines["DOLFINx, 2 ranks"] = self.adaptive_run([2, 9], 60)
        self.assertEqual(adaptive.other_cells(lines), ["DOLFINx, 2 ranks has [2, 9] cells, not [2, 8]"])

    def test_of_long_runs_use_few_repetitions(self):
        case = Case("long", [Run("a", lambda _: {})], lambda lines: [], at_most=1)
        self.assertEqual(measure(case, None, 5)["runs"][0]["times"], 1)


WHAT_COUNTS = ("processor", "cores", "memory_bytes", "system", "mpi", "compiler", "build", "commit")


def made(commit="abc", quick=False, date="now", names=("growth",), value=1.0):
    figure = Figure("time", value, "s", at_most=2).as_dict()
    case = {"name": "a case", "runs": [], "figures": [figure], "points": [], "wrong": []}
    machine = {key: "x" for key in WHAT_COUNTS} | {"commit": commit, "date": date, "load": 0.1,
                                                 "cores": 2, "memory_bytes": 8e9}
    return {"format": "octetra bench", "version": 2, "quick": quick, "machine": machine,
            "groups": [{"name": name, "about": "", "repetitions": 5, "cases": [case]}
                       for name in names]}


class Table(unittest.TestCase):
    def table(self, **options):
        return results.results(kept.with_old(made(**options), None, groups.NAMES))

    def test_reports_which_targets_are_met(self):
        self.assertIn("| a case | time | 1 s | at most 2 s | met |", self.table())
        self.assertIn("| a case | time | 3 s | at most 2 s | **not met** |", self.table(value=3.0))

    def test_holds_no_target_against_small_meshes(self):
        self.assertIn("| a case | time | 3 s |  |  |", self.table(value=3.0, quick=True))

    def test_warns_where_other_programs_ran(self):
        busy = kept.with_old(made(), None, groups.NAMES)
        self.assertNotIn("no measure", results.results(busy))
        busy["machine"]["load"] = 1.5
        self.assertIn("no measure", results.results(busy))


class OldResults(unittest.TestCase):
    def names_with(self, old, new):
        old = kept.with_old(old, None, groups.NAMES)
        return [group["name"] for group in kept.with_old(new, old, groups.NAMES)["groups"]]

    def test_are_none_where_there_is_no_such_file(self):
        self.assertIsNone(kept.load("/nowhere"))

    def test_of_the_same_commit_and_machine_are_kept(self):
        both = self.names_with(made(names=("peers", "files")), made(names=("growth", "files")))
        self.assertEqual(both, ["growth", "files", "peers"])

    def test_stay_at_the_position_of_their_case(self):
        def cases(*names_and_values):
            return [{"name": name, "value": value} for name, value in names_and_values]
        self.assertEqual(kept.merged(cases(("a", 1), ("b", 1)), cases(("c", 2), ("a", 2))),
                         cases(("a", 2), ("b", 1), ("c", 2)))

    def test_of_anything_else_are_left_out(self):
        self.assertEqual(self.names_with(made("old", names=["peers"]), made("new")), ["growth"])
        self.assertEqual(self.names_with(made(quick=True, names=["peers"]), made()), ["growth"])
        # "with changes" may be different changes
        changed = "abc and changes"
        self.assertEqual(self.names_with(made(changed, names=["peers"]), made(changed)), ["growth"])
        for key in WHAT_COUNTS:
            other = copy.deepcopy(made(names=["peers"]))
            other["machine"][key] = "another"
            self.assertEqual(self.names_with(other, made()), ["growth"], key)


class Programs(unittest.TestCase):
    """The smallest meshes, with the programs as built."""

    def run_only(self, folder, *only):
        return subprocess.run([sys.executable, RUN, "--build", os.environ["OCTETRA_BUILD"],
                               "-o", folder, "--quick", "--only", *only],
                              capture_output=True, text=True, check=False)

    def cases_of(self, *only):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_only(folder, *only)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
                found = json.load(file)
            with open(os.path.join(folder, "RESULTS.md"), encoding="utf-8") as file:
                self.assertIn("| case | figure | value |", file.read())
        return {case["name"]: case for group in found["groups"] for case in group["cases"]}

    def test_print_valid_output(self):
        cases = self.cases_of("growth", "around a point", "sphere", "whole program")
        for name in ("with cells", "with cells, memory at hand"):
            self.assertEqual([p["cells"] for p in cases[name]["points"]],
                             [8 * 6 * n ** 3 for n in (6, 12, 24)])
        self.assertEqual([p["ranks"] for p in cases["with ranks"]["points"]], [1, 2, 4])
        # One rank has no other to communicate with; two have.
        self.assertEqual(cases["with ranks"]["points"][0]["bytes"], 0)
        self.assertGreater(cases["with ranks"]["points"][1]["bytes"], 0)
        self.assertEqual(len(cases["around a point"]["points"]), 4)
        for case in cases.values():
            for figure in case["figures"]:
                self.assertGreaterEqual(figure["value"], 0, figure)

    @unittest.skipUnless(os.path.exists(os.path.join(os.environ["OCTETRA_BUILD"], "bench/peers/peer_dmplex"))
                         and os.path.exists("/usr/lib/petscdir"), "needs DOLFINx and PETSc")
    def test_run_beside_other_programs(self):
        cases = self.cases_of("run of adaptive", "handing a mesh", "DMPlex", "--peers")
        self.assertEqual(len(cases), 3)
        for case in cases.values():
            self.assertEqual(case["wrong"], [])
            for figure in case["figures"]:
                self.assertGreaterEqual(figure["value"], 0, figure)

    def test_report_missing_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_only(folder, "nonsense")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no case has nonsense in its name", done.stderr)


class Rival(unittest.TestCase):
    def rivals(self, *arguments):
        return subprocess.run([sys.executable, os.path.join(ROOT, "bench", "rivals"), *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)

    def test_has_a_page_generated_from_measurements(self):
        self.assertEqual(self.rivals("check").returncode, 0)

    def test_refuses_unknown_entries(self):
        self.assertEqual(self.rivals("measure", "--slow").returncode, 2)


class Paper(unittest.TestCase):
    def paper(self, *arguments):
        return subprocess.run([sys.executable, os.path.join(ROOT, "bench", "paper"), *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)

    def test_has_a_page_generated_from_measurements(self):
        self.assertEqual(self.paper("check").returncode, 0)

    def test_refuses_unknown_entries(self):
        self.assertEqual(self.paper("measure", "--slow").returncode, 2)

    def test_finds_the_counts_that_it_foresees(self):
        done = self.paper("measure", "--quick", "--build", os.environ["OCTETRA_BUILD"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| small, run 2 | 99,121 | 23,351 |", done.stdout)


class Closure(unittest.TestCase):
    """Tests of the sweeps counted by bench/paper."""
    # A cell whose edges are all of different lengths, and one behind the face 0 1 2.
    POINTS = [(0, 0, 0), (8, 0, 0), (1, 6, 0), (2, 1, 5), (2, 2, -9)]
    CELLS = [(0, 1, 2, 3), (0, 1, 2, 4)]

    def test_marks_the_longest_edges_of_faces(self):
        edges = propagation.Edges(self.POINTS, self.CELLS)
        closed, sweeps = propagation.closure(edges, {edges.number[0, 3]})
        # The longest edges of its faces are 0 1 and 2 3; from there closure marks 1 2, and 1 4 of
        # the other cell.
        self.assertEqual(closed, {edges.number[edge] for edge in [(0, 3), (0, 1), (2, 3), (1, 2), (1, 4)]})
        self.assertEqual(sweeps, 2)

    def test_cuts_a_cell_in_eight(self):
        made = propagation.predicted(self.POINTS[:4], self.CELLS[:1], [0])
        self.assertEqual((made["cells"], made["vertices"], made["sweeps"], made["cells_cut"]), (8, 10, 0, 1))

    def test_is_in_the_strict_order_where_lengths_tie(self):
        edges = propagation.Edges([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2, 3)])
        # Among equal edges the one whose smaller end is larger is the longer one: (0,1,0) to
        # (1,0,0), not (0,0,1).
        self.assertGreater(edges.number[1, 2], edges.number[1, 3])
        self.assertGreater(edges.number[1, 3], edges.number[2, 3])


if __name__ == "__main__":
    unittest.main()
