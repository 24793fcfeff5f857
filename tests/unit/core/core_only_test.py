#!/usr/bin/env python3
"""Runs examples/core_only.cpp and checks what it prints, number by number.

usage: core_only_test.py EXECUTABLE              exit status 1 and a line per mistake
       core_only_test.py --self-test EXECUTABLE  spoils one kind of line after another and expects it to be found
"""
import re
import subprocess
import sys

ROW = re.compile(r"    map_from_anchor\[(\d)\] +(\S+) +(\S+) +(\S+) +(\S+)$")
LAYER = re.compile(r"  layer (\d+): (\S+) to (\S+) m, error (\S+) px, casters((?: \d+)*)$")
LIGHT = re.compile(r"(sun|spot|bulb): (\w+): (.+\.)$")
MAPS = re.compile(r"  (array|cube) of (\d+) layers, (\d+) px, error (\S+) px$")
CORNER = re.compile(r"corner of box (\d+) under the sun: (\S+) (\S+) (\S+), offset (\S+) m along the normal and (\S+) of depth$")
CORNER_WS = (6.5, 3.5, -4.5)  # of make_yard()'s last box
PILLARS = {36, 37, 38, 39, 40}


def run(executable, *flags):
    done = subprocess.run([executable, *flags], capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


def parse(text):
    """The printed lights by name, and the corner's numbers. Lines of another form are listed as unknown."""
    lights, corner, unknown = {}, None, []
    light = layer = None
    for line in text.splitlines()[1:]:
        if match := LIGHT.match(line):
            light = lights[match[1]] = {"status": match[2], "layers": []}
        elif match := MAPS.match(line):
            light.update(kind=match[1], count=int(match[2]), px=int(match[3]), error=float(match[4]))
        elif match := LAYER.match(line):
            layer = {"layer": int(match[1]), "near": float(match[2]), "far": float(match[3]), "error": float(match[4]),
                     "casters": set(map(int, match[5].split())), "rows": []}
            light["layers"].append(layer)
        elif match := re.match(r"    anchor (\S+) (\S+) (\S+)$", line):
            layer["anchor"] = [float(match[i]) for i in (1, 2, 3)]
        elif match := ROW.match(line):
            layer["rows"].append([float(match[i]) for i in (2, 3, 4, 5)])
        elif match := re.match(r"    bias: texel (\S+) (\S+), reach (\S+) texels, depth (\S+)$", line):
            layer["bias"] = [float(match[i]) for i in (1, 2, 3, 4)]
        elif match := CORNER.match(line):
            corner = {"box": int(match[1]), "place": [float(match[i]) for i in (2, 3, 4)], "offset": float(match[5]),
                      "depth": float(match[6])}
        else:
            unknown.append(line)
    return lights, corner, unknown


def place(layer, point):
    """Texture coordinates and depth of a point, by the printed matrix."""
    near = [p - a for p, a in zip(point, layer["anchor"])] + [1.0]
    x, y, z, w = (sum(m * p for m, p in zip(row, near)) for row in layer["rows"])
    return [x / w, y / w, z / w]


def mistakes_of(text, api, depth):
    """What is wrong with the output for one convention."""
    found = []
    expect = lambda right, what: found.append(f"{api}, {depth}: {what}") if not right else None
    expect(text.startswith(f"api {api}, depth {depth}\n"), "first line")
    lights, corner, unknown = parse(text)
    expect(not unknown, f"unknown lines {unknown}")
    expect(list(lights) == ["sun", "spot", "bulb"], f"lights {list(lights)}")
    if found or corner is None:
        return [*found, f"{api}, {depth}: no corner"] if corner is None else found
    for name, light in lights.items():
        expect(light["status"] == "fitted", f"{name} is {light['status']}")
        expect(light["kind"] == ("cube" if name == "bulb" else "array"), f"{name} is a {light['kind']}")
        expect(64 <= light["px"] <= 8192, f"{name} has {light['px']} px")
        expect(0 < len(light["layers"]) <= light["count"], f"{name} has {len(light['layers'])} layers")
        drawn = set().union(*(layer["casters"] for layer in light["layers"]))
        expect(PILLARS <= drawn, f"{name} lacks pillars {PILLARS - drawn}")
        expect(abs(max(layer["error"] for layer in light["layers"]) - light["error"]) < 0.01, f"{name}: largest error")
        for layer in light["layers"]:
            expect(layer["near"] < layer["far"], f"{name}: range")
            expect(len(layer["rows"]) == 4, f"{name}: rows")
            expect(layer["bias"][2] == 1.0039 and 0.0 < layer["bias"][3] < 1e-5, f"{name}: bias {layer['bias']}")
    sun = lights["sun"]["layers"][0]
    expect(corner["box"] == 40 and max(abs(a - b) for a, b in zip(place(sun, CORNER_WS), corner["place"])) < 2e-5,
           f"corner {corner['place']}, by the matrix {place(sun, CORNER_WS)}")
    expect(corner["depth"] > 0.0 and corner["offset"] >= 0.0, "offset")
    # A bulb's faces share its place; the ground below it lies in one of them.
    below = [place(face, (-1.0, 0.0, 1.5)) for face in lights["bulb"]["layers"]]
    expect(any(all(0.0 <= c <= 1.0 for c in p) for p in below), f"below the bulb: {below}")
    return found


def outputs(executable):
    return {(api, depth): run(executable, "--api", api, "--depth", depth)[1]
            for api in ("opengl", "vulkan", "direct3d", "metal", "webgpu") for depth in ("reversed", "standard")}


def all_mistakes(texts):
    found = [mistake for (api, depth), text in texts.items() for mistake in mistakes_of(text, api, depth)]
    if found:
        return found
    corners = {key: parse(text)[1]["place"] for key, text in texts.items()}
    u, v, depth = corners["opengl", "reversed"]
    for (api, kind), at in corners.items():
        want = [u, v if api == "opengl" else 1.0 - v, depth if kind == "reversed" else 1.0 - depth]
        if max(abs(a - b) for a, b in zip(at, want)) > 2e-5:
            found.append(f"{api}, {kind}: corner at {at}, expected {want}")
    return found


def flag_mistakes(executable):
    found = []
    code, out, err = run(executable, "--help")
    if code != 0 or err or not all(flag in out for flag in ("--api", "--depth", "--frames", "--max-error", "--help")):
        found.append(f"--help: {code}, {out!r}, {err!r}")
    for flags in (["--api", "glide"], ["--depth"], ["--frames", "0"], ["--frames", "x"], ["--max-error", "nan"], ["--nothing"]):
        code, out, err = run(executable, *flags)
        if code != 2 or out or not err.startswith("core_only: "):
            found.append(f"{flags}: {code}, {out!r}, {err!r}")
    code, out, _ = run(executable, "--frames", "300", "--max-error", "4")
    finer = parse(run(executable, "--max-error", "0.5")[1])[0]
    coarser = parse(out)[0]
    if code != 0 or not all(coarser[n]["px"] < finer[n]["px"] and coarser[n]["error"] > finer[n]["error"] for n in finer):
        found.append(f"a larger error is allowed, and costs no less: {coarser}, {finer}")
    return found


def self_test(executable):
    texts = outputs(executable)
    key = ("vulkan", "standard")
    missed = []
    for spoil in ((r"api vulkan", "api opengl"), (r"^sun: fitted", "sun: no_caster"), (r"(map_from_anchor\[1\] +)-?", r"\1 9"),
                  (r" 38", ""), (r"corner of box 40 under the sun: \S+", "corner of box 40 under the sun: 0.12345"),
                  (r"cube of", "array of"), (r"^spot", "lamp"), (r"depth \d\S+$", "depth 0.5")):
        text = re.sub(*spoil, texts[key], flags=re.MULTILINE)
        if text == texts[key] or not all_mistakes({**texts, key: text}):
            missed.append(spoil)
    swapped = {**texts, ("vulkan", "reversed"): texts["opengl", "reversed"].replace("api opengl", "api vulkan")}
    if not all_mistakes(swapped):
        missed.append("rows upside down")
    print(*missed, f"9 mistakes made, {len(missed)} not found", sep="\n")
    return 1 if missed else 0


def main(arguments):
    executable = arguments[-1]
    if "--self-test" in arguments:
        return self_test(executable)
    found = all_mistakes(outputs(executable)) + flag_mistakes(executable)
    print(*found, f"{len(found)} mistakes", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
