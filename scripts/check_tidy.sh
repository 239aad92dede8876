#!/usr/bin/env bash
# Fails if clang-tidy has a finding (.clang-tidy says of which checks) in the library or the format, as the asan preset
# compiles them, several sources at a time: `cmake --preset asan` comes before.
set -euo pipefail
cd "$(dirname "$0")/.."

commands=build/asan/compile_commands.json
[ -f "$commands" ] || { echo "$commands is missing: cmake --preset asan" >&2; exit 1; }
sources='"file": "[^"]*/build/asan/\(src\|format\)/[^"]*\.cxx"'
mapfile -t files < <(grep -o "$sources" "$commands" | cut -d'"' -f4 | sort -u)
[ ${#files[@]} -gt 0 ] || { echo "no file to look at in $commands" >&2; exit 1; }
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 --quiet -p build/asan
