#!/usr/bin/env python3
"""Checks all pages: links, anchors, pictures, commands and figures that stand in more than one place.

usage: check_pages.py [--bin FOLDER] [ROOT]  prints one line per fault; exit status 1 if there is any
       check_pages.py --self-test            spoils each thing once in a small tree, and expects it to be found
FOLDER has gnomon_game and gnomon_bench: with it, every flag of a command must be one that --help names, and --list every key.

A figure that pages repeat is written <!-- figure: NAME -->4.8 %<!-- /figure -->: all of one name must be the same text.
Each limit of docs/reference/limits.md has a test, which docs/contributors/reliability.md names.
Pages about a file of JSON name it by <!-- json: NAME --> ... <!-- /json -->; test_pages.py compares their keys with a file.
"""
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import pages  # noqa: E402  (it lies beside this file)

FIGURE = re.compile(r"<!-- figure: (?P<name>[a-z][\w.-]*) -->(?P<text>.*?)<!-- /figure -->", re.DOTALL)
FIGURE_MARK = re.compile(r"<!-- (?:figure: [a-z][^>]*|/figure) -->")
FLAG = re.compile(r"--[a-z][\w-]*")
# Pages that no page has to reach: they stand in the root, where their names are what finds them.
START = "README.md"
MOST_CLICKS = 2


# --- links ------------------------------------------------------------------------------------------------------------

def target_of(page, target):
    """Path and anchor of a link; None for one that leaves the tree."""
    if re.match(r"[a-z][a-z0-9+.-]*:", target):
        return None
    path, _, anchor = target.partition("#")
    return (page.parent / path).resolve() if path else page.resolve(), anchor


def wrong_links(root, texts):
    found, known = [], {page.resolve(): pages.anchors(text) for page, text in texts.items()}
    for page, text in texts.items():
        for line, target, is_picture in pages.links(text):
            place = target_of(page, target)
            if place is None:
                continue
            path, anchor = place
            name = "%s:%d" % (page.relative_to(root), line)
            if not path.exists():
                found.append("%s: %s '%s' does not exist" % (name, "picture" if is_picture else "link", target))
            elif anchor and path in known and anchor not in known[path]:
                found.append("%s: '%s' has no heading '#%s'" % (name, path.relative_to(root.resolve()), anchor))
    return found


def unseen_pictures(root, texts):
    """Pictures below docs/ that no page shows."""
    shown = {target_of(page, target)[0] for page, text in texts.items() for _, target, _ in pages.links(text)
             if target_of(page, target)}
    return ["%s: no page shows it" % picture.relative_to(root) for picture in sorted((root / "docs").rglob("*"))
            if picture.suffix in (".png", ".jpg", ".svg") and picture.resolve() not in shown]


def far_pages(root, texts, most=MOST_CLICKS):
    """Pages below docs/ that are more than `most` clicks away from the README."""
    by_path = {page.resolve(): page for page in texts}
    reached, edge = {root.resolve() / START}, {root.resolve() / START}
    for _ in range(most):
        places = [target_of(by_path[path], target) for path in edge if path in by_path
                  for _, target, _ in pages.links(texts[by_path[path]])]
        edge = {place[0] for place in places if place} - reached
        reached |= edge
    return ["%s: more than %d clicks from %s" % (page.relative_to(root), most, START)
            for path, page in by_path.items() if path not in reached and "docs" in page.relative_to(root).parts[:1]]


MENTION = re.compile(r"(?<![\w/])docs/[\w./-]+\.(?:md|txt|png|svg)")
SOURCES = ("include", "engine", "systems", "window", "shaders", "sample_game", "examples", "bench", "cmake", "tests", ".ci")
SOURCE_ENDS = {".h", ".cpp", ".inc", ".glsl", ".vert", ".frag", ".geom", ".comp", ".cmake", ".txt", ".py", ".sh", ".css", ".html"}
MADE_UP = {".ci/check_pages.py", ".ci/generate_pages.py"}  # their self-tests have pages of their own


def wrong_mentions(root):
    """Pages that comments of the code name, and that are not there."""
    found = []
    for file in sorted(p for folder in SOURCES for p in (root / folder).rglob("*") if p.suffix in SOURCE_ENDS and p.is_file()):
        name = file.relative_to(root).as_posix()
        if name in MADE_UP:
            continue
        text = file.read_text(encoding="utf-8", errors="replace")
        for match in MENTION.finditer(text):
            if not (root / match[0]).exists():
                others = [p.relative_to(root).as_posix() for p in (root / "docs").rglob(match[0].rsplit("/", 1)[-1])]
                found.append("%s:%d: %s does not exist%s" % (name, pages.line_of(text, match.start()), match[0],
                                                            "; %s does" % others[0] if len(others) == 1 else ""))
    return found


# --- figures ----------------------------------------------------------------------------------------------------------

def wrong_figures(root, texts):
    found, places = [], {}
    for page, text in texts.items():
        text = pages.without_code(text)
        for match in FIGURE.finditer(text):
            name = "%s:%d" % (page.relative_to(root), pages.line_of(text, match.start()))
            places.setdefault(match["name"], []).append((name, " ".join(match["text"].split())))
        if FIGURE_MARK.search(FIGURE.sub("", text)):
            found.append("%s: a mark of a figure without its other half" % page.relative_to(root))
    for figure, uses in places.items():
        found += ["%s: figure %s is '%s', but '%s' at %s" % (place, figure, text, uses[0][1], uses[0][0])
                  for place, text in uses[1:] if text != uses[0][1]]
    return found


# --- limits -----------------------------------------------------------------------------------------------------------

LIMITS, THEIR_TESTS = "docs/reference/limits.md", "docs/contributors/reliability.md"
TESTED = ("Numbers", "Precision and determinism")  # sections of which each row has a test
GOOGLE_TEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)
PYTHON_TEST = re.compile(r"^(?:class (\w+)|    def (test_\w+))", re.MULTILINE)


def section_rows(text, section):
    """First and second cell of each row of a section's table."""
    match = re.search(r"^##+ %s\n(?P<text>.*?)(?=^##|\Z)" % re.escape(section), text, re.MULTILINE | re.DOTALL)
    rows = re.findall(r"^\| (.+?) \| (.+?) \|", match["text"], re.MULTILINE) if match else []
    return dict(rows[1:])


def test_names(root):
    """All tests of tests/, as Suite.Name, or as Class.test_name of Python."""
    found = set()
    for file in (root / "tests").rglob("*.cpp"):
        found |= {"%s.%s" % names for names in GOOGLE_TEST.findall(file.read_text(encoding="utf-8", errors="replace"))}
    for file in (root / "tests").rglob("test_*.py"):
        owner = ""
        for of_class, name in PYTHON_TEST.findall(file.read_text(encoding="utf-8")):
            owner = of_class or owner
            found |= {"%s.%s" % (owner, name)} if name else set()
    return found


def untested_limits(root):
    """Limits without a test, entries without a limit, and tests that do not exist."""
    limits, entries = ((root / page).read_text(encoding="utf-8") for page in (LIMITS, THEIR_TESTS))
    known, found = test_names(root), []
    for section in TESTED:
        stated, tested = section_rows(limits, section), section_rows(entries, section)
        found += [] if stated else ["%s: no table under '%s'" % (LIMITS, section)]
        found += ["%s: '%s' has no test in %s" % (LIMITS, row, THEIR_TESTS) for row in stated if row not in tested]
        found += ["%s: '%s' is no limit of %s" % (THEIR_TESTS, row, LIMITS) for row in tested if row not in stated]
        for row, cell in tested.items():
            names = re.findall(r"`([^`]+)`", cell)
            found += [] if names else ["%s: '%s' names no test" % (THEIR_TESTS, row)]
            found += ["%s: no test '%s'" % (THEIR_TESTS, name) for name in names if name not in known]
    return found


# --- commands ---------------------------------------------------------------------------------------------------------

class Programs:
    """What the programs know: commands, flags and keys. Reads each --help once."""

    def __init__(self, root, folder):
        self.script = root / "gnomon"
        self.folder, self.helps = folder, {}

    def run(self, *command):
        if command not in self.helps:
            done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  timeout=60, check=False)
            self.helps[command] = done.stdout if done.returncode == 0 else ""
        return self.helps[command]

    def own_commands(self):
        return set(re.findall(r"^  (\w+)", self.run(self.script, "help"), re.MULTILINE))

    def script_flags(self, command):
        """Flags that the script itself takes for a command."""
        text = self.run(self.script, "help")
        block = re.search(r"^  %s\b.*?(?=^  \w|\n\n)" % command, text, re.MULTILINE | re.DOTALL)
        return set(FLAG.findall(block[0])) if block else set()

    def flags(self, program, *sub):
        return set(FLAG.findall(self.run(self.folder / program, *sub, "--help")))

    def bench_commands(self):
        return set(re.findall(r"^  ([a-z]+)\b", self.run(self.folder / "gnomon_bench", "--help"), re.MULTILINE))

    def keys(self):
        return set(re.findall(r"^  (\w+) ", self.run(self.folder / "gnomon_game", "--list"), re.MULTILINE))


def is_placeholder(word):
    return not re.fullmatch(r"[a-z_]+", word)


def wrong_command(command, programs):
    """What is wrong with a command; empty: nothing that can be seen without running it."""
    match = pages.COMMAND.match(command)
    rest = re.sub(r"\s#.*", "", command[match.end():])
    try:
        words = shlex.split(rest.replace("…", "...").replace("'", "'"))
    except ValueError as error:
        return str(error)
    words = [word.strip("[]") for word in words]
    words = [part for word in words for part in (word.split("|") if FLAG.match(word) else [word])]
    for end in ("&&", "|", ";", ">"):
        words = words[:words.index(end)] if end in words else words
    program = match["program"].rsplit("/", 1)[-1]
    if program == "gnomon":
        if not words or is_placeholder(words[0]):
            return ""
        name = words.pop(0)
        if name not in programs.own_commands():
            return "./gnomon has no command '%s'" % name
        if programs.folder is None or name not in ("play", "bench", "check"):
            known = programs.script_flags(name)
            return "" if name in ("play", "bench", "check", "test") else next(
                ("./gnomon %s has no flag %s" % (name, word) for word in words if FLAG.match(word) and word not in known), "")
        program = "gnomon_game" if name == "play" else "gnomon_bench"
        if name == "check":
            words.insert(0, "check")
    elif programs.folder is None:
        return ""
    sub = ()
    if program == "gnomon_bench":
        if not words or is_placeholder(words[0]):
            return ""
        sub = (words.pop(0),)
        if sub[0] not in programs.bench_commands():
            return "the bench has no command '%s'" % sub[0]
    known = programs.flags(program, *sub)
    for index, word in enumerate(words):
        flag = word.split("=")[0]
        if FLAG.match(word) and flag not in known:
            return "%s has no flag %s" % (" ".join((program, *sub)), flag)
        if word == "--set" and index + 1 < len(words):
            key = words[index + 1].split("=")[0]
            if not is_placeholder(key) and key not in programs.keys():
                return "--set has no key '%s'" % key
    return ""


def wrong_commands(root, texts, programs):
    found, count = [], 0
    for page, text in texts.items():
        for line, command in pages.commands(text):
            count += 1
            wrong = wrong_command(command, programs)
            if wrong:
                found.append("%s:%d: `%s`: %s" % (page.relative_to(root), line, command, wrong))
    return found, count


# --- all --------------------------------------------------------------------------------------------------------------

def faults(root, folder):
    texts = {page: page.read_text(encoding="utf-8") for page in pages.pages(root)}
    commands, count = wrong_commands(root, texts, Programs(root, folder))
    found = wrong_links(root, texts) + wrong_mentions(root) + unseen_pictures(root, texts) + far_pages(root, texts) + wrong_figures(root, texts) + commands
    if (root / LIMITS).exists():
        found += untested_limits(root)
    links = sum(1 for text in texts.values() for _ in pages.links(text))
    figures = sum(len(FIGURE.findall(text)) for text in texts.values())
    return found, "%d pages, %d links and pictures, %d commands, %d marked figures" % (len(texts), links, count, figures)


# A page without fault, and changes that each make one.
GOOD = """# Title
[two](docs/two.md), [its part](docs/two.md#the-part-2), [here](#a-part), ![p](docs/p.png), [`code`](docs/two.md), [far](https://x/)
## A part
Costs <!-- figure: cost -->1.5 ms<!-- /figure --> and <!-- figure: cost -->1.5 ms<!-- /figure -->, by `./gnomon test --seed 3`.
```sh
./gnomon play --size 3x3 --set filter=hard   # a remark
./gnomon bench frame --rounds 2
```
"""
SPOILT = (
    ("(docs/two.md)", "(docs/too.md)", "does not exist"),
    ("#the-part-2", "#the-part-3", "no heading"),
    ("#a-part", "#b-part", "no heading"),
    ("p.png", "q.png", ""),
    ("![p](docs/p.png), ", "", "no page shows it"),
    ("[`code`](docs/two.md)", "[`code`](docs/none.md)", "does not exist"),
    ("1.5 ms<!-- /figure -->,", "1.6 ms<!-- /figure -->,", "figure cost"),
    ("1.5 ms<!-- /figure -->,", "1.5 ms,", "other half"),
    ("gnomon play", "gnomon plain", "no command"),
    ("--size", "--seize", "no flag"),
    ("filter=", "filler=", "no key"),
    ("bench frame", "bench frames", "no command"),
    ("--rounds", "--round", "no flag"),
    ("[two](docs/two.md), [its part](docs/two.md#the-part-2)", "", "clicks"),
)
GAME = """#!/bin/sh
case $1 in --list) echo '  filter  how';; *) echo '  --size WxH'; echo '  --set K=V'; echo '  --list';; esac
"""
BENCH = "#!/bin/sh\nif [ $1 = frame ]; then echo '  --rounds N'; else echo '  frame  times'; fi\n"
SCRIPT = "#!/bin/sh\nprintf '  play [F]  plays\\n  test [--seed N]\\n  bench WHAT\\n\\n'\n"


# Limits with their tests, and changes that each make a fault.
GOOD_LIMITS = {
    LIMITS: "## Numbers\n| what | limit |\n|---|---|\n| cats | 8 |\n| dogs | 2 |\n## Precision and determinism\n| a | b |\n|---|---|\n| bits | same |\n",
    THEIR_TESTS: "### Numbers\n| limit | tests |\n|---|---|\n| cats | `Cats.AreEight` |\n| dogs | `Dogs.test_two`, `Cats.AreEight` |\n"
                 "### Precision and determinism\n| limit | tests |\n|---|---|\n| bits | `Cats.AreEight` |\n",
    "tests/a_test.cpp": "TEST_F(Cats, AreEight) {}\n",
    "tests/test_a.py": "class Dogs(Test):\n    def test_two(self):\n",
}
SPOILT_LIMITS = (
    (LIMITS, "| dogs | 2 |", "| dogs | 2 |\n| mice | 3 |", "'mice' has no test"),
    (LIMITS, "| dogs | 2 |\n", "", "'dogs' is no limit"),
    (LIMITS, "## Numbers", "## Counts", "no table"),
    (THEIR_TESTS, "| cats | `Cats.AreEight` |\n", "", "'cats' has no test"),
    (THEIR_TESTS, "| cats | `Cats.AreEight` |", "| cats | – |", "names no test"),
    (THEIR_TESTS, "`Dogs.test_two`", "`Dogs.test_too`", "no test 'Dogs.test_too'"),
    ("tests/a_test.cpp", "AreEight", "AreNine", "no test 'Cats.AreEight'"),
    ("tests/test_a.py", "class Dogs", "class Cats", "no test 'Dogs.test_two'"),
)


def missed_limits():
    """Changes of SPOILT_LIMITS that are not found, each with what is."""
    missed = []
    with tempfile.TemporaryDirectory() as name:
        for file, before, after, expected in ((LIMITS, "", "", ""), *SPOILT_LIMITS):
            for path, text in GOOD_LIMITS.items():
                (Path(name) / path).parent.mkdir(parents=True, exist_ok=True)
                (Path(name) / path).write_text(text.replace(before, after) if path == file else text, encoding="utf-8")
            found = untested_limits(Path(name))
            if bool(found) != bool(before) or not any(expected in line for line in found or [""]):
                missed.append("'%s' in place of '%s' gives %s" % (after, before, found))
    return missed


def self_test():
    missed = missed_limits()
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        (root / "docs").mkdir()
        (root / "bin").mkdir()
        for file, text in (("docs/two.md", "# Two\n## The part\n## The part\n## The part\n[one](../README.md)\n"), ("docs/p.png", "")):
            (root / file).write_text(text, encoding="utf-8")
        for file, text in (("gnomon", SCRIPT), ("bin/gnomon_game", GAME), ("bin/gnomon_bench", BENCH)):
            (root / file).write_text(text, encoding="utf-8")
            (root / file).chmod(0o755)
        (root / "include").mkdir()
        for mention, expected in (("two", 0), ("too", 1)):
            (root / "include/a.h").write_text("// see docs/%s.md\n" % mention, encoding="utf-8")
            if len(wrong_mentions(root)) != expected:
                missed.append("a comment that names docs/%s.md" % mention)
        (root / "include/a.h").unlink()
        for before, after, expected in (("", "", ""), *SPOILT):
            text = GOOD.replace(before, after) if before else GOOD
            if expected == "clicks":
                text = text.replace("[`code`](docs/two.md)", "")
            (root / "README.md").write_text(text, encoding="utf-8")
            found, _ = faults(root, root / "bin")
            if bool(found) != bool(before) or not all(expected in line for line in found):
                missed.append("'%s' in place of '%s' gives %s" % (after, before, found))
    print(*missed, "%d spoilt, %d not found" % (len(SPOILT) + len(SPOILT_LIMITS) + 2, len(missed)), sep="\n")
    return 1 if missed else 0


def main(arguments):
    if "--self-test" in arguments:
        return self_test()
    folder = None
    if arguments[:1] == ["--bin"]:
        folder, arguments = Path(arguments[1]).resolve(), arguments[2:]
    found, counts = faults(Path(arguments[0]) if arguments else pages.ROOT, folder)
    print(*found, "%s: %d faults" % (counts, len(found)), sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
