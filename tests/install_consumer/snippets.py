#!/usr/bin/env python3
"""Checks that the code in docs/*.md is the code that the stranger's project builds.

A block below a line `<!-- FILE: NAME -->` must equal what stands in FILE between two lines `// [NAME]`.

usage: snippets.py [--write] ROOT     --write replaces the blocks by the files' text
       snippets.py --self-test ROOT   changes one character of each block in turn and expects it to be found
"""
import re
import sys
from pathlib import Path

BLOCK = re.compile(r"(<!-- (?P<file>\S+): (?P<name>[^\n]+?) -->\n```(?:cpp|hlsl)\n)(?P<code>.*?)(```\n)", re.DOTALL)


def region(text, name):
    """The lines between the two marks, without their common indentation; None if there are not exactly two."""
    lines = text.splitlines()
    marks = [i for i, line in enumerate(lines) if line.strip() == f"// [{name}]"]
    if len(marks) != 2:
        return None
    inside = lines[marks[0] + 1:marks[1]]
    indent = min((len(line) - len(line.lstrip()) for line in inside if line.strip()), default=0)
    return "".join(line[indent:] + "\n" for line in inside)


def wanted(root, match):
    file = root / match["file"]
    return region(file.read_text(encoding="utf-8"), match["name"]) if file.is_file() else None


def wrong_blocks(root, text):
    return [f"{m['file']}: {m['name']}" for m in BLOCK.finditer(text) if m["code"] != wanted(root, m)]


def self_test(root, guides):
    missed = count = 0
    for text in guides.values():
        for match in BLOCK.finditer(text):
            at = match.start("code")
            missed += not wrong_blocks(root, text[:at] + "~" + text[at:])
            count += 1
    print(f"{count} blocks spoilt, {missed} not found")
    return 1 if missed or not count else 0


def main(arguments):
    root = Path(arguments[-1])
    guides = {p: p.read_text(encoding="utf-8") for p in sorted((root / "docs").glob("*.md"))}
    if "--self-test" in arguments:
        return self_test(root, guides)
    if "--write" in arguments:
        for path, text in guides.items():
            path.write_text(BLOCK.sub(lambda m: m[1] + (wanted(root, m) or m["code"]) + m[5], text), encoding="utf-8")
        return 0
    wrong = [f"{p.name}: {block}" for p, text in guides.items() for block in wrong_blocks(root, text)]
    count = sum(len(BLOCK.findall(text)) for text in guides.values())
    print(*wrong, f"{count} blocks, {len(wrong)} differ from the code", sep="\n")
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
