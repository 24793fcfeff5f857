#!/usr/bin/env python3
"""Checks that the version is the same everywhere and has an entry in CHANGELOG.md, and that THIRD_PARTY.md names every part.

usage: check_release.py [ROOT]           prints one line per fault; exit status 1 if there is any
       check_release.py --release [ROOT]  the same, and nothing may stand under "Unreleased" any more
       check_release.py --self-test       spoils each file in turn, and expects it to be found
"""
import json
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADING = re.compile(r"^## (?P<name>.+)$", re.MULTILINE)
NUMBER = re.compile(r"\d+\.\d+\.\d+")


def read(root, name):
    file = root / name
    return file.read_text(encoding="utf-8") if file.is_file() else ""


def versions(root):
    """The version as each file has it; empty: none."""
    cmake = re.search(r"^project\(\w+ VERSION ([\d.]+)", read(root, "CMakeLists.txt"), re.MULTILINE)
    header = re.search(r"kVersion\{(\d+), (\d+), (\d+)\}", read(root, "include/gnomon/version.h"))
    return {"CMakeLists.txt": cmake[1] if cmake else "", "include/gnomon/version.h": ".".join(header.groups()) if header else "",
            "vcpkg.json": json.loads(read(root, "vcpkg.json") or "{}").get("version-semver", "")}


def entries(root):
    """Sections of the changelog by name, in their order: the text below each."""
    text = read(root, "CHANGELOG.md")
    heads = list(HEADING.finditer(text))
    ends = [head.start() for head in heads[1:]] + [len(text)]
    return {head["name"].split(" ")[0]: text[head.end():end].strip() for head, end in zip(heads, ends)}


def wrong_version(root, release):
    found, known, log = [], versions(root), entries(root)
    version = known["CMakeLists.txt"]
    found += ["%s has the version '%s', CMakeLists.txt '%s'" % (name, other, version)
              for name, other in known.items() if other != version]
    if not NUMBER.fullmatch(version):
        found.append("CMakeLists.txt has no version of three numbers")
    if not re.search(r"^- ", log.get(version, ""), re.MULTILINE):
        found.append("CHANGELOG.md has no entry for %s" % version)
    numbered = [name for name in log if NUMBER.fullmatch(name)]
    if numbered != sorted(numbered, key=lambda name: [int(n) for n in name.split(".")], reverse=True) or (
            numbered and numbered[0] != version):
        found.append("the newest version of CHANGELOG.md is not %s, or its order is wrong" % version)
    if release and re.search(r"^- ", log.get("Unreleased", ""), re.MULTILINE):
        found.append("CHANGELOG.md has changes under 'Unreleased': give them a number")
    return found


def missing_parts(root):
    """Packages that THIRD_PARTY.md does not name, by one of their names."""
    known = set(re.findall(r"`([^`]+)`", read(root, "THIRD_PARTY.md")))
    lines = [line.split("#")[0].strip() for line in read(root, "packages.txt").splitlines()]
    manifest = json.loads(read(root, "vcpkg.json") or "{}")
    parts = manifest.get("dependencies", []) + [part for feature in manifest.get("features", {}).values()
                                                for part in feature["dependencies"]]
    return ["THIRD_PARTY.md does not name %s" % name for name in [line for line in lines if line] + sorted(set(parts))
            if not known & set(name.split("|"))]


def faults(root, release=False):
    return wrong_version(root, release) + missing_parts(root)


FILES = {
    "CMakeLists.txt": "project(X VERSION 1.2.0 LANGUAGES CXX)\n",
    "include/gnomon/version.h": "kVersion{1, 2, 0};\n",
    "vcpkg.json": '{"version-semver": "1.2.0", "dependencies": ["egl"], "features": {"a": {"dependencies": ["imgui"]}}}',
    "CHANGELOG.md": "# C\n\n## Unreleased\n\n## 1.2.0 (2026-01-01)\n\n- a\n\n## 1.1.0\n\n- b\n",
    "THIRD_PARTY.md": "`egl` `imgui` `b`\n",
    "packages.txt": "# all\na|b   # for this\n",
}
SPOILT = (("CMakeLists.txt", "1.2.0", "1.3.0"), ("include/gnomon/version.h", "2", "3"), ("vcpkg.json", "1.2.0", "1.2.1"),
          ("CHANGELOG.md", "## 1.2.0", "## 1.2.9"), ("CHANGELOG.md", "- a", "a"), ("CHANGELOG.md", "1.1.0", "1.4.0"),
          ("THIRD_PARTY.md", "`imgui`", ""), ("packages.txt", "a|b", "a|c"), ("CHANGELOG.md", "Unreleased\n", "Unreleased\n\n- c\n"))


def self_test():
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "include/gnomon").mkdir(parents=True)
        for name, before, after in (("CMakeLists.txt", "", ""), *SPOILT):
            for file, text in FILES.items():
                (root / file).write_text(text.replace(before, after) if file == name and before else text, encoding="utf-8")
            if bool(faults(root, True)) != bool(before):
                missed.append("%s: '%s' gives %s" % (name, after, faults(root, True)))
    print(*missed, "%d spoilt, %d not found" % (len(SPOILT), len(missed)), sep="\n")
    return 1 if missed else 0


def main(arguments):
    if "--self-test" in arguments:
        return self_test()
    places = [argument for argument in arguments if not argument.startswith("--")]
    found = faults(Path(places[0]) if places else ROOT, "--release" in arguments)
    print(*found, "version %s: %d faults" % (versions(Path(places[0]) if places else ROOT)["CMakeLists.txt"], len(found)), sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
