"""The key that freezes the frame and shows its errors, in a real window under Xvfb."""
import subprocess
import time

from game import Picture, SMALL, TIMEOUT_S
from window import WindowTest, main_in_display

# In the title: while rays are followed, and once every light was judged.
TRACING, FROZEN = "- tracing the truth -", "- frozen -"
# Nothing but keys can change the picture: sizes that are chosen would come to rest after so many frames.
HELD = ("--time", "3", "--set", "resolution=1024", "--set", "cascades=3")
BETWEEN_S = 0.8  # presses: each has to fall into a frame of its own, on a busy machine as well
WALK_S = 1.5


class Frozen(WindowTest):
    def wait_for_title(self, window, is_right):
        deadline, title = time.monotonic() + TIMEOUT_S, ""
        while time.monotonic() < deadline:
            title = subprocess.run(["xdotool", "getwindowname", window], stdout=subprocess.PIPE, check=True).stdout
            if is_right(title.decode()):
                return
            time.sleep(0.1)
        self.fail("the title is %r" % title)

    def wait_for_errors(self, window):
        self.wait_for_title(window, lambda title: FROZEN in title)

    def let_go(self, window):
        self.xdo("key", "F5")
        self.wait_for_title(window, lambda title: FROZEN not in title and TRACING not in title)
        time.sleep(BETWEEN_S)

    def press(self, *keys):
        """What `play` calls: freezes the frame, waits for its errors, presses keys, and leaves."""
        def script(window):
            self.xdo("key", "F5")
            self.wait_for_errors(window)
            for key in keys:
                self.xdo("key", key)
                time.sleep(BETWEEN_S)
            self.leave(window)
        return script

    def headless(self, *args):
        file = self.path("headless.png")
        self.run_game("--size", SMALL, "--frames", 3, "--exposure", 6, "--truth", file, *HELD, *args)
        return Picture(file)

    def test_f5_shows_the_errors_that_headless_runs_write_and_f2_those_of_one_light(self):
        plain = self.play(self.leave, *HELD)
        worst = self.play(self.press(), *HELD)
        self.assertLess(worst.mean_difference(self.headless()), 0.05)
        self.assertGreater(worst.mean_difference(plain), 10.0)
        sun = self.play(self.press("F2"), *HELD)
        self.assertLess(sun.mean_difference(self.headless("--truth-light", "sun")), 0.05)
        self.assertGreater(sun.mean_difference(worst), 0.05)

    def test_nobody_moves_while_it_is_frozen_and_f5_lets_it_go(self):
        def walk(window):
            self.xdo("key", "F5")
            time.sleep(BETWEEN_S)
            self.xdo("keydown", "w")
            time.sleep(WALK_S)
            self.xdo("keyup", "w")
            self.xdo("key", "p")
            time.sleep(BETWEEN_S)
            self.wait_for_errors(window)
            if lets_go:
                self.let_go(window)
            self.leave(window)
        lets_go = True
        self.assertEqual(self.play(walk, *HELD).rgba, self.play(self.leave, *HELD).rgba)
        lets_go = False
        self.assertLess(self.play(walk, *HELD).mean_difference(self.headless()), 0.05)

    def test_a_second_press_cancels_the_trace(self):
        def cancel(window):
            self.xdo("key", "F5")
            self.wait_for_title(window, lambda title: FROZEN in title or TRACING in title)
            self.let_go(window)
            self.leave(window)
        large = {"size": "1280x720"}  # it is traced for seconds
        self.assertEqual(self.play(cancel, *HELD, **large).rgba, self.play(self.leave, *HELD, **large).rgba)


if __name__ == "__main__":
    main_in_display()
