#!/usr/bin/env bash
# compare_builds_test.sh BUILD WORK: that scripts/compare_builds.sh calls a build equal to itself, and notices another
# file, other answers and a build that fails, each by itself. Works in the folder WORK.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2"

fail() { echo "FAILED: $1"; cat out.txt; exit 1; }

# compare STATUS BEFORE AFTER MESH: what the script prints about them is in out.txt.
compare() {
    local status=0
    "$here/../../scripts/compare_builds.sh" "${@:2}" >out.txt 2>&1 || status=$?
    [ "$status" -eq "$1" ] || fail "'${*:2}' exits with $status, not $1"
}
says() { grep -qE -- "$1" out.txt || fail "'$1' is not said"; }

# fake_build FOLDER: another build folder with this build's library. A tool is still to be given.
fake_build() {
    mkdir -p "$1/bin" "$1/src"
    cp -P "$build"/src/libgeoidx.so* "$1/src/"
}
tool() { # FOLDER LINE: the tool of a build that was faked, a script of this line
    printf '#!/bin/sh\n%s\n' "$2" >"$1/bin/geoidx"
    chmod +x "$1/bin/geoidx"
}

# A bent grid of 30 x 20 vertices.
awk 'BEGIN { for (y = 0; y < 20; ++y) for (x = 0; x < 30; ++x) print "v", x, y, x * x / 40
             for (y = 0; y < 19; ++y) for (x = 1; x < 30; ++x) {
                 a = 30 * y + x; print "f", a, a + 1, a + 31; print "f", a, a + 31, a + 30 } }' >grid.obj

compare 0 "$build" "$build" "$PWD/grid.obj"
says '^grid.obj +overlay +file equal, answers equal$'
says '^grid.obj +graph +file equal, answers equal$'
says '^2 compared, 0 different$'

# Such a delta prunes nothing, but the file states it.
fake_build other_file
tool other_file "exec '$build/bin/geoidx' \"\$@\" \$([ \"\$1\" = build ] && echo --delta 1e-9)"
compare 1 "$build" other_file grid.obj
says 'overlay +file DIFFERENT, answers equal$'
says '^    [0-9]+ and [0-9]+ bytes; [1-9][0-9]* differ, first byte [0-9]+$'
says 'graph +file DIFFERENT, answers equal$'
says '^2 compared, 2 different$'

# One bit of the last pair is another one: this library stands before the true one, which has another name.
fake_build other_answers
tool other_answers "LD_LIBRARY_PATH= exec '$build/bin/geoidx' \"\$@\""
LC_ALL=C sed 's/libgeoidx\.so\.0/libgeoidX.so.0/g' "$build/src/libgeoidx.so" >other_answers/src/libgeoidX.so.0
rm other_answers/src/libgeoidx.so*
cat >one_bit.c <<'C'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <geoidx.h>

GEOIDX_API geoidx_status geoidx_sssd_batch(const geoidx* index, const uint32_t* pairs, uint64_t count, float* distances) {
    geoidx_status (*next)(const geoidx*, const uint32_t*, uint64_t, float*);
    *(void**)&next = dlsym(RTLD_NEXT, "geoidx_sssd_batch");
    const geoidx_status status = next(index, pairs, count, distances);
    ((uint32_t*)distances)[count - 1] ^= 1;
    return status;
}
C
cc -shared -fPIC -fno-strict-aliasing -Wl,-soname,libgeoidx.so.0 -Wl,--no-as-needed one_bit.c -I"$here/../../include" \
    other_answers/src/libgeoidX.so.0 -o other_answers/src/libgeoidx.so.0
ln -s libgeoidx.so.0 other_answers/src/libgeoidx.so
compare 1 other_answers "$build" grid.obj
says 'overlay +file equal, answers DIFFERENT$'
says 'graph +file equal, answers DIFFERENT$'
[ "$(grep -c '^    [<>] ' out.txt)" -eq "$(grep -c '^    [<>] sssd' out.txt)" ] || fail "more than pairs differ"

fake_build failing
tool failing "echo 'geoidx: build: no idea' >&2; exit 1"
compare 1 "$build" failing grid.obj
says 'file DIFFERENT, answers DIFFERENT$'
says '^    after fails: geoidx: build: no idea$'
compare 1 failing failing grid.obj # nothing was compared, so that nothing is equal

compare 2 "$build" "$build" no_such_mesh
compare 2 "$build" "$PWD" grid.obj
compare 2 "$build"
echo "equal builds are equal; another file, other answers and failures are noticed"
