#!/usr/bin/env python3
"""Counts breaches of the rules for comments and documents (docs/contributors/conventions.md). They may only fall.

usage: check_prose.py               prints folders with more breaches than .ci/prose_breaches.txt allows; exit 1 if any
       check_prose.py FOLDER ...    prints every breach below these folders or files
       check_prose.py --lower       writes the counts that fell into .ci/prose_breaches.txt
       check_prose.py --self-test   checks each rule on a sentence that breaks it and on one that does not
"""
import re
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
LIMITS = ROOT / ".ci/prose_breaches.txt"
HEAD = "# Breaches that .ci/check_prose.py tolerates below a folder. They may only fall."
TOP = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "THIRD_PARTY.md", "bench", "docs", "engine", "examples", "include", "sample_game", "shaders", "systems", "tests")
CPP, SHADERS = {".h", ".cpp"}, {".glsl", ".vert", ".frag", ".geom", ".comp", ".inc"}
MAX_WORDS_COMMENT, MAX_WORDS_DOCUMENT = 25, 35

# What a sentence must not hold, and what to write instead.
BANNED = (
    (r"lest", "so that ... not"),
    (r"whom|whose|whoever|whosoever", "name the noun; 'with', 'its'"),
    (r"(?:those|ones|one) (?:that|who|which)|all those", "name the noun"),
    (r"of which", "split the sentence"),
    (r"but for", "except"),
    (r"how-?manieth|so many(?! that)", "index, count, or the number's name"),
    (r"ke(?:ep|eps|pt|eping) (?:its|their|the|a|no|that) (?:word|contract|promise)|its word", "meets the target"),
    (r"g(?:ive|ives|ave|iving) way", "fell back, is replaced by"),
    (r"wish(?:es|ed|ing)?", "target, request"),
    (r"ask(?:s|ed|ing)?", "requests, queries, tests"),
    (r"(?:tell|tells|telling|told)(?: \w+)?(?: apart)?", "distinguishes, passes, names"),
    (r"says|said|saying", "states, returns, reports, gives"),
    (r"wait(?:s|ed|ing)?(?! (?:for|until|on) (?:the )?(?:GPU|device|driver|thread|fence|worker))",
     "is deferred; a thread waits for the GPU"),
    (r"(?:hold|holds|held|holding) out|let off|lets off", "name what happens"),
    (r"held", "stored, contained, or kept by hysteresis"),
    (r"(?:no|some|any|every)body|nobody's", "name who or what"),
    (r"anew|of late|thereby|therein|thereof|whereby", "again, recently, so"),
    (r"(?:was|were|been|have|had) tried|before this|formerly|any ?more", "no history"),
    (r"(?:it|this|that|they|we|which|there) used to", "no history"),
    (r"no longer (?:needed|necessary|required|used|supported|done)", "no history"),
)
BANNED = tuple((re.compile(rf"\b(?:{words})\b", re.IGNORECASE), instead) for words, instead in BANNED)
# First words that make a sentence start with what it is about last.
BAD_START_COMMENT = re.compile(r"(?:By(?! default)|(?i:of|to|who|whom|whose|those|whether|lest|whatever|as if))\b")
BAD_START_DOCUMENT = re.compile(r"(?:Of(?! course)|Who|Whom|Whose|Those|Lest|Whatever|As if)\b")
# Words that end in s and are no verb.
NO_VERB = re.compile(
    r"(?:this|its|is|was|has|as|always|less|others|ones|besides|afterwards|perhaps|whereas|headless|axis|bytes|casters|corners"
    r"|depths|entities|entries|faces|indices|instances|levels|metres|microseconds|numbers|parents|rays|rows|texels|timers"
    r"|timings|triangles|values|vectors|vertices|\w*ness)\b", re.IGNORECASE)

STRING = re.compile(r'"(?:\\.|[^"\\])*"')
ITEM, COMMENT_ITEM = re.compile(r"\s*(?:[-*]|\d+\.) "), re.compile(r"\s*[-*] ")
MARK = re.compile(r"\[/?\w[^]]*\]$")  # begins or ends what a page quotes
DIRECTIVE = re.compile(r"(?:namespace|NOLINT|clang-format|IWYU|SPDX|GCC diagnostic)\b|-{3,}|={3,}")
# Declaration of a function, operator or constructor: type, name, parenthesis, with neither = nor ; before it.
FUNCTION = re.compile(r"(?!using\b|return\b|struct\b|class\b|enum\b|#)"
                      r"(?:[^=;(]*[\w>&*\]] +[*&]?[\w:~]*(?:operator[^(]*)?\(|(?:explicit |constexpr )*~?[A-Z]\w*\()")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|al|cf|vs|[Ff]ig|[Ss]ec|Eq|pp?|ch)\.(?= )")
END = re.compile(r"(?<=[.!?])[)\"'*]*\s+")


class Passage(NamedTuple):
    """Comment or paragraph. kind: "function" (its comment), "comment" or "document"."""
    line: int
    kind: str
    text: str


def sentences(text):
    """Yields the sentences of a text; code in backticks and calls like `f()` count as one word."""
    text = re.sub(r"`[^`]*`|\b[\w:]+\(\)", "`c`", re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text))
    yield from filter(None, (part.strip() for part in END.split(ABBREVIATION.sub(r"\1", " ".join(text.split())))))


def breaches(passage):
    """Returns pairs of rule and sentence."""
    document, found = passage.kind == "document", []
    limit = MAX_WORDS_DOCUMENT if document else MAX_WORDS_COMMENT
    for index, sentence in enumerate(sentences(passage.text)):
        words = [word for word in sentence.split() if re.search(r"[A-Za-z0-9]", word)]
        start = sentence.lstrip("(*_-–\"' ")
        if len(words) > limit:
            found.append((f"{len(words)} words, {limit} are the limit", sentence))
        if (BAD_START_DOCUMENT if document else BAD_START_COMMENT).match(start):
            found.append((f"starts with '{start.split()[0]}'", sentence))
        elif passage.kind == "function" and index == 0 and (not re.match(r"[A-Za-z]+s\b", start) or NO_VERB.match(start)):
            found.append((f"a function's comment starts with a verb (Computes), not with '{start.split()[0]}'", sentence))
        for pattern, instead in BANNED:
            found += [(f"'{match.group()}': {instead}", sentence) for match in pattern.finditer(sentence)]
    return found


def bare(line):
    """The code of a line without attributes; empty for the first line of a template."""
    return re.sub(r"\[\[[^]]*\]\]|(?:template|requires)\b.*>$", "", line.strip()).strip()


def comments(text, shader):
    """Yields the comments of C++ or GLSL as passages. Neighbouring lines that start in the same column are one comment."""
    lines, block, first, start, mark, alone = text.splitlines(), [], 0, 0, "", False
    for number, line in enumerate(lines + [""], 1):
        column = STRING.sub(lambda match: "s" * len(match.group()), line).find("//")
        is_alone = column >= 0 and not line[:column].strip()
        new_mark, words = re.match(r"(//[/!]?<?)\s?(.*)", line[column:]).groups() if column >= 0 else ("", "")
        if block and not (is_alone and column == start and new_mark == mark):
            code = next((code for code in map(bare, lines[number - 1:]) if code), "")
            is_doc = alone and (mark == "///" or (shader and start == 0))
            documents = is_doc and line.strip() and column != start and FUNCTION.match(code)
            yield from passages_of(block, first, "function" if documents else "comment")
            block = []
        if column >= 0:
            if not block:
                first, start, mark, alone = number, column, new_mark, is_alone
            block.append(words)


def passages_of(block, first, kind):
    """Splits a comment at list items and empty lines; the first passage alone has the kind given."""
    rows = []
    for number, words in enumerate(block + [""], first):
        mark = MARK.match(words.strip())
        if rows and (not words.strip() or mark or COMMENT_ITEM.match(words)):
            joined = " ".join(words for _, words in rows)
            if not DIRECTIVE.match(joined):
                yield Passage(rows[0][0], kind, joined)
            rows, kind = [], "comment"
        if words.strip() and not mark:
            rows.append((number, COMMENT_ITEM.sub("", words).strip()))


def paragraphs(text):
    """Yields the paragraphs and list items of Markdown, without code, tables and headings."""
    block, first, fenced = [], 0, False
    for number, line in enumerate(text.splitlines() + [""], 1):
        fence, item = line.lstrip().startswith("```"), ITEM.match(line)
        ends = fenced or fence or item or not line.strip() or line.lstrip()[0] in "|#<>"
        if ends and block:
            yield Passage(first, "document", " ".join(block))
            block = []
        fenced ^= fence
        if not ends or (item and not fenced):
            first = first if block else number
            block.append(line[item.end():] if item else line)


def passages(path, text):
    if path.suffix == ".md":
        return paragraphs(text)
    return comments(text, path.suffix in SHADERS)


def files(names=TOP):
    """Returns the paths, relative to the root, of all checked files among and below `names`."""
    roots = [ROOT / name for name in names]
    found = [file for root in roots for file in ([root] if root.is_file() else sorted(root.rglob("*")))]
    return [file.relative_to(ROOT) for file in found if file.suffix in CPP | SHADERS | {".md"}]


def breaches_of(path):
    """Returns lines `file:line: rule: sentence`."""
    text = (ROOT / path).read_text(encoding="utf-8", errors="replace")
    return [f"{path}:{passage.line}: {rule}: {sentence}"
            for passage in passages(path, text) for rule, sentence in breaches(passage)]


def folder_of(path, limits):
    """The longest folder of `limits` that holds the path, else its top folder."""
    parents = [str(parent) for parent in path.parents]
    return next((parent for parent in parents if parent in limits and parent != "."), parents[-2] if len(parents) > 1 else ".")


def read_limits():
    lines = LIMITS.read_text(encoding="utf-8").splitlines() if LIMITS.is_file() else []
    return {folder: int(count) for folder, count in (line.split() for line in lines if line and line[0] != "#")}


def rating(folder, count, limit):
    if count > limit:
        return f"{folder}: {count} breaches, more than {limit}: see .ci/check_prose.py {folder}"
    return f"{folder}: {count} breaches" + (f", fewer than {limit}: run .ci/check_prose.py --lower" if count < limit else "")


def check_limits(lower):
    limits = read_limits()
    counts = dict.fromkeys(limits, 0)
    for path in files():
        folder = folder_of(path, limits)
        counts[folder] = counts.get(folder, 0) + len(breaches_of(path))
    failed = False
    for folder, count in sorted(counts.items()):
        limit = limits.get(folder, 0)
        failed |= count > limit
        print(rating(folder, count, limit))
    if lower:
        rows = [f"{folder} {min(count, limits.get(folder, count))}" for folder, count in sorted(counts.items())]
        LIMITS.write_text("\n".join([HEAD, *rows, ""]), encoding="utf-8")
    return 1 if failed and not lower else 0


LONG = " ".join(["word"] * 26) + "."
# File name, text, and part of the rule that it breaks; None: it breaks none.
SAMPLES = (
    ("a.h", f"// {LONG}\n", "26 words"),
    ("a.h", "// " + " ".join(["word"] * 25) + ". Next.\n", None),
    ("a.h", "// Word, " + "`a b c` word " * 10 + "\n// word, word and word.\n", None),
    ("a.h", 'f("// of");  // ' + LONG + "\n", "26 words"),
    ("a.h", 'f("http://of");\n', None),
    ("a.h", f"int a;  // {'word ' * 13}\n        // {'word ' * 13}\n", "26 words"),
    ("a.h", f"// {'word ' * 13}\n// - {'word ' * 13}\n", None),
    ("a.h", "/// Of a map.\nint a;\n", "starts with 'Of'"),
    ("a.h", "/// Edge of a map. Default by cost, e.g. of a map.\nint a;\n", None),
    ("a.h", "// At least\n// 1. %s\n" % " ".join(["word"] * 24), None),
    ("a.h", "std::vector<int> edges;  // by slot\n", None),
    ("a.h", "/// Finds it:\n/// - edge\nint edge(int a);\n", None),
    ("a.h", "/// Edge. To be kept.\nint a;\n", "starts with 'To'"),
    ("a.h", "/// Edge. Whether kept.\nint a;\n", "starts with 'Whether'"),
    ("a.h", "/// The edge.\nint edge(int a);\n", "starts with a verb"),
    ("a.h", "/// Returns it.\nint edge(int a);\n", None),
    ("a.h", "/// Bytes of an edge.\nint edge(int a);\n", "starts with a verb"),
    ("a.h", "/// `a` is an edge.\n[[nodiscard]] std::vector<int> edge(int a) {\n", "starts with a verb"),
    ("a.h", "/// Edge.\ntemplate <class T>\nT edge(T a);\n", "starts with a verb"),
    ("a.h", "/// Edge.\nexplicit A(int a);\n", "verb"),
    ("a.h", "/// Edge.\nint edge = f(2);\n", None),
    ("a.h", "/// Edge.\nstruct Edge {\n", None),
    ("a.h", "// Edge.\nint edge(int a) {\n", None),
    ("a.glsl", "// Edge.\nfloat edge(vec2 a) {\n", "starts with a verb"),
    ("a.glsl", "// Edge.\nuniform vec2 edge;\n", None),
    ("a.h", "// Lights that lack a map.\n}  // namespace whom\n", None),
    ("a.h", "// Lights, lest it fails.\n", "lest"),
    ("a.h", "// Lights whose map fails.\n", "whose"),
    ("a.h", "// Sorts those that fail.\n", "those that"),
    ("a.h", "// Lights of which none fails.\n", "of which"),
    ("a.h", "// All but for one.\n", "but for"),
    ("a.h", "// So many frames.\n", "So many"),
    ("a.h", "// A light keeps its word.\n", "keeps its word"),
    ("a.h", "// The filter gives way.\n", "gives way"),
    ("a.h", "// Size wished.\n", "wished"),
    ("a.h", "// A light asks for it.\n", "asks"),
    ("a.h", "// Calls ask() twice.\n", None),
    ("a.h", "// It tells what.\n", "tells"),
    ("a.h", "// As the map says.\n", "says"),
    ("a.h", "// The light waits for it.\n", "waits"),
    ("a.h", "// Waits for the GPU.\n", None),
    ("a.h", "// It lets off a view.\n", "lets off"),
    ("a.h", "// Size as held.\n", "held"),
    ("a.h", "// Nobody reads it.\n", "Nobody"),
    ("a.h", "// Built anew.\n", "anew"),
    ("a.h", "// A wider one was tried.\n", "no history"),
    ("a.h", "// It used to fail.\n", "no history"),
    ("a.h", "// A lock that is no longer needed.\n", "no history"),
    ("a.h", "// It is used to compute the edge.\n", None),
    ("a.md", f"{' '.join(['word'] * 36)}.\n", "36 words"),
    ("a.md", f"{' '.join(['word'] * 30)}.\n- {' '.join(['word'] * 30)}.\n", None),
    ("a.md", f"```\n{LONG} {LONG} whom\n```\n\n| whom |\n\n# Whom\n", None),
    ("a.md", "A light whose map fails.\n", "whose"),
    ("a.md", "Of lights, some fail.\n", "starts with 'Of'"),
    ("a.md", "To build, see [to](whom.md).\n", None),
)


def self_test():
    wrong = []
    for name, text, rule in SAMPLES:
        found = [broken for passage in passages(Path(name), text) for broken, _ in breaches(passage)]
        if (rule is None and found) or (rule and not any(rule in broken for broken in found)):
            wrong.append(f"expected {rule!r} in {text!r}, found {found}")
    limits = {"a": 1, "a/b": 2}
    folders = [folder_of(Path(name), limits) for name in ("a/x.h", "a/b/c/x.h", "d/e/x.h", "x.md")]
    if folders != ["a", "a/b", "d", "."]:
        wrong.append(f"files counted in {folders}")
    if not ("more" in rating("a", 3, 2) and "fewer" in rating("a", 1, 2) and rating("a", 2, 2) == "a: 2 breaches"):
        wrong.append("a number above or below its limit is passed over")
    caught = {rule for _, _, rule in SAMPLES}
    for pattern, instead in BANNED:
        if not any(rule and (pattern.search(rule) or rule == instead) for rule in caught):
            wrong.append(f"no sample for {pattern.pattern}")
    print(*wrong, f"{len(SAMPLES)} samples, {len(wrong)} judged wrongly", sep="\n")
    return 1 if wrong else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if arguments and arguments != ["--lower"]:
        found = [line for path in files(arguments) for line in breaches_of(path)]
        print(*found, f"{len(found)} breaches", sep="\n")
        return 1 if found else 0
    return check_limits(arguments == ["--lower"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
