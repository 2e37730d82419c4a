"""Tests of the judgement of counts, without counting."""

import argparse
import os
import tempfile
import unittest
from unittest import mock

import count


class Count(unittest.TestCase):
    def check(self, now, built_by="GNU 12", recorded=("GNU 12", {"uniform": 1000})):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "recorded.txt")
            if recorded:
                count.write(path, *recorded)
            options = argparse.Namespace(recorded=path, built_by=built_by, program="none")
            with mock.patch.object(count, "count", return_value=now), \
                    mock.patch.object(count.shutil, "which", return_value="valgrind"):
                return count.check(options, "uniform")

    def test_may_rise_by_a_tenth_and_no_more(self):
        for now, status in ((1000, 0), (1100, 0), (1101, 1), (5000, 1)):
            self.assertEqual(self.check(now)[1], status, now)

    def test_that_rises_explains_how_to_record_it(self):
        self.assertIn(count.HOW_TO_RECORD, self.check(1200)[0])

    def test_that_falls_by_more_than_a_tenth_asks_to_be_recorded(self):
        self.assertFalse(self.check(900)[0].startswith("dev note: "))
        words, status = self.check(890)
        self.assertTrue(words.startswith("dev note: "))
        self.assertIn(count.HOW_TO_RECORD, words)
        self.assertEqual(status, 0)

    def test_of_another_compiler_is_skipped_with_the_reason(self):
        words, status = self.check(1000, built_by="Clang 14")
        self.assertEqual(status, count.SKIPPED)
        self.assertIn("GNU 12", words)
        self.assertIn("Clang 14", words)

    def test_that_was_never_recorded_fails(self):
        self.assertEqual(self.check(1000, recorded=("GNU 12", {"dense": 7}))[1], 1)


if __name__ == "__main__":
    unittest.main()
