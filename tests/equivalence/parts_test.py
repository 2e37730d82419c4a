"""Tests of single parts of the equivalence report."""

import os
import re
import sys
import tempfile
import unittest
from xml.etree import ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "tools", "equivalence"))

import bench_section  # noqa: E402
import charts  # noqa: E402
import comparing  # noqa: E402
import log_frame  # noqa: E402
import measure  # noqa: E402
import page  # noqa: E402
import plots  # noqa: E402
import tables  # noqa: E402
import words  # noqa: E402


class Comparison(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.a, self.b = (os.path.join(folder.name, name) for name in "ab")
        os.mkdir(self.a)
        os.mkdir(self.b)

    def put(self, folder, name, content):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(content)

    def differences(self):
        return comparing.differences(self.a, self.b)

    def test_finds_nothing_in_equal_folders(self):
        for folder in (self.a, self.b):
            self.put(folder, "m.node", b"1 2 3\n")
            self.put(folder, "empty", b"")
        self.assertEqual(self.differences(), [])

    def test_names_the_first_byte_that_differs_wherever_it_is(self):
        content = bytes(3 * comparing.BLOCK + 17)
        for offset in (0, 1, comparing.BLOCK - 1, comparing.BLOCK, len(content) - 1):
            changed = bytearray(content)
            changed[offset] = 1
            self.put(self.a, "m.ele", content)
            self.put(self.b, "m.ele", bytes(changed))
            self.assertEqual(self.differences(), [f"m.ele differs from byte {offset:,} on"])

    def test_detects_a_file_that_is_shorter_or_longer(self):
        self.put(self.a, "m.ele", b"1 2 3\n")
        self.put(self.b, "m.ele", b"1 2 3\n4")
        self.assertEqual(self.differences(), ["m.ele differs from byte 6 on"])
        self.put(self.b, "m.ele", b"")
        self.assertEqual(self.differences(), ["m.ele differs from byte 0 on"])

    def test_sees_files_that_are_missing_or_too_many(self):
        self.put(self.a, "m.face", b"")
        self.put(self.b, "m.edge", b"")
        self.assertEqual(self.differences(), ["m.face is missing", "m.edge is too many"])


def entry(phase, level, computing, communicating, messages=0, rounds=0):
    return {"phase": phase, "level": level, "computing_seconds": {"mean": computing},
            "communicating_seconds": {"mean": communicating}, "messages": {"sum": messages},
            "bytes": {"sum": 10 * messages}, "rounds": {"max": rounds}}


def profile(seconds, phases):
    return {"seconds": {"max": seconds}, "phases": phases, "peak_memory_bytes": {"max": 7},
            "levels": [{"cells": {"of_rank": [1, 2]}}]}


class Figures(unittest.TestCase):
    def test_are_sums_over_levels(self):
        made = measure.figures([profile(9, [
            entry("read", 0, 5, 0, messages=4), entry("synchronise", 1, 0.5, 1, 3, rounds=2),
            entry("synchronise", 2, 0.25, 2, 1, rounds=1), entry("closure", 1, 1, 0)])])
        self.assertEqual(made["phases"]["synchronise"], {"computing": 0.75, "communicating": 3})
        self.assertEqual(made["synchronisation"], {"rounds": 3, "messages": 4, "bytes": 40})
        self.assertEqual((made["messages"], made["bytes"]), (8, 80))
        self.assertEqual(made["refining_seconds"], 4.75)  # without reading
        self.assertEqual(made["cells_of_rank"], [[1, 2]])

    def test_of_time_are_medians(self):
        made = measure.figures([profile(s, [entry("closure", 1, s, 0)]) for s in (9, 1, 2)])
        self.assertEqual(made["seconds"], 2)
        self.assertEqual(made["phases"]["closure"]["computing"], 2)

    def test_of_histograms_are_shares(self):
        self.assertEqual(plots.shares({"counts": [1, 3, 0]}), [25, 75, 0])

    def test_of_axes_are_round_and_reach_the_highest(self):
        self.assertEqual(charts.round_steps(87), [0, 25, 50, 75, 100])
        self.assertEqual(charts.round_steps(4), [0, 1, 2, 3, 4])
        self.assertEqual(charts.round_steps(0), [0, 1])
        for highest in (1e-6, 0.03, 1, 19.9, 123456):
            self.assertGreaterEqual(charts.round_steps(highest)[-1], highest * (1 - 1e-9))

    def test_measured_on_a_loaded_machine_are_marked(self):
        self.assertEqual(page.load_notice({"cores": 2, "load": 0.4}), "")
        self.assertIn("unreliable", page.load_notice({"cores": 2, "load": 1.5}))


class Words(unittest.TestCase):
    def test_are_short_and_have_units(self):
        self.assertEqual([words.size(n) for n in (0, 999, 1000, 123456, 2.5e9)],
                         ["0 B", "999 B", "1 kB", "123 kB", "2.5 GB"])
        self.assertEqual([words.seconds(s) for s in (0.0012, 0.012, 0.12, 12, 120)],
                         ["1.2 ms", "12 ms", "0.12 s", "12.00 s", "120 s"])
        self.assertEqual([words.degrees(a) for a in (0.00865, 70.529)], ["0.0086°", "70.5°"])

    def test_have_their_plural(self):
        self.assertEqual([words.plural(n, "mesh/meshes") for n in (1, 2)], ["1 mesh", "2 meshes"])
        self.assertEqual([words.plural(n, "run") for n in (1, 1200)], ["1 run", "1,200 runs"])


def results(points):
    """Results of ./dev bench with these points of the named case."""
    name, = points
    case = {"name": name, "points": points[name]}
    machine = {"date": "today", "commit": "abc", "cores": 2, "processor": "<one>",
               "compiler": "GNU 12", "mpi": None, "load": 0.1}
    return {"machine": machine, "groups": [{"cases": [case, {"name": "else", "points": []}]}]}


class Style(unittest.TestCase):
    def test_asks_for_no_width_that_a_narrow_window_lacks(self):
        with open(page.STYLE, encoding="utf-8") as file:
            style = file.read()
        asked = re.findall(r"(?:[^-]width:|minmax\() *(\d+)px|(?:min-width:) *(\d+)px", style)
        self.assertTrue(asked, "the swatch of a legend has a width")
        for width in (int(number) for numbers in asked for number in numbers if number):
            self.assertLess(width, 320)

    def test_lets_wide_tables_scroll(self):
        with open(page.STYLE, encoding="utf-8") as file:
            self.assertIn(".wide { overflow-x: auto;", file.read())
        made = tables.table("<tr></tr>", [], "Cases")
        self.assertRegex(made, r'^<div class="wide"><table.*</table></div>$')


class Benchmarks(unittest.TestCase):
    def places(self, drawing):
        """The coordinates of the dots of each drawing."""
        svgs = [ElementTree.fromstring(svg) for svg in re.findall(r"<svg .*?</svg>", drawing)]
        return [[(float(dot.get("cx")), float(dot.get("cy"))) for dot in svg.iter("circle")]
                for svg in svgs]

    def test_are_left_out_where_there_are_none(self):
        self.assertEqual(bench_section.section(None), "")
        self.assertEqual(bench_section.section(results({"with cells": []})), "")
        self.assertIsNone(bench_section.load("/no/such/file.json"))

    def test_that_grow_in_proportion_are_on_a_straight_line(self):
        points = [{"cells": 8 ** i, "processor_seconds": 3e-6 * 8 ** i, "peak_bytes": 40 * 8 ** i}
                  for i in range(4, 9)]
        drawing = bench_section.section(results({"with cells": points}))
        self.assertIn("&lt;one&gt;", drawing)
        for dots in self.places(drawing):
            self.assertEqual(len(dots), 5)
            slopes = [(y2 - y1) / (x2 - x1) for (x1, y1), (x2, y2) in zip(dots, dots[1:])]
            self.assertLess(max(slopes), 0)  # upwards, because y increases downwards
            self.assertLess(max(slopes) - min(slopes), 0.02)

    def test_on_a_loaded_machine_are_marked(self):
        made = results({"with ranks": [{"ranks": 2, "processor_seconds_of_rank": 1, "bytes": 9}]})
        self.assertNotIn("unreliable", bench_section.section(made))
        made["machine"]["load"] = 1.5
        self.assertIn("unreliable", bench_section.section(made))

    def test_of_one_rank_send_nothing_and_are_drawn_all_the_same(self):
        points = [{"ranks": n, "processor_seconds_of_rank": 1 / n, "bytes": 1000 * (n - 1)}
                  for n in (1, 2, 4)]
        drawing = bench_section.section(results({"with ranks": points}))
        self.assertEqual([len(dots) for dots in self.places(drawing)], [3, 2])

    def test_have_bars_in_proportion(self):
        points = [{"name": "octetra, 1 rank", "cells_a_second": 8e6},
                  {"name": "DOLFINx, 1 rank", "cells_a_second": 2e6}]
        drawing = bench_section.section(results({"beside DOLFINx, uniform": points}))
        ours, theirs = map(float, re.findall(r'<rect [^>]*height="([0-9.]+)"', drawing))
        self.assertAlmostEqual(ours / theirs, 4, places=1)

    def test_have_axes_that_reach_all_of_them(self):
        self.assertEqual(log_frame.steps(10368, 29478000), [1e4, 1e5, 1e6, 1e7, 1e8])
        self.assertEqual(log_frame.steps(0.3, 1.2), [0.2, 0.5, 1, 2])
        for low, high in ((3, 3), (1, 1), (1e-6, 7e9), (0.99, 1.01)):
            marks = log_frame.steps(low, high)
            self.assertLessEqual(marks[0], low)
            self.assertGreaterEqual(marks[-1], high)
            self.assertGreater(len(marks), 1)
