#!/usr/bin/env python3
"""Counts comparisons with a light kind, a filter or a filter's storage outside their tables: code reads facts of the row.

usage: check_tables.py [ROOT]       prints each comparison; exit status 1 if there are more than LIMIT
       check_tables.py --self-test  counts comparisons in small trees, with and without one of each form
"""
import re
import sys
import tempfile
from pathlib import Path

LIMIT = 9
PARTS = ("systems", "sample_game", "bench")
COUNTED = {".h", ".cpp", ".inc", ".cmake", ".txt"}
# The tables and the files with their rows.
STORAGE_TABLE = "systems/shadow/request/filter_table.cpp"
TABLES = {"systems/extract/light_facts.h", "systems/shadow/request/light_kinds.cpp", "systems/shadow/request/light_kinds.h",
          "systems/shadow/request/filter_table.h", STORAGE_TABLE}
# Names that stand in no row: a light's setting before a filter is chosen, and the number of rows.
NAME = r"(?:\w+::)*(?:LightKind|ShadowFilter)::(?!automatic\b|count\b)\w+"
COMPARISON = re.compile(rf"[=!]=\s*{NAME}|{NAME}\s*[=!]=|case\s+{NAME}|storage\s*[=!]=\s*(?:\w+::)+\w+|FilterStorage::\w+")
STORAGE_ROW = re.compile(r"constexpr FilterStorage (k\w+)")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def comparisons(root):
    """Sorted lines `path:line: text`, one per comparison."""
    table = root / STORAGE_TABLE
    names = STORAGE_ROW.findall(table.read_text(encoding="utf-8")) if table.is_file() else []
    patterns = [COMPARISON] + [re.compile(rf"\b{name}\b") for name in names]
    found = []
    for file in (p for part in PARTS for p in (root / part).rglob("*") if p.suffix in COUNTED):
        path = file.relative_to(root).as_posix()
        if path in TABLES:
            continue
        text = COMMENT.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), file.read_text(encoding="utf-8"))
        for match in (m for pattern in patterns for m in pattern.finditer(text)):
            line = text.count("\n", 0, match.start())
            found.append((path, line + 1, text.splitlines()[line].strip()))
    return [f"{path}:{line}: {text}" for path, line, text in sorted(found)]


# Contents of a file, and the number of comparisons in it.
SAMPLES = (
    ("if (light_facts(light.kind).parallel) f();\n", 0),
    ("item.kind = LightKind::spot;\nif (filter == ShadowFilter::automatic) f(ShadowFilter::hard);\n", 0),
    ("// kind == LightKind::spot, kTriangleIds\n/* row.storage\n == FilterStorage::bounds */\n", 0),
    ("history.storage == storage;\n", 0),
    ("if (a.kind == LightKind::spot || LightKind::point != kind) f();\n", 2),
    ("if (a.kind ==\n    gnomon::LightKind::spot) f();\n", 1),
    ("switch (kind) { case LightKind::spot: case gnomon::LightKind::point: f(); }\n", 2),
    ("return filter != ShadowFilter::hard;\n", 1),
    ("row.storage == FilterStorage::bounds;\nrow.storage != shadow::Storage::bounds;\n", 2),
    ('if(row MATCHES "kTriangleIds")\nendif()\n', 1),
)


def check(root):
    """Lines to print, and the exit status."""
    missing = [f"{name}: no such table" for name in sorted(TABLES) if not (root / name).is_file()]
    found = comparisons(root)
    lines = [*missing, *found, f"{len(found)} comparisons, {LIMIT} are the limit"]
    return lines, 1 if missing or len(found) > LIMIT else 0


def judged(contents):
    """comparisons() and the status of a tree with these files, {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in contents.items():
            (Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            (Path(folder) / name).write_text(text, encoding="utf-8")
        return comparisons(Path(folder)), check(Path(folder))[1]


def self_test():
    failures = []
    tables = {**dict.fromkeys(TABLES, "if (kind == LightKind::spot) f();\n"), STORAGE_TABLE: "constexpr FilterStorage kTriangleIds{};\n"}
    for part in PARTS:
        for text, want in SAMPLES:
            found, _ = judged({**tables, f"{part}/own.cpp": text})
            if len(found) != want:
                failures.append(f"expected {want} in {part} of {text!r}, found {found}")
    one = "return filter != ShadowFilter::hard;\n"
    whole = ((tables, 0), ({}, 1), ({**tables, "bench/own.cpp": one * LIMIT}, 0), ({**tables, "bench/own.cpp": one * (LIMIT + 1)}, 1))
    failures += [f"expected status {want} of {list(contents)}" for contents, want in whole if judged(contents)[1] != want]
    print(*failures, f"{len(PARTS) * len(SAMPLES) + len(whole)} trees checked, {len(failures)} judged wrongly", sep="\n")
    return 1 if failures else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    lines, status = check(Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent)
    print(*lines, sep="\n")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
