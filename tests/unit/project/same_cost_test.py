#!/usr/bin/env python3
"""Tests .ci/same_cost.py with numbers in place of runs. usage: same_cost_test.py FOLDER_OF_SAME_COST"""
import contextlib
import importlib.util
import io
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
FOLDER = Path(sys.argv.pop())
SPEC = importlib.util.spec_from_file_location("same_cost", FOLDER / "same_cost.py")
same_cost = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(same_cost)


class SameCost(unittest.TestCase):
    def compared(self, set_up, per_frame):
        """(exit status, last line) where a new build takes these instructions, and an old one 1000 and 100."""
        costs = {"old": (1000, 100), "new": (set_up, per_frame)}
        same_cost.instructions = lambda program, scene, way, frames: costs[program][0] + frames * costs[program][1]
        same_cost.shutil.which = lambda name: name
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            status = same_cost.main("old", "new")
        return status, printed.getvalue().splitlines()[-1]

    def test_a_frame_that_costs_more_is_found(self):
        self.assertEqual(self.compared(1000, 103), (1, "most: x 1.0300, 1.02 is the limit"))

    def test_one_that_costs_the_same_or_less_is_well(self):
        self.assertEqual(self.compared(1000, 100)[0], 0)
        self.assertEqual(self.compared(1000, 50)[0], 0)

    def test_what_is_done_once_does_not_count(self):
        self.assertEqual(self.compared(900000, 101), (0, "most: x 1.0100, 1.02 is the limit"))


if __name__ == "__main__":
    unittest.main()
