"""Real files, one for each recorded verdict, through the real executable: a picture, or one line and exit code 2."""
import os
import sys
import unittest

from game import GameTest, Picture, main

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.path.join(HERE, "..", "..", "..", "shared", "data")
VERDICTS = os.path.join(HERE, "..", "data", "verdicts.txt")
SKIPPED = 77
PICTURES = ("seen", "nothing", "out_of_view")


def one_file_per_verdict():
    """{verdict: path}, the first of each in the table."""
    files = {}
    with open(VERDICTS, encoding="utf-8") as table:
        for line in table:
            name, _, verdict = line.strip().rpartition(" ")
            if name and not line.startswith("#"):
                files.setdefault(verdict, os.path.join(DATA, name))
    return files


class Data(GameTest):
    def test_what_is_refused_ends_in_one_line_with_file_and_rule(self):
        refused = {verdict: file for verdict, file in one_file_per_verdict().items() if verdict not in PICTURES}
        self.assertGreater(len(refused), 20)
        for rule, file in refused.items():
            with self.subTest(rule=rule, file=file):
                screenshot = self.path("refused.png")
                line = self.assert_refused("--headless", "--size", "96x54", "--scene", file, "--screenshot", screenshot)
                self.assertIn("[%s]" % rule, line)
                self.assertIn(os.path.basename(file), line)
                self.assertFalse(os.path.exists(screenshot))

    def test_what_is_drawn_ends_in_a_picture(self):
        for verdict in PICTURES:
            file = one_file_per_verdict()[verdict]
            with self.subTest(verdict=verdict, file=file):
                screenshot = self.path(verdict + ".png")
                self.run_game("--size", "96x54", "--scene", file, "--screenshot", screenshot)
                shades = Picture(screenshot).shade_count()
                if verdict == "seen":
                    self.assertGreater(shades, 1)
                else:
                    self.assertGreaterEqual(shades, 1)


if __name__ == "__main__":
    if not os.path.isdir(DATA):
        print("no test data at %s" % os.path.abspath(DATA))
        sys.exit(SKIPPED)
    main()
