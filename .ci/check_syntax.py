#!/usr/bin/env python3
"""Lets a compiler read every source file by itself, without making code of it.

usage: check_syntax.py BUILD_FOLDER [FOLDER_LEFT_OUT ...]
Files of the folder's compile_commands.json, with its flags: so warnings are errors where they are configured to be, and no
file may lack an include that a joined build would bring along. Generated files are left out, and those in the folders named.
Exit status: 1 if a file is refused, or if there are none.
"""
import json
import os
import re
import shlex
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROGRESS_S = 30


def check(entry):
    """What the compiler says of one file; empty if nothing."""
    words = shlex.split(entry["command"])
    output = words.index("-o")
    del words[output:output + 2]
    done = subprocess.run(words + ["-fsyntax-only"], cwd=entry["directory"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    text = done.stdout.decode(errors="replace")
    return f"{entry['file']}\n{text}" if done.returncode != 0 or text else ""


def main(folder, left_out):
    entries = json.loads((folder / "compile_commands.json").read_text(encoding="utf-8"))
    entries = [entry for entry in entries if not re.search(r"/build/", entry["file"])
               and not any(Path(entry["file"]).is_relative_to(folder_left_out) for folder_left_out in left_out)]
    begin = shown = time.monotonic()
    refused = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, text in enumerate(pool.map(check, entries), 1):
            if text:
                refused += 1
                print(text, flush=True)
            if time.monotonic() - shown > PROGRESS_S:
                shown = time.monotonic()
                left = (shown - begin) / done * (len(entries) - done)
                print(f"reading files: {done} of {len(entries)}, {refused} refused, about {left:.0f} s left", flush=True)
    print(f"{len(entries)} files read in {time.monotonic() - begin:.0f} s, {refused} refused")
    return 0 if entries and refused == 0 else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), [Path(argument).resolve() for argument in sys.argv[2:]]))
