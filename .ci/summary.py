#!/usr/bin/env python3
"""Sums up test results: failures with their output, skips with their reason, the slowest tests, and the closing line.

usage: summary.py [--most-s SECONDS --listed FILE] JUNIT[=FOLDER] ...
  JUNIT    what ctest wrote; each of its tests is a process
  FOLDER   GoogleTest's own results, a file NAME.xml for ctest's test NAME; counted test by test
  --most-s a test of the first JUNIT that takes longer counts as failed, unless a line of FILE matches its name, with a
           reason: NAME*  # reason. Those after it run under sanitizers, several times as long
Above the last line stand the names of what failed. The last line printed is exactly `N passed, N failed, N skipped`.
Exit status: 0 if at least one test passed and none failed, else 1. A missing or broken JUNIT counts as one failure.
"""
import argparse
import re
import sys
import xml.etree.ElementTree as ElementTree
from collections import namedtuple
from fnmatch import fnmatchcase
from pathlib import Path

FAILURE_LINES = 60
SLOWEST = 20

Case = namedtuple("Case", "kind name text seconds")  # kind: passed, failed or skipped


def one_line(text):
    return " ".join(text.split())


def reason_of_skip(output):
    """GoogleTest prints `file:line: Skipped`, then the reason up to the line that names the test."""
    found = re.search(r": Skipped\n(.*?)\n*\[", output, re.DOTALL)
    text = found.group(1) if found else output.strip().rpartition("\n")[2]
    return one_line(text) or "no reason given"


def skip_message(case):
    skipped = case.find("skipped")
    return (skipped.get("message") or "") if skipped is not None else ""


def seconds_of(case):
    try:
        return float(case.get("time") or 0)
    except ValueError:
        return 0.0


def read_junit(path):
    """ctest's tests as [Case]."""
    try:
        cases = ElementTree.parse(path).getroot().iter("testcase")
    except (OSError, ElementTree.ParseError) as error:
        return [Case("failed", path, f"no test results: {error}", 0.0)]
    results = []
    for case in cases:
        output = case.findtext("system-out") or ""
        if case.get("status") == "run" and case.find("failure") is None:
            kind, text = "passed", output
        elif case.get("status") == "disabled" or skip_message(case).startswith("SKIP_"):
            kind, text = "skipped", reason_of_skip(output)
        else:  # failed, or could not be run at all
            kind, text = "failed", output or skip_message(case)
        results.append(Case(kind, case.get("name"), text, seconds_of(case)))
    return results


def read_googletest(path):
    """One process's tests as [Case]; None where it left no results, as one that crashed does."""
    try:
        cases = ElementTree.parse(path).getroot().iter("testcase")
    except (OSError, ElementTree.ParseError):
        return None
    results = []
    for case in cases:
        name = f"{case.get('classname')}.{case.get('name')}"
        failures = [failure.get("message") or "" for failure in case.iter("failure")]
        if failures:
            results.append(Case("failed", name, "\n".join(failures), seconds_of(case)))
        elif case.find("skipped") is not None:
            reason = re.sub(r"^\S+:\d+\s*", "", skip_message(case))
            results.append(Case("skipped", name, one_line(reason) or "no reason given", seconds_of(case)))
        elif case.get("status") != "notrun":
            results.append(Case("passed", name, "", seconds_of(case)))
    return results


def read(argument):
    """All tests of JUNIT[=FOLDER] as [Case]: a process's own where it left any, else the process."""
    junit, _, folder = argument.partition("=")
    results = []
    for process in read_junit(junit):
        own = read_googletest(Path(folder) / f"{process.name}.xml") if folder else None
        if not own:
            results.append(process)
            continue
        results += own
        # A process may fail after its tests have passed: at its end, or by what a sanitizer finds.
        if process.kind == "failed" and all(case.kind != "failed" for case in own):
            results.append(process)
    return results


def listed_names(path):
    """Patterns of a file of `NAME  # reason`; a line without a reason is none."""
    lines = [line.partition("#") for line in Path(path).read_text(encoding="utf-8").splitlines()]
    return [name.strip() for name, _, reason in lines if name.strip() and reason.strip()]


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("--most-s", type=float, default=float("inf"))
    parser.add_argument("--listed")
    parser.add_argument("results", nargs="+")
    options = parser.parse_args(arguments)
    listed = listed_names(options.listed) if options.listed else []
    cases_of = [read(argument) for argument in options.results]
    cases = [case for own in cases_of for case in own]
    slow = [
        Case("failed", case.name, f"took {case.seconds:.0f} s, more than {options.most_s:.0f} s, and is not in {options.listed}", 0)
        for case in cases_of[0]
        if case.seconds > options.most_s and not any(fnmatchcase(case.name, name) for name in listed)
    ]
    slowest = sorted(cases, key=lambda case: -case.seconds)[:SLOWEST]
    if slowest and slowest[0].seconds > 0:
        print(f"the {len(slowest)} slowest tests, of {sum(case.seconds for case in cases):.0f} s in all:")
        for case in slowest:
            print(f"{case.seconds:8.1f} s  {case.name}")
    for case in cases + slow:
        if case.kind == "failed":
            print(f"FAILED {case.name}", *case.text.splitlines()[-FAILURE_LINES:], sep="\n    ")
    for name, reason in sorted({(case.name, case.text) for case in cases if case.kind == "skipped"}):
        print(f"skipped {name}: {reason}")
    names = [case.name for case in cases + slow if case.kind == "failed"]
    if names:  # again, in one line at the end, which is what a shortened log still shows
        print("failed:", ", ".join(names))
    counts = {kind: sum(case.kind == kind for case in cases + slow) for kind in ("passed", "failed", "skipped")}
    print("{passed} passed, {failed} failed, {skipped} skipped".format(**counts))
    return 0 if counts["passed"] > 0 and counts["failed"] == 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
