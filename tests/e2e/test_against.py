"""Two ways to cast shadows held against each other, as a user runs it. What counts say, not clocks."""
import os
import shutil
import sys
import tempfile
import unittest

from game import run_bench

BAD_INPUT = 2
ROUNDS, FRAMES = 2, 3


class AgainstTest(unittest.TestCase):
    bench = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="gnomon_against_")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def run_bench(self, *flags):
        """Exit code, what it printed, and its JSON."""
        file = os.path.join(self.folder, "frames.json")
        return run_bench(self.bench, file, "frame", "--size", "64x36", "--rounds", str(ROUNDS), "--repeat", str(FRAMES),
                         *flags)

    def test_each_way_has_its_own_settings_and_its_own_maps(self):
        code, text, found = self.run_bench("--set", "filter=hard", "--set", "cascades=1", "--set", "resolution=64",
                                           "--against", "resolution=256")
        self.assertEqual(code, 0, text)
        self.assertIn("against resolution=256", text)
        self.assertEqual(found["settings"], ["filter=hard", "cascades=1", "resolution=64"])
        self.assertEqual(found["against"], ["resolution=256"])
        for going in ("still", "still_against_drawn", "walk", "walk_against_drawn", "moving", "drawn"):
            held = found[going]
            self.assertEqual(held["ratio"]["count"], ROUNDS, going)
            for way in ("own", "other"):
                self.assertEqual(held[way]["us"]["count"], ROUNDS * FRAMES, going)
                self.assertGreater(held[way]["us"]["min"], 0, going)
            self.assertGreater(held["own"]["bytes"], 0, going)
            # The same filter, fits and views: sixteen texels for one.
            self.assertEqual(held["other"]["bytes"], 16 * held["own"]["bytes"], going)
        for way in ("own", "other"):
            self.assertEqual(found["still"][way]["views_drawn"], 0, "maps are kept")
            self.assertGreaterEqual(found["drawn"][way]["views_drawn"], 3, "one or more for each light")
            self.assertGreater(found["moving"][way]["views_drawn"], 0)
        self.assertEqual(found["still_against_drawn"]["own"], found["still"]["own"])
        self.assertEqual(found["still_against_drawn"]["other"], found["drawn"]["other"])
        self.assertEqual(found["walk_against_drawn"]["own"], found["walk"]["own"])
        self.assertGreaterEqual(found["walk_against_drawn"]["other"]["views_drawn"], 3, "while the camera walks as well")

    def test_without_another_way_frames_without_shadows_are_the_base(self):
        code, text, found = self.run_bench()
        self.assertEqual(code, 0, text)
        self.assertNotIn("against", found)
        self.assertIn("without_us", found)

    def test_settings_that_there_are_not_are_bad_input(self):
        for other in ("nonsense=1", "filter=none_such", "resolution"):
            code, text, found = self.run_bench("--against", other)
            self.assertEqual(code, BAD_INPUT, text)
            self.assertIn("--set", text)
            self.assertIsNone(found)


if __name__ == "__main__":
    AgainstTest.bench = sys.argv.pop(1)
    unittest.main(verbosity=2)
