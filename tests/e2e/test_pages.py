"""The pages that list keys of a JSON file have the keys that the programs write: none is missing, none is invented.

usage: test_pages.py GAME BENCH ROOT [unittest arguments]
A page lists the keys of the file NAME between <!-- json: NAME --> and <!-- /json -->, as code in the first cells of tables.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TIMEOUT_S = 300
LIST = re.compile(r"<!-- json: (?P<name>\w+) -->\n(?P<text>.*?)<!-- /json -->", re.DOTALL)
# Keys below these are names of lights, programs, ...: no page lists them.
NAMES_BELOW = ()


def keys_of(value):
    """All keys at any depth of a JSON value."""
    if isinstance(value, dict):
        found = set(value)
        for key, part in value.items():
            found |= keys_of(part) if key not in NAMES_BELOW else set()
        return found
    return set().union(*map(keys_of, value)) if isinstance(value, list) else set()


def listed(text):
    """Keys of the first cells of a page's tables, and those that a cell's words name as `a`, `b`."""
    found = set()
    for line in text.splitlines():
        if line.startswith("|") and not line.startswith("|-"):
            found |= set(re.findall(r"`([a-z_]\w*)`", line.split("|")[1]))
    return found


def named(text):
    """Everything that the page has as code: keys may be explained inside a meaning."""
    return set(re.findall(r"`([a-z_]\w*)`", text))


class Pages(unittest.TestCase):
    game = bench = root = None

    def lists(self):
        pages = sorted((self.root / "docs").rglob("*.md")) + [self.root / "bench/README.md"]
        return [(page, match) for page in pages if page.is_file()
                for match in LIST.finditer(page.read_text(encoding="utf-8"))]

    def stats(self):
        """Keys of --stats, of frames with everything that may be in them."""
        found = set()
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.json")
            for flags in (["--demo", "--frames", "3", "--time", "2"],
                          ["--frames", "3", "--shadow-bytes", "4000000"],
                          ["--frames", "2", "--set", "max_error_px=0.1", "--truth", os.path.join(folder, "t.png")],
                          ["--frames", "2", "--set", "filter=pcss", "--set", "source_radius_m=0.1", "--truth",
                           os.path.join(folder, "s.png")],
                          ["--frames", "2", "--scene", "panes", "--truth", os.path.join(folder, "p.png")],
                          ["--frames", "2", "--set", "filter=exact"]):
                subprocess.run([self.game, "--headless", "--size", "96x54", "--stats", file, *flags], check=True,
                               timeout=TIMEOUT_S, stdout=subprocess.DEVNULL)
                with open(file, encoding="utf-8") as text:
                    found |= keys_of(json.load(text))
        return found

    def test_the_page_of_stats_lists_what_is_written(self):
        pages = [(page, match) for page, match in self.lists() if match["name"] == "stats"]
        if not pages:
            self.skipTest("no page lists the keys of stats")
        written = self.stats()
        for page, match in pages:
            self.assertEqual(sorted(written - named(match["text"])), [], "not in %s" % page)
            self.assertEqual(sorted(listed(match["text"]) - written), [], "in %s alone" % page)

    def test_a_missing_and_an_invented_key_are_found(self):
        text = "| key | meaning |\n|---|---|\n| `a`, `b` | of `c` |\n"
        self.assertEqual(listed(text), {"a", "b"})
        self.assertEqual(named(text), {"a", "b", "c"})
        self.assertEqual(keys_of({"a": [{"b": 1}, {"c": {"d": 2}}]}), {"a", "b", "c", "d"})


if __name__ == "__main__":
    Pages.game, Pages.bench, Pages.root = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    unittest.main(argv=[sys.argv[0]] + sys.argv[4:], verbosity=2)
