#!/usr/bin/env python3
"""Tests .ci/summary.py. usage: summary_test.py FOLDER_OF_SUMMARY"""
import contextlib
import importlib.util
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
FOLDER = Path(sys.argv.pop())
SPEC = importlib.util.spec_from_file_location("summary", FOLDER / "summary.py")
summary = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(summary)

PASSED = '<testcase name="A.Passes" status="run"><system-out>fine</system-out></testcase>'
FAILED = '<testcase name="A.Fails" status="fail"><failure message=""/><system-out>expected 1</system-out></testcase>'
SKIPPED = (
    '<testcase name="A.Skips" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/><system-out>'
    "a_test.cpp:4: Skipped\nno scene:\nSponza is absent\n\n[  SKIPPED ] A.Skips (0 ms)</system-out></testcase>"
)
NOT_RUN = '<testcase name="gone" status="notrun"><skipped message="Unable to find executable: gone"/></testcase>'


class Summary(unittest.TestCase):
    def run_on(self, *suites, limit=()):
        """(exit status, printed lines) for files holding these test cases; None stands for a missing file."""
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for number, cases in enumerate(suites):
                path = Path(folder) / f"{number}.xml"
                paths.append(str(path))
                if cases is not None:
                    path.write_text(f"<testsuite>{cases}</testsuite>", encoding="utf-8")
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                status = summary.main([*limit, *paths])
            return status, printed.getvalue().splitlines()

    def test_counts_are_summed_over_files(self):
        status, lines = self.run_on(PASSED + PASSED, PASSED + SKIPPED)
        self.assertEqual((status, lines[-1]), (0, "3 passed, 0 failed, 1 skipped"))
        self.assertFalse(any(line.startswith("failed") for line in lines))

    def test_a_skip_is_listed_with_its_reason(self):
        self.assertIn("skipped A.Skips: no scene: Sponza is absent", self.run_on(PASSED + SKIPPED)[1])

    def test_a_failure_shows_its_output_and_fails(self):
        status, lines = self.run_on(PASSED + FAILED)
        self.assertEqual((status, lines[-1]), (1, "1 passed, 1 failed, 0 skipped"))
        self.assertIn("    expected 1", lines)
        self.assertEqual(lines[-2], "failed: A.Fails")

    def test_a_test_that_could_not_run_is_a_failure_and_no_skip(self):
        status, lines = self.run_on(PASSED + NOT_RUN)
        self.assertEqual((status, lines[-1]), (1, "1 passed, 1 failed, 0 skipped"))

    def test_missing_or_broken_results_are_a_failure(self):
        for broken in (None, "<testcase"):
            status, lines = self.run_on(PASSED, broken)
            self.assertEqual((status, lines[-1]), (1, "1 passed, 1 failed, 0 skipped"))

    def test_a_process_counts_by_its_own_tests(self):
        own = (
            '<testcase classname="A" name="Passes" status="run" time="0.5"/>'
            '<testcase classname="A" name="Skips" status="run" result="skipped"><skipped message="a.cpp:4&#10;no scene"/></testcase>'
            '<testcase classname="A" name="Fails" status="run"><failure message="expected 1"/></testcase>'
        )
        status, lines = self.run_on_process(FAILED, own)
        self.assertEqual((status, lines[-1]), (1, "1 passed, 1 failed, 1 skipped"))
        self.assertIn("skipped A.Skips: no scene", lines)
        self.assertIn("    expected 1", lines)

    def test_a_process_that_fails_after_its_tests_have_passed_is_a_failure(self):
        own = '<testcase classname="A" name="Passes" status="run"/>'
        self.assertEqual(self.run_on_process(FAILED, own)[1][-1], "1 passed, 1 failed, 0 skipped")

    def test_a_process_that_left_no_results_is_one_test(self):
        self.assertEqual(self.run_on_process(FAILED, None)[1][-1], "0 passed, 1 failed, 0 skipped")

    def run_on_process(self, process, own):
        """run_on() for a process whose GoogleTest results hold the test cases of `own`."""
        with tempfile.TemporaryDirectory() as folder:
            junit = Path(folder) / "ctest.xml"
            junit.write_text(f"<testsuite>{process}</testsuite>", encoding="utf-8")
            if own is not None:
                (Path(folder) / "A.Fails.xml").write_text(f"<testsuites><testsuite>{own}</testsuite></testsuites>", encoding="utf-8")
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                status = summary.main([f"{junit}={folder}"])
            return status, printed.getvalue().splitlines()

    def test_the_slowest_are_listed_and_a_slow_one_needs_a_reason(self):
        slow = '<testcase name="A.IsSlow" status="run" time="61.5"/>'
        self.assertIn("    61.5 s  A.IsSlow", self.run_on(PASSED + slow)[1])
        with tempfile.TemporaryDirectory() as folder:
            listed = Path(folder) / "slow.txt"
            for text, failed in (("", 1), ("A.IsSlow", 1), ("A.IsSlow  # it must be", 0)):
                listed.write_text(text, encoding="utf-8")
                lines = self.run_on(PASSED + slow, limit=["--most-s", "60", "--listed", str(listed)])[1]
                self.assertEqual(lines[-1], f"2 passed, {failed} failed, 0 skipped")

    def test_nothing_run_is_no_success(self):
        self.assertEqual(self.run_on(""), (1, ["0 passed, 0 failed, 0 skipped"]))
        self.assertEqual(self.run_on(SKIPPED)[0], 1)


if __name__ == "__main__":
    unittest.main()
