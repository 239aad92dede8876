#!/usr/bin/env bash
# test_page.sh FOLDER: does in FOLDER, which it makes anew, what README.md and the C# lines of the main README.md tell a
# new user to do, by the very lines that they show, and expects the distance that their comments state. This begins with
# a clone of what is committed, whose native library is built. With GEOIDX_NATIVE, the folder of a library that is built,
# it is these sources instead, and the lines that build are left out.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: test_page.sh FOLDER" >&2 && exit 2; }
root=$(cd "$(dirname "$0")/../.." && pwd)
page=$root/bindings/csharp/README.md
rm -rf "$1"
mkdir -p "$1"
folder=$(cd "$1" && pwd)
export NUGET_PACKAGES=$folder/nuget # a package of this version that was kept from earlier is another one

install() {
    if [ -n "${GEOIDX_NATIVE:-}" ]; then
        ln -s "$root" "$folder/geoidx"
    else
        git clone -q "$root" "$folder/geoidx"
        "$root/scripts/page_block.sh" "$page" Install sh 1
    fi >"$folder/install.sh"
    "$root/scripts/page_block.sh" "$page" Install sh 2 >>"$folder/install.sh"
    (cd "$folder" && bash -euo pipefail install.sh)
}

run_lines() { # PAGE HEADING
    local program=$folder/square/Program.cs expected
    "$root/scripts/page_block.sh" "$1" "$2" csharp >"$program"
    expected=$(sed -n 's|.*Console.WriteLine(index.Distance(0, 2)); *// \([0-9.]*\),.*|\1|p' "$program")
    [ -n "$expected" ] || { echo "$1: no distance is stated" >&2 && exit 1; }
    rm -f "$folder/square/square.geoidx"
    (cd "$folder/square" && dotnet run) | tee "$folder/output.txt"
    grep -qx "$expected" "$folder/output.txt" || { echo "$1: expected $expected" >&2 && exit 1; }
    [ -s "$folder/square/square.geoidx" ]
}

install
run_lines "$page" "Ten lines"
run_lines "$root/README.md" "Ten lines of C#"
echo "The lines of the pages work."
