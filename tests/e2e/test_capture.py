"""A capture of an engine that uses gnomon::Shadows: it reads like the frame, and replays to the same picture.

usage: test_capture.py EXAMPLE      a program of examples/ that opens a window
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from game import Picture

SKIPPED = 77
TIMEOUT_S = 300
FRAMES = 3
DISPLAY = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24"]
# Groups of one frame, outermost first. A light's maps come first, then its layer of the mask.
MAP = re.compile(r"shadow \S+ \d+")
MASK = ("shadow mask", "imported surfaces")


def run(*command):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=TIMEOUT_S, check=True)


def calls_of(trace):
    """(name, text) of each call of OpenGL, in order."""
    for line in run("apitrace", "dump", "--color=never", trace).stdout.splitlines():
        match = re.match(r"\d+ (?:@\d+ )?(gl[A-Z]\w*)\((.*)", line)
        if match:
            yield match.groups()


class Capture(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="gnomon_capture_"))
        cls.trace = cls.folder / "frames.trace"
        run(*DISPLAY, "apitrace", "trace", "-o", cls.trace, EXAMPLE, "--size", "320x180", "--frames", FRAMES,
            "--screenshot", cls.folder / "drawn.png")
        cls.calls = list(calls_of(cls.trace))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_every_draw_of_gnomon_lies_in_a_named_group(self):
        groups, inside, outside = [], [], 0
        for name, text in self.calls:
            if name == "glPushDebugGroup":
                groups.append(re.search(r'message = "([^"]*)"', text).group(1))
            elif name == "glPopDebugGroup":
                groups.pop()
            elif name.startswith("glDraw"):
                inside.append(tuple(groups)) if groups else None
                outside += not groups
        self.assertEqual(groups, [], "groups that were not closed")
        # The engine's own: depths and colours, once each per frame.
        self.assertEqual(outside, 2 * FRAMES)
        maps = [path for path in inside if MAP.fullmatch(path[0])]
        self.assertEqual(len(maps), 1, "nothing moves: the map is drawn in the first frame alone")
        self.assertEqual(sum(path == MASK for path in inside), FRAMES)
        layers = [path for path in inside if len(path) == 2 and path[0] == MASK[0] and path != MASK]
        self.assertEqual(len(layers), 2 * FRAMES, "a layer per light and frame, drawn twice by a filter of triangles")
        self.assertEqual(len(inside), len(maps) + 3 * FRAMES, "no draw lies elsewhere")

    def test_every_object_of_gnomon_has_a_label(self):
        labelled = sum(name == "glObjectLabel" for name, _ in self.calls)
        self.assertGreater(labelled, 20)
        labels = [re.search(r'label = "([^"]*)"', text) for name, text in self.calls if name == "glObjectLabel"]
        self.assertTrue(all(label and label.group(1) for label in labels), "a label without text")
        self.assertIn("shadow mask", {label.group(1) for label in labels if label})

    def test_it_replays_to_the_same_picture(self):
        run(*DISPLAY, "apitrace", "replay", "-s", self.folder / "replayed-", self.trace)
        pictures = sorted(self.folder.glob("replayed-*.png"))
        self.assertGreaterEqual(len(pictures), FRAMES)
        drawn, replayed = Picture(self.folder / "drawn.png"), Picture(pictures[-1])
        self.assertGreater(len(set(drawn.rgba)), 3, "a picture of one colour says nothing")
        self.assertEqual(drawn.rgba, replayed.rgba)


if __name__ == "__main__":
    EXAMPLE = Path(sys.argv.pop(1)).resolve()
    missing = [tool for tool in ("apitrace", "xvfb-run", "Xvfb") if shutil.which(tool) is None]
    if missing:
        print("skipped: %s not installed" % ", ".join(missing))
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
