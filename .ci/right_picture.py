#!/usr/bin/env python3
"""Says whether a picture drawn on another system is right: by rays, and beside the one drawn here.

usage: right_picture.py HERE.png FOLDER
FOLDER holds there.png, there.json (--stats of a run with --truth) and no_shadows.json, the same of a run without shadows,
which must be found wrong: it shows that the judge can tell.
"""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "e2e"))
sys.dont_write_bytecode = True
from game import Picture  # noqa: E402

MOST_WRONG = 0.0005  # of a light's pixels: what docs/results/accuracy.md says of the defaults
LEAST_WITHOUT_SHADOWS = 0.01
MOST_DIFFERENT = 0.001  # of the pictures' channels: drivers round differently along edges
LEVELS = 8  # of 255, by which a pixel may differ


def wrong_shares(path):
    """{light: share of its pixels on the wrong side of its shadow}"""
    lights = json.loads(path.read_text(encoding="utf-8"))["truth"]["lights"]
    return {light["name"]: light["wrong"] for light in lights}


def different_share(one, other):
    """Share of the channels of two pictures that differ by more than LEVELS; all, if their sizes do."""
    if len(one.rgba) != len(other.rgba):
        return 1.0
    return sum(abs(a - b) > LEVELS for a, b in zip(one.rgba, other.rgba)) / len(one.rgba)


def main(here, folder):
    there = wrong_shares(folder / "there.json")
    control = wrong_shares(folder / "no_shadows.json")
    different = different_share(Picture(here), Picture(folder / "there.png"))
    for name, wrong in there.items():
        print(f"{name}: {100 * wrong:.3f} % wrong by rays, {100 * control[name]:.1f} % without shadows")
    print(f"{100 * different:.3f} % of the picture differs from the one drawn here by more than {LEVELS} levels")
    right = (
        bool(there)
        and all(wrong <= MOST_WRONG for wrong in there.values())
        and all(control[name] >= LEAST_WITHOUT_SHADOWS for name in there)
        and different <= MOST_DIFFERENT
    )
    print("the picture is right" if right else "the picture is NOT right")
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
