#!/usr/bin/env bash
# Tests the launcher with stand-ins for apt-get, dpkg-query, sudo, cmake, ninja: nothing is installed or built.
# usage: launcher_test.sh LAUNCHER
set -uo pipefail

launcher=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
project="$work/a folder with spaces"
calls=$work/calls
failures=0

# A copy with a package list of its own, and a folder of stand-ins that note how they were called.
mkdir -p "$project" "$work/bin" "$work/elsewhere"
cp "$launcher" "$project/gnomon"
echo '{}' >"$project/CMakePresets.json"
echo "project(Gnomon VERSION 1.2.3)" >"$project/CMakeLists.txt"
printf '%s\n' '# the list' 'here  # is installed' 'older|newer  # one of two is installed' 'absent  # must come' \
    'first|second  # only the second exists' 'slow  # test: for tests only' 'rare  # long: for long runs only' >"$project/packages.txt"

stand_in() { printf '#!/bin/bash\n%s\n' "$2" >"$work/bin/$1"; chmod +x "$work/bin/$1"; }
# dpkg_has NAME...: dpkg-query knows these as installed, and `removed` as known but not installed.
dpkg_has() {
    stand_in dpkg-query "for name in \"\$@\"; do case \" $* \" in *\" \$name \"*) echo \"\$name installed\" ;; esac; done
        echo \"removed not-installed\"; exit 1"
}
dpkg_has here newer
stand_in apt-cache 'case ${@: -1} in first) echo "  Candidate: (none)" ;; *) echo "  Candidate: 1.0" ;; esac'
stand_in apt-get 'echo "apt-get $*" >>"$CALLS"; exit "${APT_STATUS:-0}"'
stand_in sudo 'echo "sudo" >>"$CALLS"; exec "$@"'
stand_in id 'echo "${FAKE_UID:-0}"'
stand_in cmake 'case $1 in --version) echo "cmake version ${CMAKE_IS:-3.25.1}" ;;
    *) echo "cmake $*" >>"$CALLS"
       mkdir -p "$PROJECT/build/release/bin" "$PROJECT/build/asan" && touch "$PROJECT/build/release/build.ninja"
       printf "#!/bin/bash\necho \"\$PWD|\$#|\$*\"\nexit \${GAME_STATUS:-0}\n" >"$PROJECT/build/release/bin/gnomon_game"
       chmod +x "$PROJECT/build/release/bin/gnomon_game"
       printf "[1/4] a.cpp\n[2/4] b.cpp\n"; sleep "${BUILD_TAKES_S:-0}"
       echo "compiler says no"; exit "${BUILD_STATUS:-0}" ;; esac'
stand_in ninja 'echo "${NINJA_SAYS:-}"'

# run NAME=VALUE... -- ARGUMENTS: the launcher from another folder; sets status, out, err.
run() {
    local -a settings=()
    while [[ $1 != -- ]]; do settings+=("$1"); shift; done
    shift
    : >"$calls"
    out=$(cd "$work/elsewhere" && env -u GNOMON_SKIP_DEPS -u GNOMON_TEST_SEED -u GNOMON_SLOWEST_S -u GNOMON_PROGRESS_S -u GNOMON_LONG -u GNOMON_WARNINGS_AS_ERRORS -u CC -u CXX PATH="$work/bin:$PATH" CALLS="$calls" PROJECT="$project" \
        "${settings[@]}" "$project/gnomon" "$@" 2>"$work/err")
    status=$?
    err=$(<"$work/err")
}
expect() {
    local what=$1
    shift
    if ! "$@"; then
        printf 'FAILED: %s\n  status %s\n  out: %s\n  err: %s\n  calls: %s\n' "$what" "$status" "$out" "$err" "$(<"$calls")"
        failures=$((failures + 1))
    fi
}
called() { grep -qF -- "$1" "$calls"; }
not_called() { ! called "$1"; }
is() { [[ $1 == "$2" ]]; }
has() { [[ $1 == *"$2"* ]]; }
not_has() { ! has "$@"; }

run -- ; expect "no arguments print the usage" is "$status" 0; expect "usage on stdout" has "$out" "usage: gnomon"
run -- help; expect "help succeeds" is "$status" 0
run -- dance; expect "an unknown command is status 2" is "$status" 2; expect "and is named" has "$err" dance
run -- bench; expect "bench without a word is status 2" is "$status" 2

run -- deps
expect "deps succeeds" is "$status" 0
expect "lists are read first" called "apt-get -o DPkg::Lock::Timeout=300 update"
expect "only what is missing comes, the existing name of two" \
    called "install -y --no-install-recommends absent second slow rare"
expect "root needs no sudo" not_called sudo

run FAKE_UID=1000 -- deps
expect "others use sudo" called sudo
run APT_STATUS=100 -- deps
expect "a failed installation fails" is "$status" 1

dpkg_has here older newer absent first second slow rare
run -- deps
expect "nothing missing: apt-get is left alone" is "$(<"$calls")" ""
expect "and nothing is said" is "$err" ""
printf '%s\n' 'removed  # was here once' >>"$project/packages.txt"
run -- deps
expect "a package that was removed must come" called "--no-install-recommends removed"
sed -i '$d' "$project/packages.txt"
dpkg_has here older newer absent first second
run -- play
expect "play installs nothing that only tests need" not_called apt-get

run GNOMON_SKIP_DEPS=1 -- play --frames 3 "a b"
expect "play runs the game in the caller's folder with its flags" is "$out" "$work/elsewhere|3|--frames 3 a b"
run GAME_STATUS=7 -- play
expect "play passes the game's status on" is "$status" 7
cp "$project/build/release/bin/gnomon_game" "$project/build/release/bin/gnomon_bench"
run GNOMON_SKIP_DEPS=1 GAME_STATUS=1 -- check --json "a b"
expect "check is the bench's, with its flags" is "$out" "$work/elsewhere|3|check --json a b"
expect "check passes its verdict on" is "$status" 1
stand_in python3 'echo "python3 $*"'
for sweep in '--sweep full' --sweep=quick --quick; do
    run GNOMON_SKIP_DEPS=1 -- bench accuracy $sweep --out "a b"
    expect "$sweep: the bench measures" has "$out" "|accuracy $sweep --out a b"
    expect "$sweep: the script makes the report, with its flags" \
        has "$out" "python3 $project/bench/sweep/report.py accuracy $sweep --out a b"
done
run GNOMON_SKIP_DEPS=1 GAME_STATUS=2 -- bench accuracy --quick
expect "a sweep that fails passes its status on" is "$status" 2
expect "and has no report" not_has "$out" report.py
run GNOMON_SKIP_DEPS=1 -- bench accuracy --json quick
expect "other measurements have none" not_has "$out" report.py
run GNOMON_SKIP_DEPS=1 -- bench frame --markdown "a page.md" --rounds 2
expect "a page gets the stamp of the command" has "$out" \
    "generate_pages.py --bin $project/build/release/bin --stamp a page.md -- bench frame --markdown a page.md --rounds 2"
run GNOMON_SKIP_DEPS=1 GAME_STATUS=2 -- bench frame --markdown page.md
expect "a measurement that fails stamps nothing" not_has "$out" --stamp
run GNOMON_SKIP_DEPS=1 -- docs --check
expect "docs --check compares the pages" has "$out" "generate_pages.py --bin $project/build/release/bin --check"
stand_in doxygen 'echo "doxygen $* to ${GNOMON_DOCS_OUT#"$PROJECT"} errors=$GNOMON_DOCS_ERRORS" >>"$CALLS"; exit "${DOXYGEN_STATUS:-0}"'
stand_in xdg-open 'echo "xdg-open ${1#"$PROJECT"}" >>"$CALLS"'
run GNOMON_SKIP_DEPS=1 -- docs
expect "docs builds the reference, in the project's folder" called "doxygen docs/doxygen/Doxyfile to /build/docs errors=YES"
expect "and opens it" called "xdg-open /build/docs/html/index.html"
run GNOMON_SKIP_DEPS=1 -- docs --print
expect "docs --print opens nothing" not_called xdg-open
expect "but says where it is" has "$err" "build/docs/html/index.html"
run GNOMON_SKIP_DEPS=1 DOXYGEN_STATUS=1 -- docs
expect "a warning of the reference is status 1" is "$status" 1
expect "and opens nothing" not_called xdg-open
run -- docs --bogus
expect "another flag of docs is status 2" is "$status" 2
run NINJA_SAYS='ninja: no work to do.' -- play
expect "an up-to-date build says nothing" is "$err" ""
expect "and builds nothing" not_called cmake
echo '{"version": 6}' >"$project/CMakePresets.json"
run NINJA_SAYS='ninja: no work to do.' -- play
expect "other presets: it is configured anew" called "--preset release --fresh"
run CXX=other++ NINJA_SAYS='ninja: no work to do.' -- play
expect "another compiler configures afresh" called "--fresh"
run -- play
expect "warnings are no errors for users" called "GNOMON_WARNINGS_AS_ERRORS=OFF"
run GNOMON_WARNINGS_AS_ERRORS=ON NINJA_SAYS='ninja: no work to do.' -- play
expect "but may be" called "GNOMON_WARNINGS_AS_ERRORS=ON"
run GNOMON_PROGRESS_S=1 BUILD_TAKES_S=2.5 -- play
expect "a long build says how far it is" has "$err" "building (release), 2 of 4, 0:0"
expect "and at last how long it took" has "$err" "gnomon: building (release): 0:0"
run BUILD_STATUS=1 -- play
expect "a failed build is status 1" is "$status" 1
expect "a failed build shows its output" has "$err" "compiler says no"
expect "a failed build starts no game" is "$out" ""
rm -rf "$project/build"
run CMAKE_IS=3.22.1 -- play
expect "an old cmake is status 2" is "$status" 2
expect "and is explained" has "$err" "3.25"

dpkg_has here older newer absent first second slow
stand_in ctest 'echo "ctest $* seed=${GNOMON_TEST_SEED:-none} long=${GNOMON_LONG:-no}" >>"$CALLS"
    printf "1/2 Test #1: a ... Passed\n2/2 Test #2: b ...***Failed\n"; sleep "${TESTS_TAKE_S:-0}"; exit "${TESTS_STATUS:-0}"'
stand_in python3 'echo "the summary of $*"'
run -- test -R Aabb
expect "test runs ctest" called "-R Aabb"
expect "on the seed that all runs share" called "seed=none"
expect "without what is long" called "-LE ^long$"
expect "and without sanitizers" not_called asan
expect "and what only long runs need" not_called apt-get
expect "prints the summary" has "$out" "tests-release.xml"
run -- test --seed 7; expect "a seed is passed on" called "seed=7 long=no"
run -- test --seed random
expect "a random seed is printed" has "$err" "again: gnomon test --seed"
expect "and passed on" not_called "seed=random"
run -- test --seed x; expect "a seed that is no number is status 2" is "$status" 2
run -- test --long
expect "long tests are long" called "seed=none long=1"
expect "and bring what they need" called "--no-install-recommends rare"
expect "and run under sanitizers, as long as others" called "asan --output-junit"
run GNOMON_PROGRESS_S=1 TESTS_TAKE_S=2.5 TESTS_STATUS=8 -- test
expect "a failed test fails" is "$status" 1
expect "and is counted while others run" has "$err" "testing (release), 2 of 2, 1 failed"
# The test that is done is a hundredth of the work: half of the tests are not half of the time.
mkdir -p "$project/.ci"
printf '%s\n' 'release slow 1 99' 'release quick 1 1' >"$project/.ci/test_seconds.txt"
stand_in ctest 'if [[ " $* " == *" -N "* ]]; then printf "  Test #1: slow\n  Test #2: quick\n"; exit; fi
    printf "1/2 Test #2: quick ... Passed\n"; sleep "${TESTS_TAKE_S:-0}"; printf "2/2 Test #1: slow ... Passed\n"'
run GNOMON_PROGRESS_S=1 TESTS_TAKE_S=6 -- test
expect "what is left follows what tests took before" has "$err" "about 8:"
run -- test; expect "no limit of seconds for users" not_has "$out" most-s
run GNOMON_SLOWEST_S=60 -- test; expect "but where asked for" has "$out" "--most-s 60"

# Elsewhere: a PATH with the few tools the launcher needs, and no apt-get.
mkdir "$work/bare"
for tool in bash env readlink dirname paste sed mkdir cat; do ln -s "$(command -v "$tool")" "$work/bare/$tool"; done
out=$(env -u GNOMON_SKIP_DEPS -u GNOMON_TEST_SEED -u GNOMON_SLOWEST_S -u GNOMON_PROGRESS_S -u GNOMON_LONG PATH="$work/bare" "$project/gnomon" deps 2>"$work/err"); status=$?; err=$(<"$work/err")
expect "without apt-get deps is status 2" is "$status" 2
expect "and says what to install" has "$err" "here older|newer absent first|second slow rare"

if ((failures > 0)); then exit 1; fi
echo "the launcher keeps its promises"
