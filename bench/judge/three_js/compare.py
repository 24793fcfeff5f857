#!/usr/bin/env python3
"""Holds three.js's shadows and Gnomon's against the same rays, in the courtyard: errors, edges, and what shadows cost.

usage: compare.py --bin FOLDER [--out FOLDER] [--size WxH] [--three VERSION] [--quick]
  --bin   has gnomon_game, gnomon_bench and gnomon_scene_generator
  --out   keeps the pictures and all.json; default build/compared
  --quick tries four settings of three.js instead of all

Needs npm, node and chromium. Prints tables for docs/results/compared_with.md. Both draw on the same device, if the browser is let
use it; the first line names what each drew on. three.js: every mesh casts and receives; a sun's box holds the scene; a lamp's
far plane its range or the scene. "best": of all tried settings the one with fewest wrong pixels, for each light by itself.
"""
import argparse
import json
import subprocess
import sys
import tarfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent.parent.parent / "tests" / "e2e"))
from game import glb_parts, write_glb  # noqa: E402
AREA_SIDE = "16"
TIMED_FRAMES = 15
SIZES = (1024, 2048, 4096)
BIASES = (0.0, -0.0001, -0.0005, -0.002)
NORMAL_BIASES = (0.0, 0.02, 0.05)


def run(command, **more):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, check=False, **more)
    if done.returncode != 0:
        sys.exit("%s: exit status %d\n%s" % (command[0], done.returncode, done.stdout[-2000:]))
    return done.stdout


def fetch_three(version, out):
    """Folder of the npm package, which is not part of this project."""
    folder = out / ("three-" + version)
    if not (folder / "package").is_dir():
        folder.mkdir(parents=True, exist_ok=True)
        name = run(["npm", "pack", "--silent", "three@" + version], cwd=folder).split()[-1]
        with tarfile.open(folder / name) as packed:
            packed.extractall(folder)
    return folder / "package"


def stand_still(file):
    """Takes motions, which are Gnomon's own extras, out of a GLB: three.js leaves everything where it rests."""
    scene, binary = glb_parts(file)
    for node in scene["nodes"]:
        node.get("extras", {}).pop("motion", None)
    write_glb(file, scene, binary)


def tried(quick):
    sizes, biases, normals = ((2048,), BIASES[:2], NORMAL_BIASES[:2]) if quick else (SIZES, BIASES, NORMAL_BIASES)
    grid = [{"name": "%d %g %g" % (size, bias, normal), "map_size": size, "bias": bias, "normal_bias": normal}
            for size in sizes for bias in biases for normal in normals]
    return [{"name": "defaults"}] + grid


def draw(three, scene, out, size, settings, timed):
    width, height = map(int, size.split("x"))
    options = out / "options.json"
    options.write_text(json.dumps({"three": str(three), "scene": str(scene), "out": str(out), "width": width, "height": height,
                                   "settings": settings, "timed": timed, "limit_s": 3600}), encoding="utf-8")
    return json.loads(run(["node", HERE / "draw.mjs", options]))


def judge(bench, scene, folders, size, *flags):
    """{name of a folder: {light: figures}} of the visibilities in them; the same rays for all."""
    file = folders[0].parent / "judged.json"
    run([bench, "judge", "--scene", scene, "--visibility", *folders, "--size", size, "--json", file, *flags])
    found = json.loads(file.read_text(encoding="utf-8"))["folders"]
    return {Path(folder["folder"]).name: {light["name"]: light for light in folder["lights"]} for folder in found}


def gnomons_ms(bench, size, out):
    """(with, without) milliseconds of a frame in which everything moves, so that no map is kept."""
    file = out / "frame.json"
    run([bench, "frame", "--size", size, "--rounds", "5", "--repeat", "5", "--json", file])
    found = json.loads(file.read_text(encoding="utf-8"))
    return found["moving_us"]["median"] / 1000, found["moving_without_us"]["median"] / 1000


def percent(share):
    return "0" if share == 0 else "%.2g" % (100 * share) if share < 0.1 else "%.0f" % (100 * share)


def row(name, cells):
    return "| " + " | ".join([name, *cells]) + " |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=Path, required=True)
    parser.add_argument("--out", type=Path, default=Path("build/compared"))
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--three", default="0.187.0")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    out, bench = options.out.resolve(), options.bin.resolve() / "gnomon_bench"
    out.mkdir(parents=True, exist_ok=True)
    three, scene = fetch_three(options.three, out), out / "courtyard.glb"
    run([options.bin / "gnomon_scene_generator", scene])
    stand_still(scene)

    own = out / "gnomon"
    run([options.bin / "gnomon_game", "--headless", "--scene", scene, "--frames", "3", "--size", options.size,
         "--visibility", own])
    settings = tried(options.quick)
    end = draw(three, scene, out, options.size, settings, 0)
    judged = judge(bench, scene, [own] + [out / each["name"] for each in settings], options.size)
    lights = list(judged["gnomon"])

    best = {}
    for size in sorted({each["map_size"] for each in settings if "map_size" in each}):
        of_size = [each for each in settings if each.get("map_size") == size]
        best[size] = {light: min(of_size, key=lambda each: judged[each["name"]][light]["wrong"])["name"] for light in lights}
    chosen = [each for each in settings if each["name"] == "defaults" or any(each["name"] in b.values() for b in best.values())]
    timed = draw(three, scene, out, options.size, chosen, TIMED_FRAMES)["times"]
    judged |= judge(bench, scene, [own] + [out / each["name"] for each in chosen], options.size, "--area", AREA_SIDE, "--pictures")
    with_ms, without_ms = gnomons_ms(bench, options.size, out)

    rows = [("three.js, its defaults", {light: "defaults" for light in lights})]
    rows += [("three.js, best of %d settings at %d" % (sum(e.get("map_size") == size for e in settings), size), best[size])
             for size in best]
    rows.append(("Gnomon, its defaults", {light: "gnomon" for light in lights}))
    costs = {name: [times["with_ms"] - times["without_ms"]] for name, times in timed.items()}
    costs["gnomon"] = [with_ms - without_ms]
    print("three.js r%s on %s\n" % (end["three"], end["device"]))
    head = ["", *["%s: wrong, %%" % light for light in lights], *["%s: edge error" % light for light in lights], "shadows, ms"]
    print("|" + "|".join(" %s " % cell for cell in head) + "|\n|" + "---|" * len(head))
    for name, by_light in rows:
        cost = min(costs[by_light[light]][0] for light in lights)
        print(row(name, [percent(judged[by_light[light]][light]["wrong"]) for light in lights] +
                  ["%.2f" % judged[by_light[light]][light]["area"]["mean_error"] for light in lights] + ["%.0f" % cost]))
    print("\nbest settings (map, bias, normalBias): " + "; ".join(
        "%d: %s" % (size, ", ".join("%s %s" % (light, best[size][light].split(" ", 1)[1]) for light in lights)) for size in best))
    (out / "all.json").write_text(json.dumps({"judged": judged, "best": best, "times": timed, "gnomon_ms": [with_ms, without_ms],
                                              "three": end}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
