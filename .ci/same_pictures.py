#!/usr/bin/env python3
"""Compares what two builds of the game draw: pictures, visibilities and counts have to be equal to the byte.

usage: same_pictures.py OLD NEW [--data FOLDER] [--scenes COUNT] [--only TEXT] [--without ENDING]...
  OLD, NEW  executables of the game
  FOLDER    glTF files (default: ../shared/data); COUNT of them are taken, evenly spread over those that OLD loads
  TEXT      runs only cases whose name holds it
  ENDING    leaves statistics out whose key ends so, as times always are
Compared are the PNG, every visibility, and of the last frame's statistics all that is no time, where both have it. A case
that either cannot draw is not equal. The last line says how many cases are. Exit status: 0 if all are.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SIZE = "320x180"
TIMEOUT_S = 300
TIMES = ("_us", "_ns", "_ms")
FILTERS = ["hard", "hardware_2x2", "pcf_grid", "pcf_bilinear", "sharp_4x4", "poisson", "poisson_rotated",
           "poisson_stratified", "cube_grid", "cube_directions", "pcss", "exponential", "vsm", "evsm2", "evsm4", "moments",
           "pcss_moments", "triangles", "exact", "exact_soft"]
MOVING = ["--frames", "12", "--time", "2.5"]
SETTINGS = [["economy=off"], ["fit=tight"], ["fit=stable"], ["fit=tight", "warp=1"], ["splits=sampled"], ["cascades=3", "cascade_blend=0.2"],
            ["resolution=512"], ["max_error_px=4"], ["max_error_px=0.5"], ["cube_route=layered_geometry"], ["depth_format=d16"],
            ["bias=constant"], ["refresh_error_px=2"], ["projection=perspective"], ["filter=exact", "sun_radius_deg=0.3"]]


def cases_of_built_in_scenes():
    """(name, arguments): every filter and way to fit, moving, within budgets, with frozen fits."""
    for scene in ("courtyard", "valley", "spheres"):
        which = [] if scene == "courtyard" else ["--scene", scene]
        yield scene, which
        yield f"{scene} moving", which + MOVING
        yield f"{scene} 4 MB", which + MOVING + ["--shadow-bytes", "4000000"]
        yield f"{scene} 1 ms", which + MOVING + ["--shadow-ms", "1"]
        yield f"{scene} 20000 rays", which + MOVING + ["--shadow-rays", "20000", "--set", "filter=exact"]
    yield "courtyard walk", ["--demo", "--frames", "60"]
    yield "courtyard frozen", ["--camera", "1", "--fit-camera", "0"] + MOVING
    for name in FILTERS:
        yield f"courtyard {name}", MOVING + ["--set", f"filter={name}", "--set", "source_radius_m=0.05"]
        yield f"valley {name}", ["--scene", "valley", "--set", f"filter={name}"]
    for settings in SETTINGS:
        yield f"courtyard {' '.join(settings)}", MOVING + [word for one in settings for word in ("--set", one)]


def run(game, arguments, folder):
    """(status, {file: bytes}, statistics of the last frame) of one run."""
    command = [game, "--headless", "--size", SIZE, "--screenshot", folder / "picture.png", "--visibility", folder / "lights",
               "--stats", folder / "stats.json"] + arguments
    if "--frames" not in arguments:
        command += ["--frames", "3"]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=TIMEOUT_S, check=False)
    files = {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
             if path.suffix in (".png", ".pfm")}
    stats = folder / "stats.json"
    frames = json.loads(stats.read_text(encoding="utf-8"))["frames"] if stats.exists() else []
    return done.returncode, files, frames[-1] if frames else {}


def differences(old, new, without, where=""):
    """Places of two statistics that differ, of those that both have and whose key does not end with one of `without`."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in old.keys() & new.keys():
            if not key.endswith(without):
                yield from differences(old[key], new[key], without, f"{where}/{key}")
    elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        for i, (a, b) in enumerate(zip(old, new)):
            yield from differences(a, b, without, f"{where}/{i}")
    elif old != new:
        yield f"{where}: {old} != {new}"


def compare(job):
    """(name, what differs) of one case."""
    name, arguments, old_game, new_game, without = job
    with tempfile.TemporaryDirectory() as folder:
        results = []
        for which, game in (("old", old_game), ("new", new_game)):
            own = Path(folder) / which
            own.mkdir()
            results.append(run(game, arguments, own))
    (old_status, old_files, old_stats), (new_status, new_files, new_stats) = results
    if old_status != 0 or new_status != 0:  # two that fail alike prove nothing: every case can be drawn
        return name, [f"OLD ends with {old_status}, NEW with {new_status}"]
    found = [f"{file} differs" for file in sorted(old_files.keys() | new_files.keys())
             if old_files.get(file) != new_files.get(file)]
    found += differences(old_stats, new_stats, without)
    return name, found if "picture.png" in old_files else found + ["no picture"]


def scenes_of(data, count, game):
    """COUNT files of those that load, evenly spread by name."""
    files = sorted(path for path in data.rglob("*") if path.suffix in (".glb", ".gltf"))
    taken, step = [], max(len(files) // (count * 2), 1)
    for path in files[::step]:
        if len(taken) == count:
            break
        command = [game, "--headless", "--size", "16x16", "--scene", path]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=TIMEOUT_S, check=False)
        if done.returncode == 0:
            taken.append(path)
    return taken


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--data", type=Path, default=Path(__file__).resolve().parent.parent.parent / "shared" / "data")
    parser.add_argument("--scenes", type=int, default=24)
    parser.add_argument("--only", default="")
    parser.add_argument("--without", action="append", default=[])
    options = parser.parse_args(arguments)
    cases = list(cases_of_built_in_scenes())
    if options.data.is_dir():
        for path in scenes_of(options.data, options.scenes, options.old):
            cases.append((str(path.relative_to(options.data)), ["--scene", str(path)]))
    else:
        print(f"no files of {options.data}: it is not there")
    without = (*TIMES, *options.without)
    jobs = [(name, arguments, options.old, options.new, without) for name, arguments in cases if options.only in name]
    equal = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, found in pool.map(compare, jobs):
            equal += not found
            if found:
                print(f"{name}: {len(found)} differ", *found[:6], sep="\n    ", flush=True)
    print(f"{equal} of {len(jobs)} cases are equal")
    return 0 if equal == len(jobs) > 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
