"""The equivalence report as a whole, with the program and with faulty programs."""

import json
import os
import re
import stat
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

TOOL = os.path.join(os.path.dirname(__file__), "..", "..", "tools", "equivalence")
OCTETRA = os.environ.get("OCTETRA_PROGRAM", "octetra")

# Programs that act like octetra except for one fault. Open MPI and MPICH set different variables.
BEGIN = """#!/bin/bash
rank=${OMPI_COMM_WORLD_RANK-$PMI_RANK} size=${OMPI_COMM_WORLD_SIZE-$PMI_SIZE}
"""
CHANGES_A_BYTE_ON_3_RANKS_BY_THE_GATEWAY = """\
"{octetra}" "$@" || exit
if [[ $rank == 0 && $size == 3 && "$*" == *gateway* ]]; then
    printf 9 | dd of=refined.node bs=1 seek=100 conv=notrunc status=none
fi
"""
FAILS_ON_2_RANKS = """\
if [[ $size == 2 ]]; then
    echo "octetra: no more memory" >&2
    exit 3
fi
exec "{octetra}" "$@"
"""
FINDS_NOTHING_VALID = """\
if [[ $1 == verify ]]; then exec "{octetra}" "$@" --min-dihedral 179; fi
exec "{octetra}" "$@"
"""
SAYS_OTHER_WORDS_ON_RANKS = """\
if [[ $size ]]; then
    if [[ $rank == 0 ]]; then echo "octetra: other words" >&2; fi
    exit 2
fi
exec "{octetra}" "$@"
"""

GOES_ON_WRONGLY_FROM_CHECKPOINTS = """\
"{octetra}" "$@" || exit
if [[ $1 == adapt && $2 == *.octetra && $rank == 0 ]]; then echo >> end.mesh; fi
"""


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def program(self, script):
        path = os.path.join(self.folder, "octetra")
        with open(path, "w", encoding="utf-8") as file:
            file.write(BEGIN + script.format(octetra=OCTETRA))
        os.chmod(path, stat.S_IRWXU)
        return path

    def report(self, only, program=OCTETRA):
        """Returns the exit status, the printed sentence, and the JSON of a report on one case."""
        done = subprocess.run(
            [sys.executable, TOOL, "--octetra", program, "-o", os.path.join(self.folder, "out"),
             "--only", only, "--no-pictures"], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.returncode, done.stdout, json.loads(self.output("equivalence.json"))

    def output(self, name):
        with open(os.path.join(self.folder, "out", name), encoding="utf-8") as file:
            return file.read()

    def runs_that_differ(self, report):
        return [(run["ranks"], run["sync"]) for case in report["cases"] for run in case["runs"]
                if not run["identical"]]

    def names(self, *options):
        """Returns the exit status, the listed cases, and the output on stderr."""
        out = os.path.join(self.folder, "out")
        done = subprocess.run([sys.executable, TOOL, "-o", out, "--list", *options],
                              capture_output=True, text=True, check=False)
        self.assertFalse(os.path.exists(out))
        return done.returncode, done.stdout.splitlines(), done.stderr

    def test_compares_loops_step_by_step_and_after_restarts(self):
        status, said, report = self.report("loop: gear")
        loop, = report["loops"]
        self.assertEqual(status, 0, said)
        self.assertEqual([run["ranks"] for run in loop["runs"]], [[1], [2], [3], [4], [1, 3], [4, 2], [3, 1]])
        self.assertEqual(len(loop["cells"]), len(loop["steps"]))
        self.assertEqual(loop["cells"][-1], loop["input_cells"])
        self.assertIn("Loops", self.output("index.html"))
        self.assertIn("| loop: gear | 4 |", self.output("equivalence.md"))

    def test_names_the_loops_that_continue_wrongly(self):
        program = self.program(GOES_ON_WRONGLY_FROM_CHECKPOINTS)
        status, said, report = self.report("loop: gear", program)
        loop, = report["loops"]
        self.assertEqual((status, loop["identical"]), (1, False))
        self.assertEqual([run["ranks"] for run in loop["runs"] if run["differences"]], [[1, 3], [4, 2], [3, 1]])
        self.assertIn("loop: gear", said)
        self.assertIn("end.mesh differs", self.output("index.html"))

    def test_lists_its_cases_and_runs_nothing(self):
        status, names, _ = self.names("--only", "kuhn-2")
        self.assertEqual((status, names), (0, ["kuhn-2"]))
        self.assertGreater(len(self.names()[1]), len(self.names("--quick")[1]))

    def test_refuses_a_name_that_no_case_has(self):
        self.assertEqual(self.names("--only", "no such case"),
                         (2, [], "equivalence: no case has 'no such case' in its name\n"))

    def test_reports_that_everything_is_identical_and_valid(self):
        status, said, report = self.report("kuhn-2")
        self.assertEqual(status, 0)
        self.assertIn("1 case, 7 runs on 1 to 4 ranks: all identical", said)
        case = report["cases"][0]
        self.assertEqual((case["before"]["cells"], case["after"]["cells"]), (48, 3072))
        self.assertTrue(case["verdict"]["valid"])
        self.assertIn("maps.txt", case["reference"]["files"])
        self.assertIn("The laws of histories were held against 108,720", self.output("index.html"))
        self.assertEqual(self.output("index.html").split("Moments of faults")[1].split("</table>")[0].count("<tr>"), 13)
        self.assertIn("| kuhn-2 | 48 | 3,072 | 7 of 7 | valid |", self.output("equivalence.md"))

    def test_is_a_self_contained_page(self):
        self.report("bcc-4")
        html = self.output("index.html")
        self.assertNotRegex(html, r"(src|href)=\"(?!data:)")
        self.assertNotIn("<script", html)
        drawings = re.findall(r"<svg.*?</svg>", html, re.DOTALL)
        self.assertGreater(len(drawings), 2)
        for drawing in drawings:
            xml.etree.ElementTree.fromstring(drawing)

    def test_sees_one_byte_that_one_run_has_otherwise(self):
        program = self.program(CHANGES_A_BYTE_ON_3_RANKS_BY_THE_GATEWAY)
        status, said, report = self.report("kuhn-2", program)
        self.assertEqual(status, 1)
        self.assertIn("Not identical", said)
        self.assertEqual(self.runs_that_differ(report), [(3, "gateway")])
        [run] = [run for run in report["cases"][0]["runs"] if not run["identical"]]
        self.assertEqual(run["differences"][0], "refined.node differs from byte 100 on")
        self.assertIn("octetra compare", run["differences"][1])
        self.assertIn('class="verdict bad"', self.output("index.html"))
        self.assertIn("3 ranks, gateway: refined.node differs from byte 100 on",
                      self.output("index.html"))
        self.assertIn("6 of 7", self.output("equivalence.md"))

    def test_sees_a_run_that_fails(self):
        status, _, report = self.report("kuhn-2", self.program(FAILS_ON_2_RANKS))
        self.assertEqual(status, 1)
        self.assertEqual(self.runs_that_differ(report), [(2, "neighbour"), (2, "gateway")])
        self.assertIn("status 3 instead of 0", report["cases"][0]["runs"][1]["differences"][0])

    def test_reports_invalid_meshes(self):
        status, said, report = self.report("kuhn-2", self.program(FINDS_NOTHING_VALID))
        self.assertEqual(status, 1)
        self.assertIn("Not valid by exact verification: kuhn-2", said)
        self.assertEqual(self.runs_that_differ(report), [])
        self.assertIn('class="verdict bad"', self.output("index.html"))

    def test_requires_refusals_with_the_same_message(self):
        status, _, report = self.report("no-room-for-midpoints")
        self.assertEqual(status, 0)
        self.assertEqual(report["cases"][0]["reference"]["status"], 2)
        self.assertIn("refused", self.output("equivalence.md"))
        status, _, report = self.report("no-room-for-midpoints",
                                        self.program(SAYS_OTHER_WORDS_ON_RANKS))
        self.assertEqual(status, 1)
        self.assertEqual(len(self.runs_that_differ(report)), 7)
