#!/usr/bin/env bash
# Fails where clang-format would change a file; with --fix, changes it.
set -euo pipefail
cd "$(dirname "$0")/.."

mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
find include src format tools bench tests -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cpp' | sort |
    xargs clang-format-14 "${mode[@]}"
