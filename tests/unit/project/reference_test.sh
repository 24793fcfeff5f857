#!/usr/bin/env bash
# The reference of the public headers has no warning; a field without a comment makes one.
# usage: reference_test.sh ROOT
set -uo pipefail
cd -- "$1" || exit 1
command -v doxygen >/dev/null || { echo "skipped: doxygen is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export GNOMON_VERSION=0 GNOMON_DOCS_OUT=$work/out GNOMON_DOCS_ERRORS=YES
failed=0

# made LINE...: the reference by the project's settings and these lines.
made() { { cat docs/doxygen/Doxyfile; printf '%s\n' "$@"; } | doxygen - 2>&1; }

made || { echo "FAILED: the headers make warnings"; failed=1; }
[[ -s $work/out/html/structgnomon_1_1LightShadow.html ]] || { echo "FAILED: there is no page of LightShadow"; failed=1; }
grep -q 'Largest allowed error' "$work/out/html/structgnomon_1_1LightShadow.html" || { echo "FAILED: a field's comment is lost"; failed=1; }
printf '/// A thing.\nnamespace thing {\n/// A part.\nstruct Part {\n    int known = 0;  // documented\n%s};\n}\n' \
    >"$work/good.h" ''
made "INPUT=$work/good.h" >"$work/said" || { cat "$work/said"; echo "FAILED: a good header makes a warning"; failed=1; }
printf '/// A thing.\nnamespace thing {\n/// A part.\nstruct Part {\n    int known = 0;  // documented\n%s};\n}\n' \
    >"$work/bad.h" $'    int unknown = 0;\n'
made "INPUT=$work/bad.h" >"$work/said" && { echo "FAILED: a field without a comment makes no warning"; failed=1; }
grep -q 'unknown' "$work/said" || { cat "$work/said"; echo "FAILED: the field is not named"; failed=1; }
python3 docs/doxygen/trailing_comments.py --self-test || failed=1
exit "$failed"
