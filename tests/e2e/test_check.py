"""What a user runs first on a new machine: what it says, writes, and ends with."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

TIMEOUT_S = 120
WELL, NOT_WELL, BAD_INPUT = 0, 1, 2
FEW = ("--programs", "^depth ", "--repeat", "1")


class CheckTest(unittest.TestCase):
    bench = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="gnomon_check_")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def check(self, *flags, **variables):
        """Exit code, standard output and error."""
        done = subprocess.run([self.bench, "check", *flags], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env={**os.environ, **variables}, timeout=TIMEOUT_S, check=False)
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def test_rows_that_are_right_are_well_and_the_file_holds_them(self):
        file = os.path.join(self.folder, "check.json")
        code, text, _ = self.check(*FEW, "--rows", "^point (hard (six|layered_g)|exact )", "--json", file)
        self.assertEqual(code, WELL, text)
        lines = text.splitlines()
        self.assertRegex(lines[-1], r"^all is well here: \d+ of \d+ programs, 3 of \d+ rows$")
        self.assertLessEqual(max(len(line) for line in lines), 120)
        for heading in ("device", "limits", "extensions", "what follows"):
            self.assertIn(heading, lines)
        with open(file, encoding="utf-8") as stream:
            found = json.load(stream)
        self.assertTrue(found["well"])
        self.assertEqual(found["verdict"], lines[-1])
        for key in ("vendor", "renderer", "version", "glsl", "software", "limits", "extensions", "follows", "short_of"):
            self.assertIn(key, found["device"])
        self.assertGreaterEqual(found["device"]["limits"]["MAX_TEXTURE_SIZE"], 16384)
        self.assertEqual(found["programs"]["compiled"] + len(found["programs"]["not_for_this_device"]),
                         found["programs"]["tried"])
        self.assertEqual([row["verdict"] for row in found["rows"]], ["ok"] * 3 + ["not judged"] * 2)
        for row in found["rows"][:3]:
            self.assertGreater(row["scored_px"], 1000)
            self.assertEqual(row["unexplained_px"], 0)
            self.assertGreater(row["drawn_us"]["median"], 0)

    def test_rows_that_are_wrong_are_said_and_are_the_exit_code(self):
        for setting, why in (("far_m=2", "no_caster"), ("enabled=off", "shadows_off")):
            code, text, _ = self.check(*FEW, "--rows", "^(directional|spot) triangles", "--set", setting)
            self.assertEqual(code, NOT_WELL, text)
            self.assertIn(why, text)
            self.assertRegex(text.splitlines()[-1], r"^not all is well here: 2 rows failed, ")

    def test_the_file_may_be_standard_output(self):
        code, text, _ = self.check(*FEW, "--rows", "^spot hard", "--json", "-")
        self.assertEqual(code, WELL, text)
        self.assertEqual(json.loads(text)["rows"][0]["name"], "spot hard")

    def test_what_cannot_be_checked_is_bad_input(self):
        missing = os.path.join(self.folder, "none", "check.json")
        for flags in (("--rows", "("), ("--rows", "none such"), ("--programs", "none such"), ("--set", "no=1"),
                      ("--json", missing), ("--sideways",)):
            code, text, error = self.check(*flags)
            self.assertEqual((code, text), (BAD_INPUT, ""), flags)
            self.assertEqual(len(error.splitlines()), 1, error)

    def test_without_opengl_it_says_so_in_a_line(self):
        nowhere = os.path.join(self.folder, "none.json")
        code, text, error = self.check(*FEW, __EGL_VENDOR_LIBRARY_FILENAMES=nowhere)
        self.assertEqual((code, text), (BAD_INPUT, ""), error)
        self.assertEqual(len(error.splitlines()), 1, error)
        self.assertIn("egl.", error)


if __name__ == "__main__":
    CheckTest.bench = sys.argv.pop(1)
    unittest.main(verbosity=2)
