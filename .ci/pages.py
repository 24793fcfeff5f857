"""What every check of the pages shares: which files are pages, and their headings, links, code and commands."""
import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
TOP = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "THIRD_PARTY.md", "bench/README.md")
FENCE = re.compile(r"^(?P<indent> *)(?P<mark>`{3,}|~{3,})(?P<language>[\w+-]*)[^\n]*\n(?P<text>.*?)^(?P=indent)(?P=mark) *$",
                   re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(?P<picture>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^()\s]*(?:\([^()]*\)[^()\s]*)*)(?: \"[^\"]*\")?\)")
TAG = re.compile(r"<(?:img|a|source)\b[^>]*?\b(?P<kind>src|href|srcset)=\"(?P<target>[^\"]+)\"")
NAME = re.compile(r"<a (?:id|name)=\"([^\"]+)\"")


class Fence(NamedTuple):
    """A block of code. mark: the HTML comment in the line above it, without its brackets; empty if there is none."""
    line: int
    language: str
    text: str
    mark: str


def pages(root=ROOT):
    """All pages, sorted: those of TOP that exist, and everything below docs/."""
    return [root / name for name in TOP if (root / name).is_file()] + sorted((root / "docs").rglob("*.md"))


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def fences(text):
    """Yields the blocks of code of a page."""
    for match in FENCE.finditer(text):
        above = text[:match.start()].rstrip("\n").rsplit("\n", 1)[-1]
        mark = re.fullmatch(r" *<!-- (.*?) -->", above)
        body = "".join(line[len(match["indent"]):] if line.startswith(match["indent"]) else line
                       for line in match["text"].splitlines(keepends=True))
        yield Fence(line_of(text, match.start()), match["language"], body, mark[1] if mark else "")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def without_code(text):
    """The page with blocks of code and code in backticks blanked, so that positions stay."""
    text = FENCE.sub(blank, text)
    return re.sub(r"(`+)(?!`)(?:(?!\n\n).)*?(?<!`)\1(?!`)", blank, text, flags=re.DOTALL)


def inline_code(text):
    """Yields (line, code) of each code in backticks outside blocks."""
    text = FENCE.sub(blank, text)
    for match in re.finditer(r"(?<!`)`([^`]+)`(?!`)", text):
        yield line_of(text, match.start()), " ".join(match[1].split())


def slug(heading):
    """The anchor that GitHub gives a heading."""
    heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip().rstrip("#").strip())
    return re.sub(r"[^\w\- ]", "", heading.replace("`", "").lower()).replace(" ", "-")


def anchors(text):
    """All anchors of a page; a repeated heading gets -1, -2."""
    found, counts = set(NAME.findall(text)), {}
    for match in re.finditer(r"^#{1,6} +(.+)$", FENCE.sub(blank, text), re.MULTILINE):
        name = slug(match[1])
        number = counts.get(name, 0)
        counts[name] = number + 1
        found.add(name if number == 0 else "%s-%d" % (name, number))
    return found


def links(text):
    """Yields (line, target, is a picture) of each link and picture of a page."""
    plain = without_code(text)
    # Links may have code as their text, which is blanked in `plain`: targets are read from there, since none has backticks.
    for match in LINK.finditer(plain):
        yield line_of(text, match.start()), match["target"], bool(match["picture"])
        for inner in LINK.finditer(match["text"]):
            yield line_of(text, match.start()), inner["target"], bool(inner["picture"])
    for match in TAG.finditer(plain):
        yield line_of(text, match.start()), match["target"].split()[0], match["kind"] != "href"


COMMAND = re.compile(r"^(?:\$ )?(?P<env>(?:[A-Z_]+=\S* )*)(?P<program>\./gnomon|(?:\S*/)?gnomon_(?:game|bench))(?= |$)")


def commands(text):
    """Yields (line, command) of each line of Gnomon's programs in blocks of commands and in inline code."""
    for fence in fences(text):
        if fence.language not in ("", "sh", "bash", "shell", "console"):
            continue
        joined = re.sub(r"\\\n\s*", lambda m: " ", fence.text)
        for offset, row in enumerate(joined.splitlines()):
            if COMMAND.match(row.strip()):
                yield fence.line + 1 + offset, row.strip()
    for line, code in inline_code(text):
        if COMMAND.match(code):
            yield line, code
