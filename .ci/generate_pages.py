#!/usr/bin/env python3
"""Fills the parts of pages that programs know, and says which measured parts are older than what they measure.

usage: generate_pages.py --bin FOLDER           writes every generated block, and a stamp into measured ones that have none
       generate_pages.py --bin FOLDER --check   writes nothing; exit status 1 if a block differs, is unknown or has no stamp
       generate_pages.py --bin FOLDER --stamp PAGE -- COMMAND   stamps the blocks of PAGE that COMMAND has just replaced
       generate_pages.py --list                 names all blocks
       generate_pages.py --self-test            spoils blocks of a small tree, and expects each to be found
FOLDER has gnomon_tables, gnomon_game and gnomon_bench.

A generated block stands between <!-- generated: NAME --> and <!-- /generated -->. A measured one, which only its command can
remake, stands between <!-- NAME --> and <!-- end of NAME -->, and begins with a stamp: command, device and commit. A table
with rows `command`, `device` and `commit` states the same of figures that were taken over by hand.
A figure, <!-- figure: NAME -->text<!-- /figure -->, is filled if docs/pictures/figures.json has its name.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
from html import escape, unescape
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import pages  # noqa: E402  (it lies beside this file)
from check_pages import FIGURE  # noqa: E402

BLOCK = re.compile(r"(?P<begin>^[ \t]*<!-- generated: (?P<name>[^\n>]+?) -->\n)(?P<text>.*?)(?P<end>^[ \t]*<!-- /generated -->$)",
                   re.MULTILINE | re.DOTALL)
BLOCK_MARK = re.compile(r"^[ \t]*<!-- (?:generated: .*|/generated) -->$", re.MULTILINE)
MEASURED = re.compile(r"(?P<begin>^<!-- (?P<name>[\w ]+) -->\n)(?P<text>.*?)(?P<end>^<!-- end of (?P=name) -->$)",
                      re.MULTILINE | re.DOTALL)
STAMP = re.compile(r"<sub>Made by <code>(?P<command>[^\n]*?)</code> on (?P<device>[^\n]*?), commit (?P<commit>[0-9a-f]{7,40})"
                   r"(?P<dirty>, changed)?\.</sub>\n\n?")
ORIGIN = re.compile(r"^\| *\| *\|\n\|-+\|-+\|\n(?P<rows>(?:\|[^\n]*\|\n)+)", re.MULTILINE)
ORIGIN_ROW = re.compile(r"^\| *(?P<name>command|device|commit) *\| *(?P<value>.*?) *\|$", re.MULTILINE)
FIGURES = Path("docs/pictures/figures.json")
# Measured blocks: what their figures depend on, beside the command that makes them.
SHADOWS = ("systems", "shaders", "engine")
DEPENDS = {
    "cost": (*SHADOWS, "bench/sweep", "bench/compare", "bench/accuracy"),
    "demand": (*SHADOWS, "bench/scaling"),
    "rows": (*SHADOWS, "bench/compare", "bench/accuracy"),
    "pictures": (*SHADOWS, "bench/compare"),
    "pictures of a disk": (*SHADOWS, "bench/compare"),
    "figures": (*SHADOWS, "bench/compare", "bench/accuracy"),
    "figures of a disk": (*SHADOWS, "bench/compare", "bench/accuracy"),
    "speeds": (*SHADOWS, "bench/cost_model"),
    "redraws": (*SHADOWS, "bench/scaling"),
    "strip": (*SHADOWS, "bench/pictures"),
}
# Folders of the bench's commands, beside those of the same name.
FOLDER_OF = {"filters": "compare", "demand": "scaling", "redraws": "scaling", "budget": "cost_model", "sets": "culling",
             "stability": "flicker", "drawings": "fit_drawings"}


# --- tables -----------------------------------------------------------------------------------------------------------

def table(head, rows):
    lines = [head, ["---"] * len(head)] + [[" ".join(str(cell).replace("|", "\\|").split()) for cell in row] for row in rows]
    return "\n".join("|" + "|".join(" %s " % cell if cell != "---" else cell for cell in row) + "|" for row in lines) + "\n"


def code(text):
    return "`%s`" % text


def values(text):
    """The values of a setting: words as code, ranges as they are."""
    words = [word.strip() for word in text.replace("...", "…").split(" | ")]
    return ", ".join(code(word) if re.fullmatch(r"[a-z_0-9]*[a-z_]+[a-z_0-9]*", word) else word for word in words)


def setting_rows(settings, with_component=False):
    return [[code(s["key"]), code(s["field"] if with_component else re.split(r"::|\.", s["field"])[-1]), values(s["values"]),
             code(s["default"]), s["meaning"] + (". Needs " + s["needs"] if s["needs"] else "")] for s in settings]


SETTING_HEAD = ["key", "field", "values", "default", "meaning"]


def all_settings(tables):
    return [setting for group in tables["settings"] for setting in group["settings"]]


def settings_by_group(tables, wanted):
    """Tables of the C++ components' groups; of one group its table alone."""
    if wanted:
        return table(SETTING_HEAD, setting_rows(next(g["settings"] for g in tables["settings"] if g["name"] == wanted)))
    return "\n".join("**%s**: %s\n\n%s" % (g["name"], g["meaning"], table(SETTING_HEAD, setting_rows(g["settings"])))
                     for g in tables["settings"])


def settings_by_purpose(tables, wanted):
    """Tables of the panel's groups; of one group its table alone."""
    def rows(name):
        return table(SETTING_HEAD, setting_rows([s for s in all_settings(tables) if s["purpose"] == name], True))
    if wanted:
        return rows(next(p["name"] for p in tables["purposes"] if p["name"] == wanted))
    return "\n".join("**%s**: %s\n\n%s" % (p["name"], p["meaning"], rows(p["name"])) for p in tables["purposes"])


def key_rows(tables):
    """Rows of the window's keys; those that work in a part alone name it."""
    first = tables["keys"][0]["place"]
    return [[k["keys"], k["gamepad"], k["meaning"] + ("" if k["place"] == first else " (%s)" % k["place"])]
            for k in tables["keys"]]


def in_two_columns(line):
    """A line of a --help as CLI11 writes it before version 2.5. Since then long names have a column of their own."""
    later = re.match(r" {10}(--.*)|  (-\w), +(--.*)", line)
    if not later:
        return line
    names = ",".join(name for name in later.groups() if name)
    column, meaning = names[:20], names[20:]
    fills = re.fullmatch(r"\S+ [A-Z]+(?: REQUIRED)? ", column)  # so that the meaning follows by one space
    return "  " + (column + "  " + meaning if fills else names)


def options_table(text):
    """Flags of a --help of CLI11 as a table; the part of a meaning before its colon is the flag's value."""
    rows = []
    for line in map(in_two_columns, text.splitlines()):
        flag = re.match(r"  (-\S.*?)(?:  +(.*))?$", line)
        if flag:
            names = re.findall(r"-{1,2}[A-Za-z][\w-]*", flag[1].split(" ", 1)[0])
            rows.append([names, (flag[2] or "").strip()])
        elif rows and re.match(r" {6,}\S", line):
            rows[-1][1] += " " + line.strip()
        elif rows and line.strip():
            break
    cells = []
    for names, meaning in rows:
        meaning = re.sub(r"\bTEXT\b(?: \.\.\.)? ?|^\.\.\. ", "", meaning).strip()
        value = re.match(r"([A-Z][\w.]*(?:[|=x\[:][\w|.:\[\]]*)?|[a-z]+(?:\|[a-z]+)+|[A-Z]+(?: \.\.\.)?)(?=: | \(|$):? ?", meaning)
        shown = names[-1] + (" " + value[1] if value else "")
        cells.append([code(shown), meaning[value.end():] if value else meaning])
    return table(["flag", "meaning"], cells)


# CLI11 writes it in capitals from version 2.5 on.
HEADING_OF_SUBCOMMANDS = re.compile(r"^subcommands:\n", re.IGNORECASE | re.MULTILINE)


def subcommands(text):
    """Names and words of the subcommands in a --help of CLI11."""
    rows = []
    for line in re.split(HEADING_OF_SUBCOMMANDS, text)[1].splitlines():
        begin = re.match(r"  (\w+)(?:  +(.*))?$", line)
        if begin:
            rows.append([begin[1], (begin[2] or "").strip()])
        elif rows and re.match(r" {6,}\S", line):
            rows[-1][1] = (rows[-1][1] + " " + line.strip()).strip()
    return rows


def commands_table(text):
    """Commands of ./gnomon help."""
    rows = []
    for line in text.splitlines():
        begin = re.match(r"  (\w.*?)(?:  +(.*))?$", line)
        if begin:
            rows.append([code("./gnomon " + begin[1]), begin[2] or ""])
        elif rows and re.match(r" {10,}\S", line):
            rows[-1][1] += " " + line.strip()
        elif rows:
            break
    return table(["command", "what it does"], rows)


class Facts:
    """What the programs know of themselves, read once."""

    def __init__(self, root, folder):
        self.root, self.folder = root, folder
        self.tables = json.loads(self.output("gnomon_tables"))

    def output(self, program, *arguments):
        done = subprocess.run([str(self.folder / program), *arguments], stdout=subprocess.PIPE, text=True, timeout=60, check=True)
        return done.stdout

    def commands(self):
        done = subprocess.run([str(self.root / "gnomon"), "help"], stdout=subprocess.PIPE, text=True, check=True)
        return commands_table(done.stdout)

    def block(self, name):
        """Text of a generated block. Raises KeyError or StopIteration if there is no such block."""
        words = name.split(" ", 1)
        kind, rest = words[0], words[1] if len(words) > 1 else ""
        tables = self.tables
        if kind == "settings":
            return settings_by_purpose(tables, rest[len("for "):]) if rest.startswith("for ") else settings_by_group(tables, rest)
        if name == "purposes":
            return settings_by_purpose(tables, "")
        if kind == "options":
            program, *sub = rest.split()
            return options_table(self.output({"game": "gnomon_game", "bench": "gnomon_bench"}[program], *sub, "--help"))
        return {
            "presets": lambda: table(["preset", "settings", "meaning"], [
                [code(p["name"]), code(" ".join(p["settings"])) if p["settings"] else "none", p["meaning"]]
                for p in tables["presets"]]),
            "filters": lambda: table(["filter", "taps: flat map, cube", "half-width, texels", "source", "file"], [
                [code(f["name"]), "%d, %d" % (f["taps"], f["taps_cube"]), "%.3g" % f["reach_texel"],
                 "soft" if f["soft"] else "a point", code(f["file"])] for f in tables["filters"]]),
            "reasons": lambda: table(["reason", "state", "meaning", "what to do"], [
                [code(r["code"]), r["states"], r["meaning"].rstrip("."), r["cure"] or "–"] for r in tables["reasons"]]),
            "debug views": lambda: table(["view", "shows"], [
                [code(v["name"] + ("[:LIGHT]" if v["of_all"] else ":LIGHT")), v["meaning"]] for v in tables["debug_views"]]),
            "keys": lambda: table(["key", "gamepad", "does"], key_rows(tables)),
            "gnomon": self.commands,
            "commands": self.commands,
            "play": lambda: options_table(self.output("gnomon_game", "--help")),
            "bench": lambda: table(["measurement", "what it does"], [
                [code(name), words] for name, words in subcommands(self.output("gnomon_bench", "--help"))]),
        }[name]()


def names_of(facts):
    tables = facts.tables
    return (["settings"] + ["settings " + g["name"] for g in tables["settings"]] + ["purposes"] +
            ["settings for " + p["name"] for p in tables["purposes"]] +
            ["presets", "filters", "reasons", "debug views", "keys", "commands", "gnomon", "play", "bench", "options game"] +
            ["options bench " + name for name in [name for name, _ in subcommands(facts.output("gnomon_bench", "--help"))]])


# --- pages ------------------------------------------------------------------------------------------------------------

def filled(text, facts, figures, faults, name):
    """The page with its generated blocks as they should be. Adds a line to `faults` for each that cannot be made."""
    def block(match):
        try:
            made = facts.block(match["name"])
        except (KeyError, StopIteration, subprocess.CalledProcessError):
            faults.append("%s:%d: no block is named '%s'" % (name, pages.line_of(text, match.start()), match["name"]))
            return match[0]
        return match["begin"] + "\n" + made.strip("\n") + "\n\n" + match["end"]

    if BLOCK_MARK.search(BLOCK.sub("", text)):
        faults.append("%s: a mark of a generated block without its other half" % name)
    text = BLOCK.sub(block, text)
    return FIGURE.sub(lambda m: "<!-- figure: %s -->%s<!-- /figure -->" % (m["name"], figures.get(m["name"], m["text"])), text)


def git(root, *arguments):
    done = subprocess.run(["git", "-C", str(root), *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def first_commit_of(root, text):
    """The commit that brought the last line of figures of a measured block, wherever the page was then."""
    lines = [line for line in text.splitlines() if line.startswith("|") and re.search(r"\d", line)] or text.splitlines()
    return (git(root, "log", "--reverse", "--format=%h", "-S", lines[-1], "--", "docs", "bench").splitlines() or [""])[0]


def measured_blocks(text):
    return [match for match in MEASURED.finditer(text) if match["name"] in DEPENDS]


def stamp_line(command, device, commit, dirty=False):
    return "<sub>Made by <code>%s</code> on %s, commit %s%s.</sub>\n\n" % (escape(command, quote=False), device, commit,
                                                                        ", changed" if dirty else "")


def stamped(text, line):
    """The page with line(match) at the start of each measured block that has no stamp."""
    def put(match):
        if match["name"] not in DEPENDS or STAMP.match(match["text"]):
            return match[0]
        return match["begin"] + line(match) + match["text"] + match["end"]
    return MEASURED.sub(put, text)


def changes_since(root, commit, paths):
    """Number of commits that changed the paths since; None: there is no such commit in this history."""
    if not git(root, "cat-file", "-t", commit) == "commit":
        return None
    return len(git(root, "log", "--oneline", "%s..HEAD" % commit, "--", *paths).splitlines())


def age_words(root, name, what, commit, paths, command):
    """A line if what a page shows is older than what it depends on, and one if its commit is unknown."""
    count = changes_since(root, commit, paths)
    if count is None:
        return [], ["%s: %s is of the commit %s, which is unknown here" % (name, what, commit)]
    return [] if count == 0 else ["older: %s: %s is of %s; %d commits changed what it depends on since. Again: %s" % (
        name, what, commit, count, command)], []


def origins(text):
    """Yields (line, rows by name) of each table that states where figures come from."""
    for match in ORIGIN.finditer(text):
        rows = {row["name"]: row["value"].strip("`") for row in ORIGIN_ROW.finditer(match["rows"])}
        if "commit" in rows or "command" in rows:
            yield pages.line_of(text, match.start()), rows


def paths_of(command):
    """What the figures of a command depend on."""
    word = re.search(r"(?:bench|gnomon_bench) ([a-z]+)", command)
    return SHADOWS if not word else (*SHADOWS, "bench/" + FOLDER_OF.get(word[1], word[1]))


def ages(root, name, text):
    """Lines about measured blocks and tables: those without a stamp, and those older than what they depend on."""
    missing, old = [], []
    for line, rows in origins(text):
        lacking = [part for part in ("command", "device", "commit") if part not in rows]
        if lacking:
            missing.append("%s:%d: the figures have no %s" % (name, line, " and no ".join(lacking)))
        elif re.fullmatch(r"[0-9a-f]{7,40}", rows["commit"]):
            older, unknown = age_words(root, name, "line %d" % line, rows["commit"], paths_of(rows["command"]), rows["command"])
            old += older
            missing += unknown
        else:
            missing.append("%s:%d: '%s' is no commit" % (name, line, rows["commit"]))
    for match in measured_blocks(text):
        stamp = STAMP.match(match["text"])
        if not stamp:
            missing.append("%s: the measured block '%s' has no stamp" % (name, match["name"]))
            continue
        older, unknown = age_words(root, name, "'%s'" % match["name"], stamp["commit"], DEPENDS[match["name"]],
                                   unescape(stamp["command"]))
        old += older
        missing += unknown
    return missing if is_whole_history(root) else [line for line in missing if "is unknown here" not in line], old


def is_whole_history(root):
    return git(root, "rev-parse", "--is-shallow-repository") == "false"


def old_command(text, match):
    """The command in the text above a block; a block that is older than stamps names no other."""
    above = [command for _, command in pages.commands(text[:match.start()]) if " bench " in command]
    return above[-1] if above else "./gnomon bench"


def device_of(facts):
    """The name of the device that the programs draw with here."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "stats.json")
        facts.output("gnomon_game", "--headless", "--frames", "1", "--size", "16x16", "--stats", file)
        with open(file, encoding="utf-8") as stats:
            return json.load(stats)["device"]


def run(root, facts, check):
    faults, old, differ = [], [], 0
    file = root / FIGURES
    figures = json.loads(file.read_text(encoding="utf-8"))["figures"] if file.is_file() else {}
    for page in pages.pages(root):
        name, text = page.relative_to(root), page.read_text(encoding="utf-8")
        wanted = filled(text, facts, figures, faults, name)
        if not check:
            wanted = stamped(wanted, lambda m: stamp_line(old_command(text, m), "llvmpipe", first_commit_of(root, m["text"])))
        missing, older = ages(root, name, wanted)
        faults += missing
        old += older
        if wanted != text:
            differ += 1
            if check:
                faults.append("%s differs from the program: run .ci/generate_pages.py --bin build/release/bin" % name)
            else:
                page.write_text(wanted, encoding="utf-8")
                print("wrote", name)
    print(*old, *faults, sep="\n")
    print("%d pages %s, %d faults, %d measured blocks are older than what they depend on" % (
        differ, "differ" if check else "written", len(faults), len(old)))
    return 1 if faults else 0


# --- self-test --------------------------------------------------------------------------------------------------------

class SmallFacts:
    tables = {}

    @staticmethod
    def block(name):
        return {"keys": "|a|\n|---|\n|b|\n"}[name]


GOOD = "x\n\n<!-- generated: keys -->\n\n|a|\n|---|\n|b|\n\n<!-- /generated -->\n\nIt is <!-- figure: f -->1 %<!-- /figure -->.\n\n" \
       "<!-- cost -->\n<sub>Made by <code>./gnomon bench x</code> on d, commit 0123456.</sub>\n\n|1|\n<!-- end of cost -->\n"
TABLE = "| | |\n|---|---|\n| %s | `./gnomon bench frame --rounds 2` |\n| device | d |\n| commit | %s |\n"
SPOILT = (("|b|", "|c|"), ("generated: keys", "generated: key"), ("<!-- /generated -->", ""), (">1 %<", ">2 %<"),
          (", commit 0123456", ""), ("<sub>Made by", "<sub>Maid by"))


# Help as CLI11 prints it before version 2.5, and from then on.
HELPS = ("Usage: x\n\nOptions:\n  -h,--help                   Print\n  --scene TEXT ...            FILE: a\n                              scene\n"
         "  --out TEXT REQUIRED         F.png: the strip\n  --shadow-bytes TEXT         N|any: bytes\n\nSubcommands:\n  frame                       times\n",
         "x\n\nOPTIONS:\n  -h,     --help              Print \n          --scene TEXT ...    FILE: a \n                              scene \n"
         "          --out TEXT REQUIRED F.png: the strip \n          --shadow-bytes TEXT N|any: bytes \n\nSUBCOMMANDS:\n  frame                       times \n")


def self_test():
    missed = []
    for read in (options_table, subcommands):
        if read(HELPS[0]) != read(HELPS[1]) or not read(HELPS[0]):
            missed.append("%s depends on CLI11's version" % read.__name__)
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / FIGURES.parent).mkdir(parents=True)
        (root / FIGURES).write_text('{"figures": {"f": "1 %"}}', encoding="utf-8")
        page = root / "README.md"
        for before, after in (("", ""), *SPOILT):
            page.write_text(GOOD.replace(before, after) if before else GOOD, encoding="utf-8")
            if run(root, SmallFacts, True) != (1 if before else 0):
                missed.append("'%s' in place of '%s'" % (after, before))
        page.write_text(GOOD.replace("|b|", "|c|").replace(">1 %<", "><"), encoding="utf-8")
        run(root, SmallFacts, False)
        if page.read_text(encoding="utf-8") != GOOD:
            missed.append("a block that is written")
        subprocess.run("git init -q && git add -A && git -c user.name=a -c user.email=b commit -qm a && mkdir systems && "
                       "echo 1 > systems/a && git add -A && git -c user.name=a -c user.email=b commit -qm b", shell=True,
                       cwd=root, check=True)
        for ref, older in (("HEAD", 0), ("HEAD~1", 1)):
            commit = git(root, "rev-parse", "--short=8", ref)
            for text in (GOOD.replace("0123456", commit), TABLE % ("command", commit)):
                if [len(lines) for lines in ages(root, "page", text)] != [0, older]:
                    missed.append("the age of %s in %s" % (ref, text))
        for text in (GOOD, TABLE % ("command", "0123456"), TABLE % ("command", "yesterday"), TABLE % ("words", "0123456")):
            if len(ages(root, "page", text)[0]) != 1:
                missed.append("an origin that is none: %s" % text)
    print(*missed, "%d spoilt, %d not found" % (len(SPOILT) + 9, len(missed)), sep="\n")
    return 1 if missed else 0


def main(arguments):
    if "--self-test" in arguments:
        return self_test()
    folder = Path(arguments[arguments.index("--bin") + 1]) if "--bin" in arguments else pages.ROOT / "build/release/bin"
    facts = Facts(pages.ROOT, folder.resolve())
    if "--list" in arguments:
        print(*names_of(facts), sep="\n")
        return 0
    if "--stamp" in arguments:
        page, command = Path(arguments[arguments.index("--stamp") + 1]), arguments[arguments.index("--") + 1:]
        commit, dirty = git(pages.ROOT, "rev-parse", "--short=8", "HEAD"), bool(git(pages.ROOT, "status", "--porcelain", "-uno"))
        line = stamp_line(" ".join(["./gnomon", *command]), device_of(facts), commit or "0000000", dirty)
        page.write_text(stamped(page.read_text(encoding="utf-8"), lambda match: line), encoding="utf-8")
        return 0
    return run(pages.ROOT, facts, "--check" in arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
