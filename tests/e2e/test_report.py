"""The report of a sweep, as a reader opens it: measured by the real bench, shown by a real browser."""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import browser
from game import Picture, read_bytes

SWEEP_TIMEOUT_S = 540
SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "sweep", "report.py")
MOST_BYTES = 15e6
ROWS = ("--rows", "defaults|^resolution=|3x3 PCF, 1024|^hard$|pcss_16")


class ReportTest(unittest.TestCase):
    bench = None
    folder = None
    command = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="gnomon_report_")
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.sweep()
        cls.page = os.path.join(cls.folder, "report.html")

    @classmethod
    def sweep(cls):
        """What the bench says; then the script makes the report of the same flags, as ./gnomon lets it."""
        flags = ["accuracy", "--sweep", "quick", "--size", "160x90", "--rounds", "1", *ROWS, "--out", cls.folder]
        bench, _ = (cls.run_command(command + flags) for command in ([cls.bench], [sys.executable, SCRIPT]))
        return bench

    @staticmethod
    def run_command(command):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=SWEEP_TIMEOUT_S,
                              check=False)
        if done.returncode != 0:
            raise AssertionError(done.stderr.decode(errors="replace"))
        return done

    def show(self, page):
        """The page in the browser, and its picture."""
        picture = os.path.join(self.folder, "shown.png")
        return browser.Shown(self.command, page, picture), picture

    def test_the_three_files_tell_of_the_same_rows(self):
        with open(os.path.join(self.folder, "report.json"), encoding="utf-8") as file:
            scene = json.load(file)["scenes"][0]
        with open(os.path.join(self.folder, "report.csv"), encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
        lights = [(row["row"], light["light"]) for row in scene["rows"] for light in row["lights"]]
        self.assertEqual([(line["row"], line["light"]) for line in lines], lights)
        self.assertEqual({light for _, light in lights}, {"sun", "lantern", "guard_lamp"})
        self.assertTrue(scene["device"])
        defaults = scene["rows"][0]["lights"][0]["figures"]
        self.assertEqual(defaults["unexplained"], 0)
        self.assertGreater(defaults["gpu_us"], 0)
        self.assertLess(os.path.getsize(self.page), MOST_BYTES)

    def test_a_second_run_goes_on_from_the_first_and_finds_the_same(self):
        before = read_bytes(os.path.join(self.folder, "report.json"))
        said = self.sweep().stderr.decode(errors="replace")
        self.assertIn("are taken from an earlier run", said)
        after = read_bytes(os.path.join(self.folder, "report.json"))
        times = re.compile(rb'"(trace_s|spent_s)": [^,]*')
        self.assertEqual(times.sub(b"", before), times.sub(b"", after))

    def test_the_page_opens_without_a_word_on_the_console_and_shows_what_halving_costs(self):
        self.need_browser()
        shown, picture = self.show(self.page)
        self.assertEqual(shown.said, [])
        text = re.sub(r"<(script|style).*?</\1>", "", shown.document, flags=re.S)
        self.assertRegex(text, r"halving the wrong pixels takes \d")
        rows = re.search(r'<span id="count">(\d+) of (\d+) rows', text)
        self.assertIsNotNone(rows, "the script has not filled the table")
        self.assertEqual(rows.group(1), rows.group(2))
        self.assertEqual(len(re.findall(r"<tr", text.split('id="table"')[1])) - 1, int(rows.group(1)))
        self.assertEqual(len(re.findall(r"<polyline", text)), len(re.findall(r"<figure data-scene", text)))
        self.assertGreater(Picture(picture).shade_count(), 50)

    def test_a_page_whose_script_fails_is_told_from_it(self):
        self.need_browser()
        with open(self.page, encoding="utf-8") as file:
            page = file.read()
        broken = os.path.join(self.folder, "broken.html")
        with open(broken, "w", encoding="utf-8") as file:
            file.write(page.replace("</body>", "<script>throw new Error('on purpose');</script></body>"))
        shown, _ = self.show(broken)
        self.assertTrue(any("on purpose" in line for line in shown.said), shown.said)

    def need_browser(self):
        if not self.command:
            self.skipTest(self.why)


if __name__ == "__main__":
    ReportTest.bench = os.path.abspath(sys.argv[1])
    ReportTest.command, ReportTest.why = browser.find()
    if not ReportTest.command:
        print("left out: %s" % ReportTest.why)
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:], verbosity=2)
