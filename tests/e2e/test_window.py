"""A real window under Xvfb, with key and mouse input."""
import json
import time
import unittest

from game import LONG, Picture, SMALL
from window import W, H, WindowTest, main_in_display


class Window(WindowTest):
    def walk(self, window):
        self.xdo("keydown", "w")
        time.sleep(1.5)
        self.xdo("keyup", "w")
        time.sleep(0.5)
        self.leave(window)

    def look(self, window):
        self.xdo("mousemove", "--window", window, str(W // 2), str(H // 2), "click", "1")
        time.sleep(0.7)
        for _ in range(10):
            self.xdo("mousemove_relative", "--", "12", "-3")
            time.sleep(0.05)
        time.sleep(0.7)
        self.leave(window)

    # --time without --frames holds the motion still, so that only the camera can change the picture.
    def test_w_and_the_mouse_move_the_camera_and_escape_writes_the_screenshot(self):
        still = self.play(self.leave, "--time", "0")
        self.assertEqual((still.width, still.height), (W, H))
        self.assertGreater(still.shade_count(), 500)
        again = self.play(self.leave, "--time", "0")
        self.assertEqual(still.rgba, again.rgba)
        walked = self.play(self.walk, "--time", "0")
        self.assertGreater(still.mean_difference(walked), 3.0, "W did not move the camera")
        looked = self.play(self.look, "--time", "0")
        self.assertGreater(still.mean_difference(looked), 3.0, "the mouse did not turn the camera")
        self.assertGreater(walked.mean_difference(looked), 3.0)

    @unittest.skipUnless(LONG, "long runs only: the test before it holds keys, too")
    def test_p_lets_held_motion_go(self):
        def unpause(window):
            self.xdo("key", "p")
            time.sleep(1.5)
            self.leave(window)
        still, moved = self.play(self.leave, "--time", "0"), self.play(unpause, "--time", "0")
        self.assertGreater(still.mean_difference(moved), 0.3)

    def test_counted_frames_end_by_themselves_and_look_like_headless_ones(self):
        for name, extra in (("window", ()), ("headless", ("--headless",))):
            done = self.call("--size", SMALL, "--frames", 3, "--time", 1.0, "--exposure", 6, "--screenshot",
                             self.path(name + ".png"), "--stats", self.path(name + ".json"), *extra)
            self.assertEqual(done.returncode, 0, done.stderr.decode(errors="replace"))
        window, headless = Picture(self.path("window.png")), Picture(self.path("headless.png"))
        self.assertLess(window.mean_difference(headless), 0.05)
        with open(self.path("window.json"), encoding="utf-8") as text:
            self.assertEqual(len(json.load(text)["frames"]), 3)

    def test_the_window_can_be_resized(self):
        def resize(window):
            self.xdo("windowsize", "--sync", window, "200", "240")
            time.sleep(1.0)
            self.leave(window)
        picture = self.play(resize, "--time", "0")
        self.assertEqual((picture.width, picture.height), (200, 240))
        self.assertGreater(picture.shade_count(), 500)


if __name__ == "__main__":
    main_in_display()
