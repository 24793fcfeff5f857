"""The keys of debug views, in a real window under Xvfb."""
import time

from game import Picture, SMALL
from window import WindowTest, main_in_display

HELD = ("--time", "0")  # nothing but keys can change the picture
BETWEEN_S = 0.8  # presses: each has to fall into a frame of its own, on a busy machine as well
WALK_S = 2.0


def white(picture):
    return sum(picture.rgba[i:i + 3] == b"\xff\xff\xff" for i in range(0, len(picture.rgba), 4))


class Keys(WindowTest):
    def press(self, *keys, walk=False):
        """What `play` calls: presses the keys one after the other, walks backward if asked, and leaves."""
        def script(window):
            for key in keys:
                self.xdo("key", key)
                time.sleep(BETWEEN_S)
            if walk:
                self.xdo("keydown", "s")
                time.sleep(WALK_S)
                self.xdo("keyup", "s")
                time.sleep(BETWEEN_S)
            self.leave(window)
        return script

    def headless(self, *args):
        file = self.path("headless.png")
        self.run_game("--size", SMALL, "--frames", 3, "--exposure", 6, "--screenshot", file, *HELD, *args)
        return Picture(file)

    def test_f2_shows_the_depth_maps_of_one_light_after_the_other(self):
        for presses, light in ((1, "sun"), (2, "lantern"), (3, "guard_lamp")):
            shown = self.play(self.press(*["F2"] * presses), *HELD)
            self.assertLess(shown.mean_difference(self.headless("--debug", "depth:" + light)), 0.05, light)
        self.assertEqual(self.play(self.press(*["F2"] * 4), *HELD).rgba, self.play(self.leave, *HELD).rgba)

    def test_f3_shows_one_debug_view_after_the_other_and_ends_with_none(self):
        plain = self.play(self.leave, *HELD)
        for presses, view in ((1, "cascades"), (2, "texels")):
            shown = self.play(self.press(*["F3"] * presses), *HELD)
            self.assertLess(shown.mean_difference(self.headless("--debug", view + ":sun")), 0.05, view)
            self.assertGreater(shown.mean_difference(plain), 1.0, view)
        self.assertEqual(self.play(self.press(*["F3"] * 8), *HELD).rgba, plain.rgba)

    # The frusta of fits that were kept are shown with the camera that they are for, in white; from that camera's own
    # place, and without keeping them, there is no such frame.
    def test_f4_keeps_the_fits_for_the_camera_as_it_stood(self):
        frusta = HELD + ("--debug", "frusta")
        gone = white(self.play(self.press(walk=True), *frusta))
        kept = white(self.play(self.press("F4", walk=True), *frusta))
        let_go = white(self.play(self.press("F4", "F4", walk=True), *frusta))
        self.assertGreater(kept, gone + 100)
        self.assertLess(let_go, gone + 100)


if __name__ == "__main__":
    main_in_display()
