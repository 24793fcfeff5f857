#!/usr/bin/env python3
"""Filter of Doxygen: what the headers state in comments behind a field reaches the reference.

usage: trailing_comments.py HEADER      prints the header for Doxygen; the number of its lines may change
       trailing_comments.py --self-test
- `int a;  // text` and the lines of that comment below it become `int a;  ///< text`.
- operator== that is defaulted gets its one sentence.
- `int a = 0, b = 0;  // text` becomes a line for each, with the same text, as does one below a `///` comment.
"""
import re
import sys

FIELD = re.compile(r"^(?P<indent> +)(?P<code>[^/\s#][^/]*[,;}\])\w]) +//(?!/) (?P<words>.*)$")
EQUAL = re.compile(r"^( *)bool operator==\(.*\) const = default;$")
MORE = re.compile(r"^ +// (?P<words>.*)$")
SEVERAL = re.compile(r"^(?P<type>(?:const )?[\w:]+(?:<[\w:, ]+>)?) (?P<names>\w+(?: = [^,;{}()]+|\{[^{};()]*\})?"
                     r"(?:, \w+(?: = [^,;{}()]+|\{[^{};()]*\})?)+);$")


def parts_of(code):
    """`int a = 0, b = 0;` as one declaration for each name; otherwise the code itself."""
    match = SEVERAL.match(code)
    if not match or code.startswith(("return", "using")):
        return [code]
    names = re.findall(r"\w+(?: = [^,;{}()]+|\{[^{};()]*\})?", match["names"])
    return ["%s %s;" % (match["type"], name) for name in names]


def filtered(text):
    lines, out, above = text.splitlines(), [], []
    column = None  # of a trailing comment that the line before had
    for line in lines:
        field, more = FIELD.match(line), MORE.match(line)
        if more and column is not None and line.index("//") == column:
            out[-1] += " " + more["words"]
            continue
        column = None
        if line.strip().startswith("///"):
            above.append(line)
            out.append(line)
            continue
        if field:
            column = line.index("//")
            for code in parts_of(field["code"].strip()):
                out.append("%s%s  ///< %s" % (field["indent"], code, field["words"]))
        elif EQUAL.match(line):
            out += [EQUAL.match(line)[1] + "/// Compares all members.", line] if not above else [line]
        else:
            codes = parts_of(line.strip()) if line.startswith("    ") else [line]
            if len(codes) > 1 and above:
                indent = line[:len(line) - len(line.lstrip())]
                out.append(indent + codes[0])
                for code in codes[1:]:
                    out += above + [indent + code]
            else:
                out.append(line)
        above = []
    return "\n".join(out) + "\n"


CASES = (
    ("    int a = 0;  // text\n", "    int a = 0;  ///< text\n"),
    ("    int a = 0, b = 1;  // text\n", "    int a = 0;  ///< text\n    int b = 1;  ///< text\n"),
    ("    int a;  // one\n            // two\n", "    int a;  ///< one two\n"),
    ("    none,  // text\n", "    none,  ///< text\n"),
    ("    /// Text.\n    int a = 0, b = 0;\n", "    /// Text.\n    int a = 0;\n    /// Text.\n    int b = 0;\n"),
    ("    f(a, b);\n", "    f(a, b);\n"),
    ("    bool operator==(const A&) const = default;\n",
     "    /// Compares all members.\n    bool operator==(const A&) const = default;\n"),
    ("    double a = 0.9;      // text\n", "    double a = 0.9;  ///< text\n"),
    ("    // alone\n", "    // alone\n"),
)


def main(arguments):
    if arguments == ["--self-test"]:
        wrong = [case for case in CASES if filtered(case[0]) != case[1]]
        print(*[(case, filtered(case[0])) for case in wrong], "%d cases, %d wrong" % (len(CASES), len(wrong)), sep="\n")
        return 1 if wrong else 0
    with open(arguments[0], encoding="utf-8") as file:
        sys.stdout.write(filtered(file.read()))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
