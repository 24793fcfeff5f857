#!/usr/bin/env python3
"""Takes the tutorial's program out of its page, builds it in an empty folder against an installed copy, and compares its picture.

usage: tutorial.py BUILD SOURCE WORK CXX [LAUNCHER]
The page is docs/tutorial/first_shadow.md, with blocks of code below lines `<!-- file: NAME -->`. Its picture must be that of
examples/first_shadow, to the bit. A page whose program has another light, and a page without a file, must fail.
"""
import os
import re
import shutil
import sys
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
for folder in (HERE / "examples", HERE.parent / "e2e", HERE.parents[1] / ".ci"):
    sys.path.insert(0, str(folder))
import pages  # noqa: E402
from game import Picture  # noqa: E402
from run_examples import Wrong, build, run  # noqa: E402

FILE = re.compile(r"file: (?P<name>[\w./-]+)")
PAGE, EXAMPLE, TARGET = "docs/tutorial/first_shadow.md", "examples/first_shadow.cpp", "first_shadow"
SIZE = ["--size", "320x180"]


def files_of(text):
    """Names and text of the files that a page has."""
    found = {}
    for fence in pages.fences(text):
        mark = FILE.fullmatch(fence.mark)
        if mark:
            found[mark["name"]] = found.get(mark["name"], "") + fence.text
    return found


def picture_of(text, work, prefix, compiler, launcher):
    """Builds what a page has, in an empty folder, and runs its one program."""
    files = files_of(text)
    if set(files) != {"main.cpp", "CMakeLists.txt"}:
        raise Wrong("the page has the files %s" % sorted(files))
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    for name, content in files.items():
        (work / name).write_text(content, encoding="utf-8")
    build(work, work / "build", prefix, compiler, launcher)
    names = re.findall(r"add_executable\((\w+)", files["CMakeLists.txt"])
    if len(names) != 1:
        raise Wrong("CMakeLists.txt of the page makes %d programs" % len(names))
    return draw(work / "build" / names[0], work / "picture.png")


def draw(program, picture):
    run(program, *SIZE, "--headless", "--frames", "2", "--screenshot", picture)
    return Picture(picture)


def check(picture, wanted):
    if (picture.width, picture.height) != (wanted.width, wanted.height) or picture.rgba != wanted.rgba:
        raise Wrong("the picture is not that of %s" % EXAMPLE)


def must_fail(what, function, *arguments):
    try:
        function(*arguments)
    except Wrong:
        return
    raise Wrong("%s is not found" % what)


def spoilt(text):
    """The page with its sun in another direction."""
    changed, count = re.subn(r"-3(?:\.0f?)?, -5(?:\.0f?)?, -4(?:\.0f?)?", "-3.0, -5.0, -1.0", text)
    if count == 0:
        raise Wrong("the page's sun does not shine along -3, -5, -4, as that of %s" % EXAMPLE)
    return changed


def main(build_folder, source, work, compiler, launcher=""):
    source, work = Path(source), Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    prefix = work / "installed"
    run("cmake", "--install", build_folder, "--prefix", prefix)
    # The example itself, built by the project's own build.
    wanted = draw(Path(build_folder) / "bin" / TARGET, work / "wanted.png")
    text = (source / PAGE).read_text(encoding="utf-8")
    check(picture_of(text, work / "tutorial", prefix, compiler, launcher), wanted)
    print("%s: its program draws the picture of %s" % (PAGE, EXAMPLE))
    must_fail("a page with another light", lambda: check(
        picture_of(spoilt(text), work / "spoilt", prefix, compiler, launcher), wanted))
    must_fail("a page without a file", picture_of, text.replace("file: CMakeLists.txt", "x"), work / "less", prefix, compiler, "")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except Wrong as wrong:
        sys.exit(str(wrong))
