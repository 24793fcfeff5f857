"""Another renderer's shadows judged by rays. Gnomon's own files stand for another's: as drawn, without shadows, and spoiled."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from game import run_bench

TIMEOUT_S = 300
BAD_INPUT = 2
SIZE = "192x108"
LIGHTS = ("sun", "lantern", "guard_lamp")
LEAST_WRONG_WITHOUT = 0.01


class JudgeTest(unittest.TestCase):
    game = bench = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="gnomon_judge_")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def draw(self, *flags):
        """Folder of the visibilities that the game draws."""
        subprocess.run([self.game, "--headless", "--frames", "3", "--time", "0", "--size", SIZE,
                        "--visibility", self.folder, *flags], stdout=subprocess.DEVNULL, timeout=TIMEOUT_S,
                       check=True)

    def judge(self, *flags):
        return self.measure("judge", "--visibility", self.folder, *flags)

    def measure(self, *words):
        return run_bench(self.bench, os.path.join(self.folder, words[0] + ".json"), *words)

    def test_right_shadows_are_right_and_missing_ones_wrong(self):
        self.draw()
        code, text, right = self.judge("--size", SIZE, "--area", "4")
        self.assertEqual(code, 0, text)
        self.draw("--set", "enabled=off")
        code, text, without = self.judge("--size", SIZE)
        self.assertEqual(code, 0, text)
        self.assertEqual([light["name"] for light in right["folders"][0]["lights"]], list(LIGHTS))
        code, text, measured = self.measure("accuracy", "--repeat", "0", "--size", SIZE, "--area", "4")
        self.assertEqual(code, 0, text)
        for drawn, lit, own in zip(right["folders"][0]["lights"], without["folders"][0]["lights"], measured["lights"]):
            self.assertGreater(drawn["scored_px"], 1000)
            # The same pictures, read from files and from the frame.
            self.assertEqual([drawn[key] for key in ("scored_px", "wrong", "acne", "leak")],
                             [own[key] for key in ("scored_px", "wrong", "acne", "leak")], drawn["name"])
            self.assertEqual(drawn["area"]["mean_error"], own["area"]["mean_error"], drawn["name"])
            self.assertLess(drawn["wrong"], LEAST_WRONG_WITHOUT, drawn["name"])
            self.assertGreater(drawn["area"]["crossed_px"], 10, drawn["name"])
            self.assertGreater(drawn["area"]["mean_error"], 0.1, "lit or dark by the middle of a pixel makes stairs")
            self.assertNotIn("area", lit)
            self.assertGreater(lit["false_light"], LEAST_WRONG_WITHOUT, lit["name"])
            self.assertEqual(lit["false_shadow"], 0, lit["name"])

    def test_pictures_that_do_not_fit_are_one_line_of_error(self):
        self.draw()
        code, text, found = self.judge("--size", "160x90")
        self.assertEqual((code, found), (BAD_INPUT, None), text)
        self.assertIn("192x108 pixels, not 160x90", text)
        os.remove(os.path.join(self.folder, "lantern.pfm"))
        code, text, found = self.judge("--size", SIZE)
        self.assertEqual((code, found), (BAD_INPUT, None), text)
        self.assertIn("lantern.pfm", text)
        self.assertEqual(len(text.strip().splitlines()), 1, text)


if __name__ == "__main__":
    JudgeTest.game, JudgeTest.bench = sys.argv.pop(1), sys.argv.pop(1)
    unittest.main(verbosity=2)
