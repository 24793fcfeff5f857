#!/usr/bin/env python3
"""Builds examples/ against an installed copy of Gnomon, runs each program and looks for its shadows in its picture.

usage: run_examples.py BUILD SOURCE WORK CXX [LAUNCHER]
BUILD is Gnomon's build, which is installed below WORK. A second copy of the examples reads no mask, or has no casters: every
check must fail on what that one draws.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
WIDTH, HEIGHT = 320, 180
SIZE = ["--size", "%dx%d" % (WIDTH, HEIGHT)]
LEVELS = 12             # of 255, by which a shadow is darker at least
MOST_HEADERS = 15       # of Gnomon's that an example includes, directly or not
MOST_LINES = 60         # of first_shadow, and of own_ecs_forward that speak of Gnomon
MOST_DIFFERENT = 0.001  # of the pixels: along edges, where a light's map has another size or place
FRAMES = {"streaming": 24}
# Share of the picture that lies in shadow: least and most. Places in the picture's width and height: in shadow, and lit.
PICTURES = {
    "first_shadow": ((0.005, 0.1), (0.39, 0.50), (0.20, 0.70)),
    "own_ecs_forward": ((0.02, 0.6), (0.50, 0.50), (0.50, 0.80)),
    "deferred_mask": ((0.02, 0.5), (0.42, 0.825), (0.10, 0.65)),
    "shadow_catcher": ((0.005, 0.3), (0.39, 0.50), (0.20, 0.70)),
    "streaming": ((0.02, 0.6), None, None),
    "split_screen": ((0.02, 0.6), None, None),
    "wind_foliage": ((0.02, 0.5), None, None),
    "clustered": ((0.02, 0.6), None, None),
    "sdl_window": ((0.01, 0.3), (0.36, 0.61), (0.60, 0.72)),
}
UNSHADOWED = re.compile(r"texelFetch\(shadow_mask, ivec3\((?:gl_FragCoord\.xy|pixel), (?:0|i)\), 0\)\.r"
                        r"|gnomon_visibility\(int\(lamp\.w\), place - camera, normal\)")


class Wrong(Exception):
    """What an example did, and should not have."""


def run(*command, code=0, env=None):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=300, env=env, check=False)
    if done.returncode != code:
        raise Wrong("%s\nended with %d:\n%s%s" % (" ".join(map(str, command)), done.returncode, done.stdout, done.stderr))
    return done


def build(folder, into, prefix, compiler, launcher):
    run("cmake", "-S", folder, "-B", into, "-G", "Ninja", "-DCMAKE_PREFIX_PATH=%s" % prefix, "-DCMAKE_CXX_COMPILER=%s" % compiler,
        "-DCMAKE_CXX_COMPILER_LAUNCHER=%s" % launcher, "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wshadow -Werror")
    run("cmake", "--build", into)


def copy_without_shadows(examples, into):
    """The examples, with shaders that take every light for visible; queries have nothing that casts."""
    shutil.copytree(examples, into)
    for file in sorted(into.glob("*.cpp")):
        text = file.read_text(encoding="utf-8")
        if file.stem in PICTURES:
            text, count = UNSHADOWED.subn("1.0", text)
            if count != 1:
                raise Wrong("%s reads its mask %d times" % (file.name, count))
        else:
            text = text.replace(".mesh = pillars.value()", ".mesh = pillars.value(), .casts = false")
        file.write_text(text, encoding="utf-8")


def add_variant(examples, name, text):
    """A program that differs from an example in a line."""
    (examples / (name + ".cpp")).write_text(text, encoding="utf-8")
    with open(examples / "CMakeLists.txt", "a", encoding="utf-8") as file:
        file.write("gnomon_example(%s Gnomon::shadows Gnomon::window PkgConfig::EPOXY)\n" % name)


def add_shared_layers(examples):
    """split_screen_shared: bodies cast in their own players' halves, too."""
    text = (examples / "split_screen.cpp").read_text(encoding="utf-8")
    if text.count(".cast_layers = layer_of(player),") != 1:
        raise Wrong("split_screen.cpp sets its views' layers otherwise")
    add_variant(examples, "split_screen_shared", text.replace(".cast_layers = layer_of(player),", ""))


def add_late_start(examples):
    """streaming_late: it begins where `streaming` is in its last frame, with all that is near there and nothing else."""
    text = (examples / "streaming.cpp").read_text(encoding="utf-8")
    late, count = re.subn(r"(way_m = kSpeed_m_s) \* (window\.value\(\)->time_s\(\))",
                          r"\1 * (\2 + %d / 60.0)" % (FRAMES["streaming"] - 1), text)
    if count != 1:
        raise Wrong("streaming.cpp sets its way %d times" % count)
    add_variant(examples, "streaming_late", late)


def draw(program, picture, *flags, wrapper=(), frames=None):
    """Runs an example. Returns its picture and what it printed."""
    frames = frames or FRAMES.get(program.name, 2)
    done = run(*wrapper, program, *SIZE, "--frames", frames, "--screenshot", picture, *flags)
    return Picture(picture), done.stdout


def darker(picture, lit):
    """Pixels that are darker than in the picture without shadows. None may be brighter."""
    found = set()
    for i in range(WIDTH * HEIGHT):
        change = max((lit.rgba[4 * i + c] - picture.rgba[4 * i + c] for c in range(3)), key=abs)
        if change > LEVELS:
            found.add(i)
        elif change < -LEVELS:
            raise Wrong("pixel %d, %d is brighter than without shadows" % (i % WIDTH, i // WIDTH))
    return found


def check_picture(name, picture, lit):
    (least, most), in_shadow, in_light = PICTURES[name]
    if (picture.width, picture.height) != (WIDTH, HEIGHT):
        raise Wrong("%s: the picture has another size" % name)
    pixels = darker(picture, lit)
    share = len(pixels) / (WIDTH * HEIGHT)
    if not least <= share <= most:
        raise Wrong("%s: %.1f %% of the picture is in shadow" % (name, 100 * share))
    for place, expected in ((in_shadow, True), (in_light, False)):
        if place and (int(place[1] * HEIGHT) * WIDTH + int(place[0] * WIDTH) in pixels) != expected:
            raise Wrong("%s: no %s at %.2f, %.2f" % (name, "shadow" if expected else "light", *place))
    return share


def check_halves(pixels, other_half):
    """The two players' masks differ: few of the pixels in shadow are the same in both halves."""
    half = WIDTH // 2
    left = {(i % WIDTH, i // WIDTH) for i in pixels if i % WIDTH < half}
    right = {(i % WIDTH - other_half, i // WIDTH) for i in pixels if other_half <= i % WIDTH < other_half + half}
    same = len(left & right) / max(len(left | right), 1)
    if not left or not right or same > 0.6:
        raise Wrong("split_screen: %d and %d pixels in shadow, %.0f %% the same" % (len(left), len(right), 100 * same))
    return same


def check_layers(picture, shared):
    """A shadow of the player's own body is missing that is there where views share all layers."""
    count = sum(max(picture.rgba[i + c] - shared.rgba[i + c] for c in range(3)) > LEVELS
                for i in range(0, 4 * WIDTH * HEIGHT, 4))
    if count < 100:
        raise Wrong("split_screen: %d pixels lie in the shadow of their player's own body" % count)
    return count


def check_streaming(text):
    """Cells come at once first, then come and go; what is drawn again then is less."""
    lines = [list(map(int, numbers)) for numbers in re.findall(
        r"frame (\d+): (\d+) meshes \((\d+) came, (\d+) went\), \d+ lights, (\d+) maps drawn", text)]
    if not lines or lines[0][1:4] != [49, 49, 0] or lines[0][4] == 0:
        raise Wrong("streaming: the first frame is not %s" % (lines[:1] or text))
    later = lines[1:]
    if not any(line[3] for line in later) or not any(line[2] for line in later) or lines[-1][1] != 49:
        raise Wrong("streaming: no cells came and went:\n%s" % text)


def check_late_start(streamed, late):
    """What came in time, and what went, leaves the picture of a program that begins there."""
    pixels = range(0, 4 * WIDTH * HEIGHT, 4)
    different = sum(max(abs(streamed.rgba[i + c] - late.rgba[i + c]) for c in range(3)) > LEVELS for i in pixels)
    if different > MOST_DIFFERENT * len(pixels):
        raise Wrong("streaming: %d pixels differ from those of a program that begins there" % different)
    return different


def reaches(place, lamp):
    """Whether a segment reaches a lamp past the pillars of visibility_queries.cpp."""
    for i in range(9):
        low = (-6.0 + 1.5 * i, 0.0, (-2.2, 0.4, 1.8)[i % 3])
        enters, leaves = 0.0, 1.0
        for axis, size in enumerate((0.6, 3.0, 0.6)):
            way = lamp[axis] - place[axis]
            ends = ((low[axis] - place[axis]), (low[axis] + size - place[axis]))
            if way == 0.0:
                enters, leaves = (enters, leaves) if ends[0] < 0.0 < ends[1] else (1.0, 0.0)
                continue
            enters, leaves = max(enters, min(ends) / way if way > 0 else max(ends) / way), \
                min(leaves, max(ends) / way if way > 0 else min(ends) / way)
        if enters < leaves:
            return False
    return True


def check_queries(text):
    """Rows that rays of our own are sure of: all segments from around a place to a lamp are free, or none is."""
    lamps = ((-5.0, 2.5, -3.0), (0.5, 2.5, 3.5), (6.0, 2.5, -1.5))
    rows = [list(map(float, line.split())) for line in text.splitlines()[1:]]
    if len(rows) != 13 or any(len(row) != 5 for row in rows):
        raise Wrong("visibility_queries: unexpected text\n%s" % text)
    sure = [0, 0]
    for row in rows:
        for lamp, share in zip(lamps, row[2:]):
            around = [reaches((row[0] + dx, 1.2 + dy, row[1] + dz), lamp)
                      for dx in (-0.3, 0.0, 0.3) for dy in (-0.3, 0.0, 0.3) for dz in (-0.3, 0.0, 0.3)]
            if all(around) or not any(around):
                sure[around[0]] += 1
                if share != float(around[0]):
                    raise Wrong("visibility_queries: %.3f at %.2f, %.2f of a lamp that is %s" %
                                (share, row[0], row[1], "free" if around[0] else "hidden"))
    if min(sure) < 3:
        raise Wrong("visibility_queries: %d places in the dark, %d in the light" % tuple(sure))
    return sure


def must_fail(check, *arguments):
    try:
        check(*arguments)
    except Wrong:
        return
    raise Wrong("%s finds nothing wrong in its control" % check.__name__)


def check_failures(program):
    """A wrong flag, or a place where nothing can be written, is one line and a code."""
    for flags in (["--bogus"], ["--headless", *SIZE, "--screenshot", "/nowhere/at/all.png"]):
        done = run(program, *flags, code=2)
        if done.stderr.strip().count("\n") != 0 or not done.stderr.strip():
            raise Wrong("%s %s prints\n%s" % (program.name, flags, done.stderr))


def check_size(source, prefix, compiler):
    """The examples are as short, and include as little, as docs/reference/examples.md states."""
    lines = (source / "examples/first_shadow.cpp").read_text(encoding="utf-8").splitlines()
    text = (source / "examples/own_ecs_forward.cpp").read_text(encoding="utf-8")
    speaking = [line for line in text.splitlines() if re.search(r"gnomon|shadows\b|mask\b|caster", line, re.IGNORECASE)]
    include = prefix / "include"
    rules = run(compiler, "-MM", "-std=c++20", "-I", include, "-I", include / "gnomon", source / "examples/own_ecs_forward.cpp")
    headers = rules.stdout.count(str(include))
    if len(lines) > MOST_LINES or len(speaking) > MOST_LINES or not 2 <= headers <= MOST_HEADERS:
        raise Wrong("%d lines, %d lines that speak of Gnomon, %d headers" % (len(lines), len(speaking), headers))
    print("first_shadow has %d lines, own_ecs_forward %d that speak of Gnomon and %d headers" %
          (len(lines), len(speaking), headers))


def main(build_folder, source, work, compiler, launcher=""):
    source, work = Path(source), Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    prefix = work / "moved"
    run("cmake", "--install", build_folder, "--prefix", work / "first")
    (work / "first").rename(prefix)
    shutil.copytree(source / "examples", work / "examples")
    add_late_start(work / "examples")
    add_shared_layers(work / "examples")
    copy_without_shadows(source / "examples", work / "unshadowed")
    for name in ("examples", "unshadowed"):
        build(work / name, work / (name + "_build"), prefix, compiler, launcher)
    check_size(source, prefix, compiler)
    programs = work / "examples_build"
    if not (programs / "sdl_window").exists():
        print("sdl_window: skipped, SDL 2 is not installed")
        del PICTURES["sdl_window"]

    drawn = {}
    for name in PICTURES:
        picture, text = draw(programs / name, work / (name + ".png"), "--headless")
        lit, _ = draw(work / "unshadowed_build" / name, work / (name + "_unshadowed.png"), "--headless")
        share = check_picture(name, picture, lit)
        must_fail(check_picture, name, lit, lit)
        print("%s: %.1f %% of the picture in shadow" % (name, 100 * share))
        check_failures(programs / name)
        drawn[name] = (picture, lit, text)
    picture, lit, _ = drawn["split_screen"]
    pixels = darker(picture, lit)
    print("split_screen: %.0f %% of the shadows are the same in both halves" % (100 * check_halves(pixels, WIDTH // 2)))
    must_fail(check_halves, pixels, 0)
    shared, _ = draw(programs / "split_screen_shared", work / "split_screen_shared.png", "--headless")
    print("split_screen: %d lit pixels lie in the shadow of their player's own body" % check_layers(picture, shared))
    must_fail(check_layers, picture, picture)
    check_streaming(drawn["streaming"][2])
    must_fail(check_streaming, drawn["streaming"][2].splitlines()[0])
    again, text = draw(programs / "streaming", work / "again.png", "--headless")
    if again.rgba != drawn["streaming"][0].rgba or text != drawn["streaming"][2]:
        raise Wrong("streaming: another run draws or prints something else")
    late, _ = draw(programs / "streaming_late", work / "late.png", "--headless", frames=1)
    print("streaming: %d pixels differ where another begins" % check_late_start(again, late))
    must_fail(check_late_start, draw(programs / "streaming", work / "early.png", "--headless", frames=1)[0], late)

    plan, text = draw(programs / "visibility_queries", work / "visibility_queries.png", "--headless")
    _, free = draw(work / "unshadowed_build/visibility_queries", work / "visibility_queries_unshadowed.png", "--headless")
    print("visibility_queries: of the places that are certain %d are dark, %d lit" % tuple(check_queries(text)))
    must_fail(check_queries, free)
    if plan.shade_count() < 4:
        raise Wrong("visibility_queries: a plan of one colour")
    check_failures(programs / "visibility_queries")

    if shutil.which("xvfb-run") is None:
        print("windows: skipped, there is no xvfb-run")
        return
    for name in [name for name in ("first_shadow", "sdl_window") if name in PICTURES]:
        shown, _ = draw(programs / name, work / (name + "_window.png"), wrapper=("xvfb-run", "-a"))
        if shown.rgba != drawn[name][0].rgba:
            raise Wrong("%s: another picture in a window" % name)
        print("%s: the same picture in a window" % name)


if __name__ == "__main__":
    sys.path.insert(0, os.path.join(sys.argv[2], "tests", "e2e"))
    from game import Picture
    try:
        main(*sys.argv[1:])
    except Wrong as wrong:
        sys.exit(str(wrong))
