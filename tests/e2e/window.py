"""What tests with a window share: a display of their own, keys and mouse."""
import os
import shutil
import subprocess
import sys
import time

from game import GameTest, Picture, SMALL, TIMEOUT_S, main

TOOLS = ("Xvfb", "xvfb-run", "xdotool")
MISSING = [tool for tool in TOOLS if shutil.which(tool) is None]
INSIDE = "GNOMON_E2E_DISPLAY_IS_OURS"
W, H = (int(n) for n in SMALL.split("x"))


class WindowTest(GameTest):
    def play(self, script, *args, size=SMALL):
        """Runs the game in a window, calls script(window id), and returns the picture it wrote when it ended."""
        file = self.path("w%d.png" % len(os.listdir(self.folder)))
        game = subprocess.Popen([self.game, "--size", size, "--exposure", "6", "--screenshot", file] + list(args),
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            script(self.find_window(game))
            out, err = game.communicate(timeout=TIMEOUT_S)
        finally:
            if game.poll() is None:
                game.kill()
                game.communicate()
        self.assertEqual(game.returncode, 0, err.decode(errors="replace"))
        return Picture(file)

    def find_window(self, game):
        deadline = time.monotonic() + TIMEOUT_S
        while time.monotonic() < deadline:
            if game.poll() is not None:
                self.fail("the game ended early: " + game.stderr.read().decode(errors="replace"))
            # The title carries the frame rate once frames have been drawn: then it listens.
            found = subprocess.run(["xdotool", "search", "--name", "Gnomon - "], stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, check=False).stdout.split()
            if found:
                window = found[0].decode()
                self.xdo("windowfocus", "--sync", window)
                return window
            time.sleep(0.1)
        self.fail("no window within %d s" % TIMEOUT_S)

    def xdo(self, *args):
        subprocess.run(["xdotool"] + list(args), check=True, timeout=TIMEOUT_S, stdout=subprocess.DEVNULL)

    def leave(self, window):
        self.xdo("windowfocus", window, "key", "Escape")


def main_in_display():
    if MISSING:
        print("SKIPPED: not installed: " + ", ".join(MISSING))
        sys.exit(77)
    if INSIDE not in os.environ:
        # A display of our own, so that nobody's desktop gets our key presses.
        # Without -noreset the server starts anew when its last client goes, and refuses the next one meanwhile.
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x720x24 -noreset", sys.executable] + sys.argv
        sys.exit(subprocess.run(command, env=dict(os.environ, **{INSIDE: "1"}), check=False).returncode)
    main()
