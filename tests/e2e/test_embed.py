"""What gnomon::Shadows costs an engine, as a user measures it. What pictures and counts say, not clocks."""
import os
import shutil
import sys
import tempfile
import unittest

from game import run_bench

BAD_INPUT = 2
ROUNDS, FRAMES = 2, 2
STILL = ("passes_without", "passes", "mask", "shader_without", "lookup")
BASES = {"passes": "passes_without", "mask": "passes", "lookup": "passes", "moving_mask": "moving_frame",
         "moving_lookup": "moving_frame"}


class EmbedTest(unittest.TestCase):
    bench = None

    def run_bench(self, *flags):
        """Exit code, what it printed, and its JSON."""
        folder = tempfile.mkdtemp(prefix="gnomon_embed_")
        self.addCleanup(shutil.rmtree, folder, True)
        file = os.path.join(folder, "embed.json")
        return run_bench(self.bench, file, "embed", *flags)

    def test_every_way_is_timed_over_the_same_shadows(self):
        code, text, found = self.run_bench("--quick", "--size", "96x54", "--lights", "1,3", "--rounds", str(ROUNDS),
                                           "--repeat", str(FRAMES), "--no-lookup-all")
        self.assertEqual(code, 0, text)
        self.assertNotIn("OpenGL:", text)
        self.assertEqual(found["size_px"], [96, 54])
        self.assertEqual([(row["kind"], row["filter"], row["lights"]) for row in found["rows"]],
                         [(kind, name, lights) for kind, name in (("suns", "default"), ("spots", "default"),
                                                                  ("spots", "pcf_grid"), ("points", "default"))
                          for lights in (1, 3)])
        for row in found["rows"]:
            with self.subTest(kind=row["kind"], filter=row["filter"], lights=row["lights"]):
                self.assertGreaterEqual(row["maps"], row["lights"])
                self.assertEqual(row["used_filter"], "triangles" if row["filter"] == "default" else row["filter"])
                # The mask and the lookups darken the same pixels, and not none.
                self.assertGreater(row["shadowed"], 0.04)
                self.assertLess(row["differs"], 0.02)
                self.assertLess(row["differs"], 0.2 * row["shadowed"])
                self.assertNotIn("lookup_all", row)
                for way in (*STILL, "moving_frame", "moving_mask", "moving_lookup"):
                    self.assertEqual(row[way]["us"]["count"], ROUNDS * FRAMES, way)
                    self.assertGreater(row[way]["us"]["min"], 0, way)
                    self.assertGreater(row[way]["call_us"]["min"], 0, way)
                    self.assertEqual("ratio" in row[way], way in BASES, way)
                    self.assertEqual(row[way].get("ratio", {"count": ROUNDS})["count"], ROUNDS, way)
                # Lookups cost something, and drawing maps costs more than keeping them.
                time = "cpu_us" if found["is_software"] else "us"  # a busy machine stretches the clock's
                for more, less in (("lookup", "shader_without"), ("moving_mask", "mask")):
                    self.assertGreater(row[more][time]["median"], row[less][time]["median"], more)

    def test_settings_reach_the_lights_that_are_measured(self):
        maps = []
        for cascades in (1, 3):
            code, text, found = self.run_bench("--only", "suns default", "--size", "64x36", "--lights", "1", "--rounds", "1",
                                               "--repeat", "1", "--no-lookup-all", "--set", f"cascades={cascades}")
            self.assertEqual(code, 0, text)
            self.assertEqual([row["kind"] for row in found["rows"]], ["suns"])
            maps.append(found["rows"][0]["maps"])
        self.assertEqual(maps, [1, 3])

    def test_bad_input_is_refused(self):
        for flags in (("--lights", "0"), ("--lights", "9"), ("--size", "wide"), ("--set", "filter=none_such"),
                      ("--only", "none such", "--size", "8x8", "--no-lookup-all")):
            code, text, found = self.run_bench(*flags)
            self.assertEqual(code, BAD_INPUT, text)
            self.assertIsNone(found)


if __name__ == "__main__":
    EmbedTest.bench = sys.argv.pop(1)
    unittest.main(verbosity=2)
