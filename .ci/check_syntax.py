#!/usr/bin/env python3
"""Lets a compiler read source files, without making code of them. Warnings are errors where the folder is configured so.

usage: check_syntax.py FOLDER                        every file by itself: none lacks an include that joined builds bring along
       check_syntax.py FOLDER --since DAYS           those of them that commits of the last days before HEAD changed
       check_syntax.py FOLDER --beside OTHER TARGET ...   as FOLDER compiles them, joined; less what OTHER compiles for the targets
FOLDER and OTHER are build folders. Exit status: 1 if a file is refused, or if there are none; with --since none are fine.
"""
import argparse
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
ROOT = Path(__file__).resolve().parent.parent


def output(entry):
    """The object file that an entry makes, as ninja names it."""
    words = shlex.split(entry["command"])
    return words[words.index("-o") + 1]


def check(entry):
    """What the compiler says of one file; empty if nothing."""
    words = shlex.split(entry["command"])
    at = words.index("-o")
    del words[at:at + 2]
    done = subprocess.run(words + ["-fsyntax-only"], cwd=entry["directory"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    text = done.stdout.decode(errors="replace")
    return f"{entry['file']}\n{text}" if done.returncode != 0 or text else ""


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def is_generated(entry):
    return re.search(r"/build/", entry["file"]) is not None


def changed_files(days):
    """Files that commits changed within so many days before the last commit."""
    last_s = int(run("git", "-C", str(ROOT), "log", "-1", "--format=%ct"))
    since = f"--since={int(last_s - days * 86400)}"
    return {ROOT / name for name in run("git", "-C", str(ROOT), "log", since, "--name-only", "--format=").split("\n") if name}


def chosen(entries, options):
    if options.beside:
        folder, *targets = options.beside
        compiled = set(run("ninja", "-C", folder, "-t", "inputs", *targets).split("\n"))
        # Sources that a build writes are not there yet; its joined files are.
        return [entry for entry in entries if output(entry) not in compiled
                and (not is_generated(entry) or "/Unity/" in entry["file"])]
    entries = [entry for entry in entries if not is_generated(entry)]
    if options.since is None:
        return entries
    changed = changed_files(options.since)
    return [entry for entry in entries if Path(entry["file"]) in changed]


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--since", type=float)
    parser.add_argument("--beside", nargs="+")
    options = parser.parse_args(arguments)
    entries = chosen(json.loads((options.folder / "compile_commands.json").read_text(encoding="utf-8")), options)
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
    return 0 if refused == 0 and (entries or options.since is not None) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
