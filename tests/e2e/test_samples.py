"""Pictures of several samples per pixel, and smoothed ones: --samples and --smooth, headless and in a window."""
import json
import os
import time
import unittest

from game import LONG, Picture, SMALL, read_bytes
from window import WindowTest, main_in_display

HELD = ("--time", "0")
SAMPLES = 16


class Samples(WindowTest):
    def picture(self, *args):
        file = self.path("p%d.png" % len(os.listdir(self.folder)))
        self.run_game("--size", SMALL, "--frames", 3, "--exposure", 6, "--screenshot", file, *HELD, *args)
        return Picture(file)

    def test_one_sample_without_smoothing_is_the_default(self):
        plain = self.picture()
        self.assertEqual(plain.rgba, self.picture("--samples", 1, "--smooth", "off").rgba)
        self.assertNotEqual(plain.rgba, self.picture("--samples", 2).rgba)

    def test_samples_draw_no_map(self):
        stats = self.stats_of("--size", SMALL, "--frames", 3, "--samples", SAMPLES, *HELD)
        samples = [frame["samples"] for frame in stats["frames"]]
        last = [frame for frame in stats["frames"] if frame["samples"] > 1]
        self.assertEqual([frame["samples"] for frame in last], list(range(2, SAMPLES + 1)), samples)
        for frame in last:
            self.assertEqual((frame["shadow"]["views"], frame["shadow"]["draws"]), (0, 0))
            self.assertTrue(frame["shadow"]["still"])

    # The mean lies between: it is nearer to a picture of many samples than one sample is, and smoothing lies between both.
    def test_more_samples_and_smoothing_come_nearer_to_many(self):
        many = self.picture("--samples", 64)
        one, some = self.picture(), self.picture("--samples", SAMPLES)
        smooth = self.picture("--smooth", "on")
        self.assertLess(2.0 * smooth.mean_difference(many), 1.6 * one.mean_difference(many))
        self.assertLess(some.mean_difference(many), 0.3 * one.mean_difference(many))
        self.assertEqual(many.rgba, self.picture("--samples", 64).rgba, "the same every time")

    def test_visibility_and_truth_are_those_of_pixels_middles(self):
        folders = [self.path("a"), self.path("b")]
        for folder, samples in zip(folders, (1, 4)):
            self.picture("--samples", samples, "--visibility", folder)
        for light in ("sun", "lantern", "guard_lamp"):
            a, b = (read_bytes("%s/%s.pfm" % (folder, light)) for folder in folders)
            self.assertEqual(a, b, light)

    def test_what_is_no_number_of_samples_is_refused(self):
        for wrong in ("0", "-1", "1025", "x", ""):
            self.assert_refused("--headless", "--samples", wrong, mentions="--samples")
        self.assert_refused("--headless", "--smooth", "maybe", mentions="--smooth")

    @unittest.skipUnless(LONG, "long runs only: the test after it adds samples in a window, too")
    def test_a_still_window_shows_what_headless_samples_show(self):
        window = self.play(self.leave, *HELD)
        file = self.path("headless.png")
        self.run_game("--size", SMALL, "--exposure", 6, "--samples", 64, "--screenshot", file, *HELD)
        self.assertLess(window.mean_difference(Picture(file)), 0.05)

    def test_f6_switches_both_off(self):
        def script(window):
            self.xdo("key", "F6")
            time.sleep(0.8)
            self.leave(window)
        self.assertLess(self.play(script, *HELD).mean_difference(self.picture()), 0.05)

    def test_a_still_window_ends_by_drawing_nothing(self):
        file = self.path("window.json")

        def script(window):
            time.sleep(5.0)
            self.leave(window)
        self.play(script, *HELD, "--samples", "4", "--stats", file)
        with open(file, encoding="utf-8") as text:
            frames = json.load(text)["frames"]
        samples = [frame["samples"] for frame in frames]
        self.assertEqual(samples[-1], 4, samples)
        self.assertEqual(frames[-1]["shadow"]["views"], 0)
        drawn = max(frame["gpu_us"] or 0.0 for frame in frames if frame["samples"] < 4)
        self.assertLess(5.0 * min(frame["gpu_us"] or 0.0 for frame in frames if frame["samples"] == 4), drawn)


if __name__ == "__main__":
    main_in_display()
