"""Every picture that pages show is made again by its command, and is the same; so is what the commands state about it.

usage: test_pictures.py GAME BENCH ROOT [unittest arguments]
"""
import fnmatch
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from game import Picture

TIMEOUT_S = 1200
ENDS = (".png", ".jpg", ".svg")
MOST_STRIP_BYTES = 300_000
MARKS = ("measured: ", "smoothed: ")
ROUNDING = 1  # of 255
MOST_SMOOTHED = 1e-3  # of the pixels, where smoothing chooses by a threshold


class Row:
    def __init__(self, line):
        self.pattern, self.command = line.split(" = ", 1)
        self.measured, self.smoothed = (self.pattern.startswith(mark) for mark in MARKS)
        self.pattern = self.pattern.removeprefix(MARKS[0]).removeprefix(MARKS[1])

    def fits(self, path):
        return fnmatch.fnmatch(path.as_posix(), "*/" + self.pattern)


def rows_of(text):
    return [Row(line) for line in text.splitlines() if line and not line.startswith("#")]


def device_of(text):
    return re.search(r"^# Made on: (.*)$", text, re.MULTILINE)[1]


def same_pixels(a, b, most=0.0):
    """Whether two pictures differ by rounding, as those of two processors do, but for a share `most` of their pixels."""
    if (a.width, a.height) != (b.width, b.height):
        return False
    changed = {i // 4 for i, (x, y) in enumerate(zip(a.rgba, b.rgba)) if abs(x - y) > ROUNDING}
    return len(changed) <= most * a.width * a.height


def same(one, other, most=0.0):
    """Whether two files show the same: pixels of pictures, text of drawings."""
    if one.suffix == ".svg":
        return one.read_text(encoding="utf-8") == other.read_text(encoding="utf-8")
    return same_pixels(Picture(str(one)), Picture(str(other)), most)


class Pictures(unittest.TestCase):
    game = bench = root = None

    def setUp(self):
        self.text = (self.root / "docs/pictures.txt").read_text(encoding="utf-8")
        self.rows = rows_of(self.text)
        self.committed = sorted(p for p in (self.root / "docs").rglob("*") if p.suffix in ENDS)

    def row_of(self, picture):
        return next((row for row in self.rows if row.fits(picture)), None)

    def device(self, folder):
        stats = os.path.join(folder, "device.json")
        subprocess.run([self.game, "--headless", "--frames", "1", "--size", "16x16", "--stats", stats], check=True,
                       timeout=TIMEOUT_S, stdout=subprocess.DEVNULL)
        with open(stats, encoding="utf-8") as file:
            return json.load(file)["device"]

    def make(self, command, file):
        """Runs a command of the list, with its file at another place."""
        words = [word.replace("{}", str(file)).replace("{folder}", str(file.parent)) for word in shlex.split(command)]
        # ./gnomon play and ./gnomon bench, or a program beside the game
        start = {"play": [self.game], "bench": [self.bench]}.get(words[1]) if words[0] == "./gnomon" else None
        command_line = start + words[2:] if start else [str(Path(self.game).parent / Path(words[0]).name)] + words[1:]
        done = subprocess.run(command_line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=False)
        self.assertEqual(done.returncode, 0, "%s\n%s" % (command, done.stderr.decode(errors="replace")))

    def test_each_picture_has_a_command_and_each_command_a_picture(self):
        self.assertGreater(len(self.committed), 5)
        without = [str(p.relative_to(self.root)) for p in self.committed if self.row_of(p) is None]
        self.assertEqual(without, [])
        self.assertEqual([row.pattern for row in self.rows if not any(self.row_of(p) is row for p in self.committed)], [])

    def test_each_picture_is_made_again_and_is_the_same(self):
        with tempfile.TemporaryDirectory(prefix="gnomon_pictures_") as folder:
            if not self.device(folder).startswith(device_of(self.text)):
                self.skipTest("another device than the pictures'")
            made, differ = {}, []
            for picture in self.committed:
                row = self.row_of(picture)
                if row is None or row.measured:
                    continue
                file = Path(folder, str(self.rows.index(row)), picture.name)
                if row.command not in made or "{}" in row.command:
                    file.parent.mkdir(exist_ok=True)
                    self.make(row.command, file)
                    made[row.command] = file.parent
                if not file.exists() or not same(file, picture, MOST_SMOOTHED if row.smoothed else 0.0):
                    differ.append(picture.name)
            self.assertEqual(differ, [])
            self.check_strip(made)

    def check_strip(self, made):
        strips = [p for p in self.committed if p.name == "strip.png"]
        for strip in strips:
            self.assertLess(strip.stat().st_size, MOST_STRIP_BYTES)
            folder = made[self.row_of(strip).command]
            with open(folder / "figures.json", encoding="utf-8") as file:
                figures = json.load(file)["figures"]
            with open(strip.parent / "figures.json", encoding="utf-8") as file:
                self.assertEqual(json.load(file)["figures"], figures)
            self.assertEqual(figures["strip.truth"], "0")

    def test_a_changed_pixel_is_found(self):
        picture = next(p for p in self.committed if p.suffix == ".png")
        drawing = next((p for p in self.committed if p.suffix == ".svg"), None)
        other = next(p for p in self.committed if p.suffix == ".png" and p != picture)
        self.assertTrue(same(picture, picture))
        self.assertFalse(same(picture, other))
        pixels, changed = Picture(str(picture)), Picture(str(picture))
        for step, is_same in ((ROUNDING, True), (ROUNDING + 1, False)):
            changed.rgba = bytearray(pixels.rgba)
            changed.rgba[0] += step if pixels.rgba[0] < 128 else -step
            self.assertEqual(same_pixels(pixels, changed), is_same)
        if drawing:
            with tempfile.TemporaryDirectory() as folder:
                changed = Path(folder, "a.svg")
                changed.write_text(drawing.read_text(encoding="utf-8").replace("<svg", "<svg "), encoding="utf-8")
                self.assertFalse(same(drawing, changed))


if __name__ == "__main__":
    Pictures.game, Pictures.bench, Pictures.root = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    unittest.main(argv=[sys.argv[0]] + sys.argv[4:], verbosity=2)
