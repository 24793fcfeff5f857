"""What the bench prints fits a terminal of 120 columns, and its --help explains each table.

usage: test_tables.py BENCH [unittest arguments]
"""
import subprocess
import sys
import unittest

COLUMNS = 120
TIMEOUT_S = 300
SMALL = ("--size", "96x54")
RUNS = {
    "accuracy": (*SMALL, "--repeat", "1"),
    "frame": (*SMALL, "--repeat", "1", "--rounds", "1"),
    "stability": (*SMALL, "--frames", "3", "--points", "100", "--path", "pan"),
    "audit": SMALL,
    "sets": (),
    "redraws": ("--frames", "3"),
    "queries": ("--places", "1000", "--repeat", "1"),
    "demand": ("--lights", "1,3", "--rounds", "1", "--repeat", "1", "--size", "96x54"),
}
# Tables whose --help has a legend.
LEGENDS = ("accuracy", "frame", "stability", "embed")


class Tables(unittest.TestCase):
    bench = None

    def call(self, *arguments):
        done = subprocess.run([self.bench, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIMEOUT_S,
                              check=False)
        # An audit of so few pixels may find its bounds broken (1), which is printed as well.
        self.assertIn(done.returncode, (0, 1) if arguments[0] == "audit" else (0,),
                      "%s\n%s" % (arguments, done.stderr.decode(errors="replace")))
        return done.stdout.decode()

    def test_each_print_fits_and_has_no_legend_below_it(self):
        for name, arguments in RUNS.items():
            with self.subTest(name):
                text = self.call(name, *arguments)
                self.assertEqual([line for line in text.splitlines() if len(line) > COLUMNS], [])
                self.assertIn("\n", text)
                if name in LEGENDS:
                    self.assertIn("What the columns mean: bench %s --help" % name, text)

    def test_two_ways_of_a_frame_fit_too(self):
        text = self.call("frame", *RUNS["frame"], "--against", "filter=hard")
        self.assertEqual([line for line in text.splitlines() if len(line) > COLUMNS], [])
        self.assertIn("against", text)

    def test_flicker_of_edges_fits_too(self):
        text = self.call("stability", *SMALL, "--area", "2", "--frames", "2", "--points", "20", "--path", "pan")
        self.assertEqual([line for line in text.splitlines() if len(line) > COLUMNS], [])
        self.assertIn("antialias=off, antialias=on", text)
        self.assertEqual(len([line for line in text.splitlines() if line.startswith("pan ")]), 3)

    def test_fog_has_a_table_that_fits_too(self):
        text = self.call("accuracy", *SMALL, "--repeat", "0", "--mist", "0.1")
        self.assertEqual([line for line in text.splitlines() if len(line) > COLUMNS], [])
        self.assertIn("in fog", text)
        self.assertNotIn("in fog", self.call("accuracy", *SMALL, "--repeat", "0", "--mist", "0"))

    def test_fog_that_is_no_share_is_refused(self):
        for mist in ("nan", "-0.1", "10.5", "thick"):
            done = subprocess.run([self.bench, "accuracy", *SMALL, "--mist", mist], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=False)
            self.assertEqual((done.returncode, done.stdout), (2, b""), mist)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_help_has_the_legends(self):
        for name in LEGENDS:
            text = self.call(name, "--help")
            self.assertIn("of the table" if name != "embed" else "ms: median", text, name)
            legend = text[text.index("of the table" if name != "embed" else "ms: median"):]
            self.assertEqual([line for line in legend.splitlines() if len(line) > COLUMNS], [], name)


if __name__ == "__main__":
    Tables.bench = sys.argv[1]
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:], verbosity=2)
