#!/usr/bin/env python3
"""Checks that code in the pages is code that a test builds and runs.

- A block below a line `<!-- FILE: NAME -->` must equal what stands in FILE between two lines `// [NAME]`.
  Where NAME is `whole file`, it must equal all of FILE.
- A block below a line `<!-- file: NAME -->` is a whole file of the tutorial: tutorial.py builds and runs it. Its main.cpp must
  equal its example.
- Any other block of C++, GLSL or CMake must be cut from a file of examples/, tests/ or sample_game/ (shaders: of shaders/ as
  well). White space does not count; a line `...`, alone or as a comment, stands for lines that are left out.
Blocks that are none of these are listed in .ci/loose_code.txt, which may only shrink.

usage: snippets.py [--write] ROOT     --write replaces the marked blocks by the files' text
       snippets.py --self-test ROOT   changes one character of each block in turn and expects it to be found
"""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / ".ci"))
import pages  # noqa: E402

LOOSE = ".ci/loose_code.txt"
BLOCK = re.compile(r"(<!-- (?P<file>\S+): (?P<name>[^\n]+?) -->\n```(?:cpp|hlsl|glsl|cmake)\n)(?P<code>.*?)(```\n)", re.DOTALL)
OF_TUTORIAL = "file"
# The tutorial's files that stand elsewhere, too.
TUTORIAL = {"main.cpp": "examples/first_shadow.cpp"}
C_LIKE, SHADER, BUILD = {".cpp", ".h"}, {".glsl", ".vert", ".frag", ".geom", ".comp"}, {".txt", ".cmake"}
LANGUAGES = {"cpp": C_LIKE, "c++": C_LIKE, "glsl": SHADER | C_LIKE, "hlsl": SHADER | C_LIKE, "cmake": BUILD}
FOLDERS = ("examples", "tests", "sample_game")
LEFT_OUT = re.compile(r"^\s*(?://|#)?\s*(?:\.\.\.|…)\s*$", re.MULTILINE)


def region(text, name):
    """The lines between the two marks, without their common indentation; None if there are not exactly two."""
    lines = text.splitlines()
    marks = [i for i, line in enumerate(lines) if line.strip() == f"// [{name}]"]
    if len(marks) != 2:
        return None
    inside = lines[marks[0] + 1:marks[1]]
    indent = min((len(line) - len(line.lstrip()) for line in inside if line.strip()), default=0)
    return "".join(line[indent:] + "\n" for line in inside)


def is_checked(match):
    return match["file"] != OF_TUTORIAL or match["name"] in TUTORIAL


def wanted(root, match):
    name, whole = match["name"], match["name"] == "whole file"
    if match["file"] == OF_TUTORIAL:
        name, whole = TUTORIAL.get(name, ""), True
    file = root / (name if match["file"] == OF_TUTORIAL else match["file"])
    text = file.read_text(encoding="utf-8") if file.is_file() else None
    return text if whole or text is None else region(text, name)


def wrong_blocks(root, text):
    return [f"{m['file']}: {m['name']}" for m in BLOCK.finditer(text)
            if is_checked(m) and m["code"] != wanted(root, m)]


# --- blocks without a mark --------------------------------------------------------------------------------------------

class Sources:
    """Text of the programs that tests build, by the language of a block."""

    def __init__(self, root):
        self.root, self.texts = root, {}

    def of(self, language):
        ends = LANGUAGES[language]
        folders = FOLDERS + (("shaders",) if ends & SHADER else ())
        if language not in self.texts:
            files = [p for folder in folders for p in (self.root / folder).rglob("*") if p.suffix in ends]
            self.texts[language] = [" ".join(p.read_text(encoding="utf-8").split()) for p in files]
        return self.texts[language]


def is_cut(code, texts):
    """Whether all parts of a block stand in one of the texts, in their order."""
    parts = [" ".join(part.split()) for part in LEFT_OUT.split(code)]
    parts = [part for part in parts if part]

    def has_all(text):
        at = 0
        for part in parts:
            at = text.find(part, at)
            if at < 0:
                return False
            at += len(part)
        return True
    return bool(parts) and any(map(has_all, texts))


def loose_blocks(root, texts, sources):
    """Pairs of page and first line of blocks that are cut from nothing that runs."""
    found = []
    for page, text in texts.items():
        for fence in pages.fences(text):
            if fence.language not in LANGUAGES or re.match(r"\S+: ", fence.mark):
                continue
            if not is_cut(fence.text, sources.of(fence.language)):
                first = next((line.strip() for line in fence.text.splitlines() if line.strip()), "")
                found.append((page.relative_to(root), first))
    return found


def wrong_loose(found, listed):
    """What differs between loose blocks and the list, which must name each of them once and nothing else."""
    lines = ["%s: no program that runs has this code: %s" % (page, first) for page, first in found if first not in listed]
    firsts = [first for _, first in found]
    return lines + ["no longer loose, take it out of %s: %s" % (LOOSE, line) for line in listed if line not in firsts]


# --- all --------------------------------------------------------------------------------------------------------------

def self_test(root, guides):
    missed = count = 0
    for text in guides.values():
        for match in BLOCK.finditer(text):
            if not is_checked(match):
                continue
            at = match.start("code")
            missed += not wrong_blocks(root, text[:at] + "~" + text[at:])
            count += 1
    texts = ["int main() { f(1); g(2); h(3); }"]
    for code, expected in (("f(1);\n  g(2);\n", True), ("f(1);\n// ...\nh(3);\n", True), ("f(1);\n…\n h(3); }", True),
                           ("f(1);\nh(3);\n", False), ("h(3);\n...\nf(1);\n", False), ("f(2);\n", False), ("...\n", False)):
        missed += is_cut(code, texts) != expected
        count += 1
    missed += len(wrong_loose([("p", "a"), ("p", "b")], ["a", "c"])) != 2
    print(f"{count + 1} blocks spoilt, {missed} not found")
    return 1 if missed else 0


def main(arguments):
    root = Path(arguments[-1]).resolve()
    guides = {p: p.read_text(encoding="utf-8") for p in pages.pages(root)}
    if "--self-test" in arguments:
        return self_test(root, guides)
    if "--write" in arguments:
        for path, text in guides.items():
            path.write_text(BLOCK.sub(lambda m: m[1] + (wanted(root, m) or m["code"]) + m[5], text), encoding="utf-8")
        return 0
    wrong = [f"{p.relative_to(root)}: {block}" for p, text in guides.items() for block in wrong_blocks(root, text)]
    loose = loose_blocks(root, guides, Sources(root))
    listed = [line for line in (root / LOOSE).read_text(encoding="utf-8").splitlines() if line and not line.startswith("# ")]
    wrong += wrong_loose(loose, listed)
    count = sum(len(BLOCK.findall(text)) for text in guides.values())
    print(*wrong, f"{count} marked blocks, {len(loose)} loose ones, {len(wrong)} faults", sep="\n")
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
