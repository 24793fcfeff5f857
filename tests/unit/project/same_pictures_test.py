#!/usr/bin/env python3
"""Tests .ci/same_pictures.py with scripts in place of games. usage: same_pictures_test.py FOLDER_OF_SAME_PICTURES"""
import contextlib
import importlib.util
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
FOLDER = Path(sys.argv.pop())
SPEC = importlib.util.spec_from_file_location("same_pictures", FOLDER / "same_pictures.py")
same_pictures = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(same_pictures)

# Writes `picture` and the statistics `draws`, then ends with `status`.
GAME = """#!/bin/sh
while [ $# -gt 0 ]; do
    case $1 in
        --screenshot) {picture} ;;
        --stats) echo '{{"frames": [{{"shadow": {{"draws": {draws}, "cpu_us": '$$'}}}}]}}' >"$2" ;;
    esac
    shift
done
exit {status}
"""


class SamePictures(unittest.TestCase):
    def compared(self, old, new, only="courtyard frozen", more=()):
        """(exit status, last line) for two games, each a dict of what differs from a sound one."""
        with tempfile.TemporaryDirectory() as folder:
            games = []
            for name, own in (("old", old), ("new", new)):
                game = Path(folder) / name
                game.write_text(GAME.format(**{"picture": 'echo "a picture" >"$2"', "draws": 3, "status": 0, **own}), encoding="utf-8")
                game.chmod(0o755)
                games.append(str(game))
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                status = same_pictures.main([*games, "--data", f"{folder}/none", "--only", only, *more])
            return status, printed.getvalue().splitlines()[-1]

    def test_equal_ones_are_equal_whatever_their_times(self):
        self.assertEqual(self.compared({}, {}), (0, "1 of 1 cases are equal"))

    def test_another_picture_another_count_and_a_failure_of_one_differ(self):
        for new in ({"picture": 'echo "another" >"$2"'}, {"draws": 4}, {"status": 1}):
            self.assertEqual(self.compared({}, new), (1, "0 of 1 cases are equal"), new)
            self.assertEqual(self.compared(new, {}), (1, "0 of 1 cases are equal"), new)

    def test_counts_that_are_left_out_do_not_differ(self):
        self.assertEqual(self.compared({}, {"draws": 4}, more=["--without", "aws"]), (0, "1 of 1 cases are equal"))
        self.assertEqual(self.compared({}, {"draws": 4}, more=["--without", "draw"]), (1, "0 of 1 cases are equal"))

    def test_two_that_fail_alike_are_not_equal(self):
        for both in ({"status": 1}, {"status": 2}, {"picture": ":"}):
            self.assertEqual(self.compared(both, both), (1, "0 of 1 cases are equal"), both)

    def test_no_case_is_no_success(self):
        self.assertEqual(self.compared({}, {}, only="no such case"), (1, "0 of 0 cases are equal"))


if __name__ == "__main__":
    unittest.main()
