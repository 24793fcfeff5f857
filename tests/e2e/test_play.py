"""The game itself: the demo twice, and a player at keys and mouse who wins and who loses."""
import subprocess
import time

from depth_view import TITLE, Region, background, grey, nothing
from game import SMALL, TIMEOUT_S, Picture
from window import H, W, WindowTest, main_in_display

GREEN, RED, WORDS = (120, 220, 120), (225, 60, 40), (255, 214, 110)  # the words at the end of a game that was won, or lost


def share_of(picture, colour):
    """Share of pixels within 20 steps of `colour`."""
    px = picture.rgba
    near = sum(1 for p in zip(px[0::4], px[1::4], px[2::4]) if max(abs(a - b) for a, b in zip(p, colour)) < 20)
    return near / float(picture.width * picture.height)


class Play(WindowTest):
    def demo(self, name, time_s):
        file = self.path(name + ".png")
        stats = self.stats_of("--demo", "--size", SMALL, "--frames", 2, "--time", time_s, "--screenshot", file)
        return Picture(file), stats["frames"][-1]["game"]

    def test_the_demo_is_the_same_bit_for_bit_every_time(self):
        for time_s in (5.0, 12.0):
            first, again = self.demo("first", time_s), self.demo("again", time_s)
            self.assertEqual(first[1], again[1])
            self.assertEqual(first[0].rgba, again[0].rgba)
            self.assertEqual(first[1]["phase"], "playing")
        self.assertGreater(self.demo("other", 2.0)[0].mean_difference(first[0]), 3.0)

    def test_the_demo_ends_with_a_win_that_its_picture_shows(self):
        during, before = self.demo("during", 5.0)
        after, end = self.demo("after", 60.0)
        self.assertEqual((before["phase"], end["phase"]), ("playing", "won"))
        self.assertLess(end["seen"], 0.5)
        self.assertGreater(share_of(after, GREEN), 0.002)
        self.assertLess(share_of(during, GREEN), 0.001)

    def test_the_first_screen_names_the_keys_and_goes(self):
        def words(picture):
            """Share of the upper half in the colour of the task and of the keys' names."""
            half = picture.rgba[:len(picture.rgba) // 2]
            near = sum(max(abs(a - b) for a, b in zip(p, WORDS)) < 40 for p in zip(half[0::4], half[1::4], half[2::4]))
            return near / float(len(half) // 4)
        self.assertGreater(words(self.demo("begins", 2.0)[0]), 0.003)
        self.assertLess(words(self.demo("goes_on", 12.0)[0]), 0.001)

    def test_the_demo_takes_no_other_scene(self):
        self.assert_refused("--demo", "--headless", "--camera", "top", mentions="--demo")

    def title(self, window):
        return subprocess.run(["xdotool", "getwindowname", window], stdout=subprocess.PIPE, check=True,
                              timeout=TIMEOUT_S).stdout.decode()

    def wait_for(self, window, state):
        deadline = time.monotonic() + TIMEOUT_S
        while " %s " % state not in self.title(window):
            self.assertLess(time.monotonic(), deadline, "not %s: %s" % (state, self.title(window)))
            time.sleep(0.1)

    def test_w_along_the_wall_wins_while_the_lamp_looks_away(self):
        def win(window):
            self.wait_for(window, "playing")
            self.xdo("key", "r")
            self.xdo("keydown", "w")
            self.wait_for(window, "won")
            self.xdo("keyup", "w")
            time.sleep(0.5)
            self.leave(window)
        picture = self.play(win)
        self.assertGreater(share_of(picture, GREEN), 0.002)
        self.assertLess(share_of(picture, RED), 0.001)

    def test_mouse_and_w_into_the_light_loses_and_r_starts_again(self):
        def lose(window):
            self.xdo("mousemove", "--window", window, str(W // 2), str(H // 2), "click", "1")
            time.sleep(0.7)
            for _ in range(9):  # 0.45 rad to the left, twice that if the server accelerates: into the open either way
                self.xdo("mousemove_relative", "--", "-20", "0")
                time.sleep(0.05)
            self.xdo("keydown", "w")
            self.wait_for(window, "lost")
            self.xdo("keyup", "w")

        def lose_and_leave(window):
            lose(window)
            time.sleep(0.5)
            self.leave(window)

        def lose_and_restart(window):
            lose(window)
            self.xdo("key", "r")
            self.wait_for(window, "playing")
            time.sleep(0.5)
            self.leave(window)
        lost, restarted = self.play(lose_and_leave), self.play(lose_and_restart)
        self.assertGreater(share_of(lost, RED), 0.002)
        self.assertLess(share_of(lost, GREEN), 0.001)
        self.assertLess(share_of(restarted, RED), 0.001)

    def test_p_holds_the_game_and_says_so(self):
        def pause(window):
            self.xdo("key", "p")
            self.wait_for(window, "paused")
            time.sleep(0.5)
            self.leave(window)
        first, again = self.play(pause), self.play(pause)
        words = [(x, y) for y in range(H * 34 // 100, H * 46 // 100) for x in range(W)
                 if first.rgba[4 * (y * W + x)] > 215 and first.rgba[4 * (y * W + x) + 1] > 210]
        self.assertGreater(len(words), 60)
        self.assertLess(first.mean_difference(again), 20.0)

    def test_f1_shows_the_panel_of_lights(self):
        def panel(window):
            self.xdo("key", "p", "F1")
            self.wait_for(window, "paused")
            time.sleep(1.0)
            self.leave(window)

        def no_panel(window):
            self.xdo("key", "p")
            self.wait_for(window, "paused")
            time.sleep(1.0)
            self.leave(window)
        shown, hidden = self.play(panel), self.play(no_panel)
        self.assertGreater(shown.mean_difference(hidden), 5.0)

    def test_f2_shows_one_light_after_the_other_beside_the_panel(self):
        width, height = 960, 540

        def shown(first, *keys):
            """What lies beside the panel, as a picture and as a region of it."""
            def script(window):
                for key in keys:
                    self.xdo("key", key)
                # Each state that the title shows has been drawn; the panel takes two frames to find its size.
                for state in ("paused", "playing", "paused"):
                    self.xdo("key", "p")
                    self.wait_for(window, state)
                self.leave(window)
            picture = self.play(script, "--set", "resolution=256", *first, size="%dx%d" % (width, height))
            return picture, Region(picture, 0.75 * width, TITLE, 0.25 * width, height - TITLE)
        of_maps = lambda p: nothing(p) or background(p)
        pictures = []
        for first in ((), ("--debug", "depth:sun")):
            picture, region = shown(first, "F1", "F2")
            self.assertGreater(region.share(lambda p: grey(p) or nothing(p)), 0.95, first)
            pictures.append(picture)
        self.assertGreater(pictures[0].mean_difference(pictures[1]), 5.0)
        self.assertLess(shown(("--debug", "depth:guard_lamp"), "F1", "F2")[1].share(of_maps), 0.5)


if __name__ == "__main__":
    main_in_display()
