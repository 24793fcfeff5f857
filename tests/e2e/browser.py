"""Pages in a browser without a window: what it says on its console, and what it shows."""
import os
import re
import shutil
import subprocess
import tempfile

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
TIMEOUT_S = 240
# As Chromium logs it: [...:INFO:CONSOLE(12)] "text", source: file:///...
SAID = re.compile(r":CONSOLE[(:]\d+\)?\] (.*)")


def find():
    """The command of a browser that starts, or None and why."""
    why = "no browser is installed (%s)" % ", ".join(BROWSERS)
    for name in BROWSERS:
        command = shutil.which(name)
        if not command:
            continue
        try:
            done = subprocess.run([command, "--version"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  timeout=TIMEOUT_S, check=False)
        except subprocess.TimeoutExpired:
            why = "%s does not start" % command
            continue
        if done.returncode == 0:
            return command, ""
        why = "%s does not start: %s" % (command, done.stdout.decode(errors="replace").strip()[-200:])
    return None, why


class Shown:
    """A page once its scripts have run: `said` on the console, the document as it is then, a picture of it."""

    def __init__(self, browser, page, screenshot, size=(1000, 900)):
        profile = tempfile.mkdtemp(prefix="gnomon_browser_")
        common = [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                  "--disable-background-networking", "--hide-scrollbars", "--user-data-dir=" + profile,
                  "--enable-logging=stderr", "--window-size=%d,%d" % size, "--virtual-time-budget=5000"]
        address = "file://" + os.path.abspath(page)
        try:
            drawn = self._run(common + ["--screenshot=" + screenshot, address])
            dumped = self._run(common + ["--dump-dom", address])
        finally:
            shutil.rmtree(profile, True)
        log = drawn.stderr.decode(errors="replace")
        self.said = [found.group(1) for found in map(SAID.search, log.splitlines()) if found]
        self.document = dumped.stdout.decode(errors="replace")

    @staticmethod
    def _run(command):
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=True)
