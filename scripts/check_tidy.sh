#!/usr/bin/env bash
# Fails if clang-tidy has a finding (.clang-tidy says of which checks) in the library or the format, as the clang
# preset compiles them: `cmake --preset clang` comes before. Takes the files to look at, or none for all.
set -euo pipefail
cd "$(dirname "$0")/.."

commands=build/clang/compile_commands.json
[ -f "$commands" ] || { echo "$commands is missing: cmake --preset clang" >&2; exit 1; }
if [ $# -eq 0 ]; then
    mapfile -t files < <(grep -o "\"file\": \"$PWD/\(src\|format\)/[^\"]*\.cpp\"" "$commands" | cut -d'"' -f4 | sort -u)
    set -- "${files[@]}"
fi
[ $# -gt 0 ] || { echo "no file to look at in $commands" >&2; exit 1; }
printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 --quiet -p build/clang
