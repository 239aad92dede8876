#!/usr/bin/env bash
# compare_builds.sh BEFORE AFTER [MESH...]: whether two builds of the library write the same index files and give the same
# answers, bit for bit. BEFORE and AFTER are build folders (build/release) or installed prefixes, of this commit, another
# one or another compiler. A MESH is a mesh file, the name of one in the folder GEOIDX_MESHES (default ../shared/meshes),
# or `stress`: small meshes of every kind that is hard on distances, from AFTER's tests/geoidx_stress_meshes. Without
# any: armadillo spot teapot stress. Prints a line for each mesh and engine, and exits with 1 where anything differs.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

usage() { sed -n '2,/^set/s/^# //p' "$0" >&2; exit 2; }
stop() { echo "$1" >&2; exit 2; }
[ $# -ge 2 ] || usage
before=$1
after=$2
shift 2
[ $# -gt 0 ] || set -- armadillo spot teapot stress

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
differences=0
compared=0

# Prints the folder of a build's shared library.
libraries_of() {
    local folder
    for folder in "$1/src" "$1/lib" "$1"/lib/*-linux-gnu; do
        [ -e "$folder/libgeoidx.so" ] && { realpath "$folder"; return; }
    done
    return 1
}

# Prints the files of what the command line calls a mesh.
files_of() {
    if [ "$1" = stress ]; then
        mkdir -p "$work/stress"
        "$after/tests/geoidx_stress_meshes" "$work/stress" 4 || stop "$after has no tests/geoidx_stress_meshes"
        ls "$work"/stress/*.obj
    elif [ -f "$1" ]; then
        echo "$1"
    else
        local file=${GEOIDX_MESHES:-$root/../shared/meshes}/$1.obj
        [ -f "$file" ] || stop "there is no mesh '$1', nor $file"
        echo "$file"
    fi
}

# run SIDE COMMAND...: COMMAND with the library of BEFORE or AFTER; says which side fails.
run() {
    local libraries=$before_libraries
    [ "$1" = before ] || libraries=$after_libraries
    LD_LIBRARY_PATH=$libraries "${@:2}" 2>"$work/error.txt" && return
    echo "    $1 fails: $(head -n 1 "$work/error.txt")"
    return 1
}

# The index that a side builds, and what the side answers from it.
make_side() { # SIDE FOLDER MESH ENGINE
    run "$1" "$2/bin/geoidx" build "$3" --engine "$4" -o "$work/$1.geoidx" >"$work/built.txt" || { cat "$work/built.txt"; return 1; }
    run "$1" "$work/answers" "$work/$1.geoidx" >"$work/$1.txt" || { cat "$work/$1.txt"; return 1; }
}

verdict() { if cmp -s "$work/before.$1" "$work/after.$1"; then echo equal; else echo DIFFERENT; fi; }

# How much of the files differs, from which byte on (0 is the first).
describe_files() {
    cmp -l "$work"/{before,after}.geoidx >"$work/bytes.txt" 2>/dev/null || true
    echo "    $(wc -c <"$work/before.geoidx") and $(wc -c <"$work/after.geoidx") bytes;" \
        "$(wc -l <"$work/bytes.txt") differ, first byte $(awk 'NR == 1 { print $1 - 1 }' "$work/bytes.txt")"
}

compare() { # MESH ENGINE
    local name file=DIFFERENT answers=DIFFERENT reason=
    name=$(basename "$1")
    rm -f "$work"/{before,after}.{geoidx,txt}
    compared=$((compared + 1))
    if reason=$(make_side before "$before" "$1" "$2" && make_side after "$after" "$1" "$2"); then
        file=$(verdict geoidx)
        answers=$(verdict txt)
    fi
    printf '%-28s %-8s file %s, answers %s\n' "$name" "$2" "$file" "$answers"
    [ -z "$reason" ] || echo "$reason"
    if [ "$file" = equal ] && [ "$answers" = equal ]; then return; fi
    differences=$((differences + 1))
    [ -n "$reason" ] || [ "$file" = equal ] || describe_files
    [ -n "$reason" ] || diff "$work/before.txt" "$work/after.txt" | sed -n 's/^[<>]/    &/p' || true
}

before_libraries=$(libraries_of "$before") || stop "there is no libgeoidx.so in $before"
after_libraries=$(libraries_of "$after") || stop "there is no libgeoidx.so in $after"
for build in "$before" "$after"; do
    [ -x "$build/bin/geoidx" ] || stop "there is no bin/geoidx in $build"
done
cc -std=c99 "$root/tests/cross/answers.c" -I"$root/include" -L"$after_libraries" -lgeoidx -o "$work/answers"

for mesh in "$@"; do
    files_of "$mesh" >"$work/meshes.txt"
    while read -r file <&3; do
        for engine in overlay graph; do compare "$file" "$engine"; done
    done 3<"$work/meshes.txt"
done
echo "$compared compared, $differences different"
[ "$differences" -eq 0 ]
