#!/usr/bin/env python3
"""Sums up ctest's JUnit files: failures with their output, skips with their reason, and the closing line.

usage: summary.py FILE.xml ...
The last line printed is exactly `N passed, N failed, N skipped`.
Exit status: 0 if at least one test passed and none failed, else 1. A missing or broken file counts as one failure.
"""
import re
import sys
import xml.etree.ElementTree as ElementTree

FAILURE_LINES = 60


def reason_of_skip(output):
    """GoogleTest prints `file:line: Skipped`, then the reason up to the line that names the test."""
    found = re.search(r": Skipped\n(.*?)\n*\[", output, re.DOTALL)
    text = found.group(1) if found else output.strip().rpartition("\n")[2]
    return " ".join(text.split()) or "no reason given"


def read(path):
    """[(kind, name, text)], kind being passed, failed or skipped."""
    try:
        cases = ElementTree.parse(path).getroot().iter("testcase")
    except (OSError, ElementTree.ParseError) as error:
        return [("failed", path, f"no test results: {error}")]
    results = []
    for case in cases:
        output = case.findtext("system-out") or ""
        status = case.get("status")
        if status == "run" and case.find("failure") is None:
            results.append(("passed", case.get("name"), output))
        elif status == "disabled" or skip_message(case).startswith("SKIP_"):
            results.append(("skipped", case.get("name"), reason_of_skip(output)))
        else:  # failed, or could not be run at all
            results.append(("failed", case.get("name"), output or skip_message(case)))
    return results


def skip_message(case):
    skipped = case.find("skipped")
    return (skipped.get("message") or "") if skipped is not None else ""


def main(paths):
    results = [result for path in paths for result in read(path)]
    for kind, name, text in results:
        if kind == "failed":
            print(f"FAILED {name}", *text.splitlines()[-FAILURE_LINES:], sep="\n    ")
    for reason in sorted({(name, text) for kind, name, text in results if kind == "skipped"}):
        print("skipped {}: {}".format(*reason))
    counts = {kind: sum(result[0] == kind for result in results) for kind in ("passed", "failed", "skipped")}
    print("{passed} passed, {failed} failed, {skipped} skipped".format(**counts))
    return 0 if counts["passed"] > 0 and counts["failed"] == 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
