#!/usr/bin/env bash
# version_test.sh VERSION: that the version of the build, VERSION, is that of include/geoidx.h; that the bindings which
# mirror the header, and cannot read it, mirror its version and its ABI; and that no other file says which version it is.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { echo "FAILED: $1"; exit 1; }

# mirrors FILE LINE: the file has this line, which a remark may follow.
mirrors() { sed 's| *//.*||' "$1" | grep -xF "$2" >/dev/null || fail "$1 does not say, as geoidx.h does: $2"; }

version=$(scripts/version.sh)
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "scripts/version.sh prints '$version'"
[ "$1" = "$version" ] || fail "the build has the version $1, geoidx.h $version"
IFS=. read -r major minor patch <<<"$version"
abi=$(sed -n 's/^#define GEOIDX_ABI_VERSION \([0-9]*\)$/\1/p' include/geoidx.h)
[ -n "$abi" ] || fail "geoidx.h states no GEOIDX_ABI_VERSION"

python=bindings/python/src/geoidx/_native.py
mirrors $python "HEADER_VERSION = ($major, $minor, $patch)"
mirrors $python "ABI_VERSION = $abi"
csharp=bindings/csharp/Geoidx/GeodesicLibrary.cs
mirrors $csharp "        private const uint Expected = $((major * 10000 + minor * 100 + patch));"
mirrors $csharp "        private const uint ExpectedAbi = $abi;"
grep -q "^## $version\$" CHANGELOG.md || fail "CHANGELOG.md has no part of $version"

others=$(grep -rIlwF "$version" CMakeLists.txt CMakePresets.json README.md bench bindings cmake docs format \
    include scripts src tests tools --exclude-dir={__pycache__,artifacts,bin,build,obj,runtimes}) || [ $? -eq 1 ]
[ -z "$others" ] || fail "the version $version is also written in: $others"
echo "$version: in one place, and mirrored"
