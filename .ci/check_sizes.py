#!/usr/bin/env python3
"""Counts what grows unseen: fields of a frame's structs, parameters, shader conditions, a frame that is passed to be written.

usage: check_sizes.py [ROOT]       prints each count and its limit, and what is beyond; exit status 1 if anything is
       check_sizes.py --self-test  counts in small trees, with and without one of each
"""
import re
import sys
import tempfile
from pathlib import Path

MOST_FIELDS, MOST_AUTHORED_FIELDS, MOST_PARAMETERS, MOST_CONDITIONS = 16, 12, 6, 80
# Structs that one stage of a frame hands to the next, with what it reads and reports.
FRAME = ("systems/", "include/gnomon/")
# What a game's author sets of a light's shadow.
AUTHORED = "LightShadow"
# Results for engines on another API, of which a light has one per map; no stage reads them.
HANDED_OUT = {("include/gnomon/core.h", "View")}
CODE = ("systems", "include", "engine", "window", "sample_game", "bench")
SHADERS = {".glsl", ".vert", ".frag", ".geom", ".comp"}
# The only ones that see a frame whole: they call the stages.
WRITES_FRAME = {"systems/shadow/shadow_system.cpp", "systems/shadow/shadow_system.h"}

COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
STRUCT = re.compile(r"\bstruct\s+(\w+)(?:\s+final)?(?:\s*:[^{;]*)?\s*\{")
NO_FIELD = re.compile(r"^(?:using|typedef|friend|static|template|explicit|enum|struct|class|union)\b|^$")
CONDITION = re.compile(r"^\s*#\s*(?:if|ifdef|ifndef|elif)\b", re.MULTILINE)
MUTABLE_FRAME = re.compile(r"(?<![\w:])(?<!const )(?:\w+::)*ShadowFrame&")
CALLABLE = re.compile(r"(?<![\w.>])(\w+)\(")
PARAMETER = re.compile(r"^(?:const\s+)?[\w:]+(?:<.*>)?(?:\s*(?:const|[&*]))*[\s&*]+\w*(?:\[\w*\])?(?:\s*=.*)?$", re.DOTALL)


def code_of(path):
    return COMMENT.sub(lambda m: '""' if m.group()[0] == '"' else re.sub(r"[^\n]", " ", m.group()), path.read_text(encoding="utf-8"))


def closing(text, start, pair):
    """Index behind the bracket that closes the one at `start`."""
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] == pair[0]) - (text[i] == pair[1])
        if depth == 0:
            return i + 1
    return len(text)


def parts(text, separator=","):
    """Pieces between separators outside of all brackets."""
    pieces, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += (c in "([{<") - (c in ")]}" or (c == ">" and text[i - 1] != "-"))
        if c == separator and depth == 0:
            pieces.append(text[start:i])
            start = i + 1
    return [piece.strip() for piece in [*pieces, text[start:]] if piece.strip()]


def fields(body):
    """Number of data members of a struct's body."""
    count = 0
    bare = re.sub(r"\b(?:public|private|protected)\s*:(?!:)", "", body)
    while "{" in bare:   # functions' bodies end a member, initialisers do not
        start = bare.index("{")
        before = bare[:start].rstrip()
        end = closing(bare, start, "{}")
        is_body = before.endswith(")") or re.search(r"\)\s*(?:const|noexcept|override)+$|\)\s*:[^;]*$", before) or re.search(
            r"\b(?:struct|class|enum|union)\b[^;(]*$", before)
        bare = before + (" ()" if is_body and not before.endswith(")") else "") + (";" if is_body and bare[end:].lstrip()[:1] != ";" else "") + bare[end:]
    for member in parts(bare, ";"):
        first = member.split("=")[0]
        if NO_FIELD.match(member) or "(" in re.sub(r"<.*>", "", first) or "operator" in first:
            continue
        count += len(parts(member))
    return count


def structs(root):
    """(fields, limit, path, name) of each struct of a frame."""
    for path in (p for part in FRAME for p in sorted((root / part).rglob("*.h"))):
        text, name = code_of(path), path.relative_to(root).as_posix()
        for match in STRUCT.finditer(text):
            if (name, match[1]) not in HANDED_OUT:
                body = text[match.end():closing(text, match.end() - 1, "{}") - 1]
                yield fields(body), MOST_AUTHORED_FIELDS if match[1] == AUTHORED else MOST_FIELDS, name, match[1]


def parameters(root):
    """(number, path, function) of each function that is declared or defined."""
    for path in (p for part in CODE for p in sorted((root / part).rglob("*")) if p.suffix in {".h", ".cpp"}):
        text = code_of(path)
        for match in CALLABLE.finditer(text):
            end = closing(text, match.end() - 1, "()")
            taken = parts(text[match.end():end - 1])
            if taken and all(PARAMETER.match(p) for p in taken) and re.match(r"\s*(?:const|noexcept|override|->|[{;:])", text[end:]):
                yield len(taken), path.relative_to(root).as_posix(), match[1]


def check(root):
    """Lines to print, and the exit status."""
    large = [f"{path}: {name} has {count} fields, {limit} are the limit" for count, limit, path, name in structs(root) if count > limit]
    long = [f"{path}: {name}() has {count} parameters, {MOST_PARAMETERS} are the limit" for count, path, name in parameters(root) if count > MOST_PARAMETERS]
    conditions = sum(len(CONDITION.findall(p.read_text(encoding="utf-8"))) for p in (root / "shaders").rglob("*") if p.suffix in SHADERS)
    written = [f"{p.relative_to(root).as_posix()}: takes a frame to write" for p in sorted((root / "systems").rglob("*"))
               if p.suffix in {".h", ".cpp"} and p.relative_to(root).as_posix() not in WRITES_FRAME and MUTABLE_FRAME.search(code_of(p))]
    lines = [*large, *long, *written, f"{len(large)} structs with too many fields, {len(long)} functions with too many parameters, "
             f"{len(written)} files that take a frame to write, {conditions} conditions in shaders of {MOST_CONDITIONS}"]
    return lines, 1 if large or long or written or conditions > MOST_CONDITIONS else 0


# Contents of a header below systems/, and whether it is within the limits.
SAMPLES = (
    ("struct Small {\n" + "".join(f"    int a{i} = {{}};\n" for i in range(16)) + "};\n", True),
    ("struct Large {\n" + "".join(f"    int a{i} = {{}};\n" for i in range(17)) + "};\n", False),
    ("struct Pairs {\n" + "".join(f"    double a{i} = 0.0, b{i} = 1.0;  // c, d\n" for i in range(9)) + "};\n", False),
    ("struct Acts {\n    int a = f(1, 2);\n" + "".join(f"    int f{i}(int a, int b) const {{ return a; }}\n" for i in range(20)) + "};\n", True),
    ("struct LightShadow {\n" + "".join(f"    int a{i};\n" for i in range(13)) + "};\n", False),
    ("struct Map {\n" + "".join(f"    std::map<int, std::pair<int, int>> a{i};\n" for i in range(16)) + "};\n", True),
    ("void f(int a, int b, int c, int d, int e, int g);\n", True),
    ("void f(int a, const A& b, std::span<const int> c, A* d, double e = 0.0, int g = 1, B h = {});\n", False),
    ("inline int f() { return g(1, 2, 3, 4, 5, 6, 7); }\n", True),
    ("void stage(const ShadowFrame& frame);\n", True),
    ("void paint(const gnomon::shadow::ShadowFrame& frame);\n", True),
    ("void stage(ShadowFrame& frame);\n", False),
    ("void stage(shadow::ShadowFrame& frame);\n", False),
)


def self_test():
    failures = []
    for text, want in SAMPLES:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "systems").mkdir()
            (Path(folder) / "systems/own.h").write_text(text, encoding="utf-8")
            lines, status = check(Path(folder))
            if (status == 0) != want:
                failures.append(f"expected {'no ' if want else 'a '}breach in {text!r}: {lines}")
    for count in (MOST_CONDITIONS, MOST_CONDITIONS + 1):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "shaders").mkdir()
            (Path(folder) / "shaders/own.glsl").write_text("#ifdef A\n#endif\n" * count, encoding="utf-8")
            if check(Path(folder))[1] != (count > MOST_CONDITIONS):
                failures.append(f"{count} conditions judged wrongly")
    print(*failures, f"{len(SAMPLES) + 2} trees checked, {len(failures)} judged wrongly", sep="\n")
    return 1 if failures else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    lines, status = check(Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent)
    print(*lines, sep="\n")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
