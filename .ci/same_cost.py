#!/usr/bin/env python3
"""Compares what a frame costs the processor in two builds: instructions, counted by valgrind, which no other work disturbs.

usage: same_cost.py OLD NEW
  OLD, NEW  executables gnomon_frame_walk (build/release/bin), which run frames on a device that keeps nothing
Prints instructions per frame of each scene, still and moving, and the ratio. What is done once, such as loading, does not
count: it is the difference of two runs. Exit status: 0 if no ratio is above 1.02, 77 without valgrind.
"""
import re
import shutil
import subprocess
import sys

CASES = [(scene, way) for scene in ("courtyard", "valley", "spheres") for way in ("still", "moving")]
# The hundredth frame is warm (tests/system/frame_cost_test.cpp).
WARM, MORE = 100, 50
MOST = 1.02


def instructions(program, scene, way, frames):
    """Instructions of a whole run."""
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, scene, way, str(frames)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    text = done.stdout.decode(errors="replace")
    found = re.search(r"Collected : (\d+)", text)
    if done.returncode != 0 or not found:
        raise SystemExit(f"{program} {scene} {way} ended with {done.returncode}:\n{text}")
    return int(found[1])


def per_frame(program, scene, way):
    return (instructions(program, scene, way, WARM + MORE) - instructions(program, scene, way, WARM)) / MORE


def main(old, new):
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed")
        return 77
    worst = 0.0
    for scene, way in CASES:
        before, after = per_frame(old, scene, way), per_frame(new, scene, way)
        worst = max(worst, after / before)
        print(f"{scene:10} {way:7} {before:12.0f} {after:12.0f}  x {after / before:.4f}", flush=True)
    print(f"most: x {worst:.4f}, {MOST} is the limit")
    return 0 if worst <= MOST else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
