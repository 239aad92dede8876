#!/usr/bin/env bash
# abi_test.sh LIBRARY: that the shared library exports what exported.txt lists, needs nothing but the C and C++ run
# time, and has the interface of baseline.abi. After a change that is meant, with GEOIDX_ABI_VERSION raised where
# old programs break: abi_test.sh LIBRARY --update.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
library=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
exported() { nm -D --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort; }

# A library of pointers to all functions: their types, as C has them, and nothing of what is inside.
pointers=$work/libpointers.so
{
    echo '#include "geoidx.h"'
    exported | sed 's/.*/__typeof__(&)* pointer_to_&;/'
} | cc -std=gnu99 -g -shared -fPIC -I"$here/../../include" -x c - -o "$pointers"

if [ "${2:-}" = --update ]; then
    exported >"$here/exported.txt"
    abidw --no-corpus-path --no-comp-dir-path --no-show-locs --out-file "$here/baseline.abi" "$pointers"
    exit
fi

diff "$here/exported.txt" <(exported) || fail "the exported symbols are not those of exported.txt"

for name in $(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
    case $name in
    libc.so.* | libm.so.* | libgcc_s.so.* | libstdc++.so.* | ld-linux*) ;;
    *) fail "the library needs $name" ;;
    esac
done
loaded=$(LC_ALL=C ldd "$library")
if grep -E 'not found|png|zstd|libz\.|xxhash' <<<"$loaded"; then fail "ldd shows what is to be linked in"; fi

abidiff "$here/baseline.abi" "$pointers" || fail "the interface is not that of baseline.abi"
echo "symbols, libraries and interface: as laid down"
