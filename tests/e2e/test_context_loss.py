"""The graphics context is lost while the game runs: what the executable does then."""
import os
import sys

from game import BAD_INPUT, GameTest, SMALL, main, read_bytes


class ContextLoss(GameTest):
    shim = None

    def film(self, name, lose_at):
        """The last picture of twelve frames of the demo, and what was said."""
        env = dict(os.environ, LD_PRELOAD=self.shim, GNOMON_LOSE_AT=str(lose_at), LIBGL_ALWAYS_SOFTWARE="1")
        file = self.path(name + ".png")
        done = self.call("--headless", "--demo", "--frames", 12, "--size", SMALL, "--screenshot", file, env=env)
        text = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, 0, text)
        return read_bytes(file), text

    def test_without_a_window_it_is_made_anew_and_the_picture_is_the_same(self):
        unbroken, said = self.film("unbroken", 0)
        self.assertNotIn("lost", said)
        for call in (30, 50, 70):  # each call that creates or draws asks once: set-up takes less than these
            broken, said = self.film("broken%d" % call, call)
            self.assertIn("the graphics context was lost, and is made anew", said)
            self.assertEqual(broken, unbroken, "lost at call %d" % call)

    def test_one_that_is_lost_in_set_up_is_one_clear_line(self):
        env = dict(os.environ, LD_PRELOAD=self.shim, GNOMON_LOSE_AT="3", LIBGL_ALWAYS_SOFTWARE="1")
        done = self.call("--headless", "--size", SMALL, env=env)
        text = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, BAD_INPUT, text)
        self.assertEqual(len(text.splitlines()), 1, text)
        self.assertIn("context_lost", text)


if __name__ == "__main__":
    ContextLoss.shim = os.path.abspath(sys.argv.pop(3))
    main()
