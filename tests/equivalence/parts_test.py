"""Parts of the equivalence report by themselves."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "tools", "equivalence"))

import charts  # noqa: E402
import comparing  # noqa: E402
import measure  # noqa: E402
import page  # noqa: E402
import plots  # noqa: E402
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

    def test_sees_a_file_that_ends_early_or_goes_on(self):
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

    def test_taken_beside_other_work_are_called_so(self):
        self.assertEqual(page.load_notice({"cores": 2, "load": 0.4}), "")
        self.assertIn("no measure", page.load_notice({"cores": 2, "load": 1.5}))


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
