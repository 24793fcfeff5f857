"""What every end-to-end test shares: running the executable, reading its files, making scenes."""
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

BAD_INPUT = 2
SMALL = "320x180"
TIMEOUT_S = 120
BENCH_TIMEOUT_S = 500
# Set by `./gnomon test --long`, and so by CI.
LONG = "GNOMON_LONG" in os.environ


class Picture:
    """An 8-bit RGBA or RGB PNG, top row first; rgba either way."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        if data[:8] != b"\x89PNG\r\n\x1a\n":
            raise ValueError("not a PNG: %s" % path)
        at, packed = 8, b""
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + length]
            if struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] != zlib.crc32(kind + body):
                raise ValueError("bad checksum in chunk %r" % kind)
            if kind == b"IHDR":
                self.width, self.height, depth, colour = struct.unpack(">IIBB", body[:10])
                if depth != 8 or colour not in (2, 6):
                    raise ValueError("neither 8-bit RGBA nor RGB")
                self.channels = 4 if colour == 6 else 3
            if kind == b"IDAT":
                packed += body
            at += 12 + length
        pixels = self._unfilter(zlib.decompress(packed))
        self.rgba = pixels if self.channels == 4 else self._with_alpha(pixels)

    @staticmethod
    def _with_alpha(rgb):
        rgba = bytearray(b"\xff" * (len(rgb) // 3 * 4))
        for channel in range(3):
            rgba[channel::4] = rgb[channel::3]
        return bytes(rgba)

    def _unfilter(self, raw):
        step, stride = self.channels, self.width * self.channels
        out, above = bytearray(), bytearray(stride)
        for y in range(self.height):
            start = y * (stride + 1)
            kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
            for x in range(stride):
                left = row[x - step] if x >= step else 0
                up, corner = above[x], above[x - step] if x >= step else 0
                if kind == 1:
                    guess = left
                elif kind == 2:
                    guess = up
                elif kind == 3:
                    guess = (left + up) // 2
                elif kind == 4:
                    p = left + up - corner
                    near = (abs(p - left), abs(p - up), abs(p - corner))
                    guess = (left, up, corner)[near.index(min(near))]
                else:
                    guess = 0
                row[x] = (row[x] + guess) & 255
            out += row
            above = row
        return bytes(out)

    def luma(self):
        px = self.rgba
        return [(2 * px[i] + 5 * px[i + 1] + px[i + 2]) / 8.0 for i in range(0, len(px), 4)]

    def shade_count(self):
        return len(set(zip(self.rgba[0::4], self.rgba[1::4], self.rgba[2::4])))

    def mean_difference(self, other):
        """Mean absolute difference of the colour channels, 0..255; the sizes must agree."""
        if (self.width, self.height) != (other.width, other.height):
            raise ValueError("sizes differ")
        return sum(abs(a - b) for a, b in zip(self.rgba, other.rgba)) / (3.0 * self.width * self.height)


class Field:
    """A greyscale PFM, bottom row first."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        magic, size, scale, body = data.split(b"\n", 3)
        if magic != b"Pf" or float(scale) >= 0:
            raise ValueError("not a little-endian greyscale PFM: %s" % path)
        self.width, self.height = (int(n) for n in size.split())
        if len(body) != 4 * self.width * self.height:
            raise ValueError("%s holds %d bytes for %dx%d" % (path, len(body), self.width, self.height))
        self.values = struct.unpack("<%df" % (self.width * self.height), body)

    def share(self, wanted):
        return sum(1 for v in self.values if wanted(v)) / float(len(self.values))


def read_bytes(path):
    with open(path, "rb") as file:
        return file.read()


def without_times(stats):
    """The stats with everything that a clock wrote taken out."""
    if isinstance(stats, dict):
        return {k: without_times(v) for k, v in stats.items() if k not in ("cpu_us", "gpu_us", "saved_us")}
    if isinstance(stats, list):
        return [without_times(v) for v in stats]
    return stats


class GameTest(unittest.TestCase):
    game = None
    generator = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="gnomon_e2e_")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def call(self, *args, env=None):
        return subprocess.run([self.game] + [str(a) for a in args], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=TIMEOUT_S, env=env, check=False)

    def run_game(self, *args):
        """Headless, must succeed."""
        done = self.call("--headless", *args)
        self.assertEqual(done.returncode, 0, "%s\n%s" % (args, done.stderr.decode(errors="replace")))
        return done

    def stats_of(self, *args):
        file = self.path("stats_%d.json" % len(os.listdir(self.folder)))
        self.run_game("--stats", file, *args)
        with open(file, encoding="utf-8") as text:
            return json.load(text)

    def make_scene(self, name, *args):
        file = self.path(name)
        subprocess.run([self.generator, file] + list(args), check=True, stdout=subprocess.DEVNULL, timeout=TIMEOUT_S)
        return file

    def assert_refused(self, *args, env=None, mentions=None):
        """Exit code 2 and exactly one line on stderr."""
        done = self.call(*args, env=env)
        text = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, BAD_INPUT, "%s\n%s" % (args, text))
        self.assertEqual(len(text.splitlines()), 1, "%s\n%s" % (args, text))
        self.assertTrue(text.endswith("\n") and len(text.strip()) > 10, text)
        if mentions is not None:
            self.assertIn(mentions, text)
        return text


def run_bench(bench, file, *words):
    """Exit code of a measurement, what it printed, and its JSON, which it writes to `file`; None: it wrote none."""
    done = subprocess.run([bench, *words, "--json", file], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          timeout=BENCH_TIMEOUT_S, check=False)
    found = None
    if os.path.exists(file):
        with open(file, encoding="utf-8") as stream:
            found = json.load(stream)
    return done.returncode, done.stdout.decode() + done.stderr.decode(), found


def glb_parts(path):
    """(document, binary) of a GLB file."""
    data = read_bytes(path)
    json_length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + json_length].decode()), data[28 + json_length:]


def write_glb(path, document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def main():
    """Usage: test_x.py GAME GENERATOR [unittest arguments]"""
    GameTest.game, GameTest.generator = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:], verbosity=2)
