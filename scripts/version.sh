#!/usr/bin/env bash
# version.sh: prints the version, which include/geoidx.h states and everything else reads there.
set -euo pipefail
header=$(dirname "$0")/../include/geoidx.h
part() { sed -n "s/^#define GEOIDX_VERSION_$1 \([0-9]*\)$/\1/p" "$header"; }
echo "$(part MAJOR).$(part MINOR).$(part PATCH)"
