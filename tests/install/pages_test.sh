#!/usr/bin/env bash
# pages_test.sh BUILD WORK: installs a build by the line that include/README.md shows, and runs the examples of that page
# and of README.md by the very lines that it shows, each in a fresh folder inside of WORK.
set -euo pipefail

source=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
rm -rf "$2"
mkdir -p "$2"
work=$(cd "$2" && pwd)
prefix=$work/prefix
page=$source/include/README.md
ran=0

fail() { echo "FAILED: $1"; exit 1; }

# first_block LANGUAGE PAGE: what the first fenced block of that language holds.
first_block() {
    awk -v fence="\`\`\`$1" '$0 == fence { inside = 1; next } inside && /^```/ { exit } inside' "$2"
}

# page_lines PATTERN: the indented lines of the page that begin so, without remarks and with this prefix.
page_lines() {
    sed -n "/^\`\`\`/,/^\`\`\`/d; s/^    //; t print; d; :print; s/ *# .*//; s#\(^\|[^_]\)PREFIX#\1$prefix#g; /^$1/p" "$page"
}

fresh_folder() {
    ran=$((ran + 1))
    folder=$work/$ran
    mkdir "$folder"
    first_block c "$source/README.md" >"$folder/app.c"
    first_block cpp "$page" >"$folder/app.cpp"
    first_block cmake "$page" >"$folder/CMakeLists.txt"
}

# run_example COMMAND: that it prints the distance that the example says, and leaves the index that it saves.
run_example() {
    fresh_folder
    (cd "$folder" && bash -euo pipefail -c "$1" >out.txt 2>err.txt) || fail "$1: $(cat "$folder/out.txt" "$folder/err.txt")"
    [ "$(tail -n 1 "$folder/out.txt")" = "$distance" ] || fail "$1 prints $(tail -n 1 "$folder/out.txt"), not $distance"
    [ -s "$folder/square.geoidx" ] || fail "$1 saves no index"
}

# run_examples PATTERN COUNT: all lines of the page that begin so, of which there are to be COUNT.
run_examples() {
    local commands
    mapfile -t commands < <(page_lines "$1")
    [ "${#commands[@]}" -eq "$2" ] || fail "${#commands[@]} lines of $page begin with '$1', not $2"
    for command in "${commands[@]}"; do run_example "$command"; done
}

distance=$(first_block c "$source/README.md" | sed -n 's#.*/\* \([0-9.]*\) \*/.*#\1#p')
[ -n "$distance" ] || fail "the example of README.md does not say what it prints"
grep -qF "// $distance" <<<"$(first_block cpp "$page")" || fail "the example of $page does not say that it prints $distance"

install=$(page_lines 'cmake --install ')
[ -n "$install" ] || fail "$page does not say how to install"
(cd "$work" && eval "${install/build\/release/\"\$build\"}" >/dev/null)

eval "$(page_lines 'export ')"
[ -d "$PKG_CONFIG_PATH" ] || fail "$page names a folder for pkg-config that is not there"
run_examples 'cc ' 4
run_examples 'c++ ' 1
run_examples 'cmake -B ' 1
echo "$ran examples run as the pages show"
