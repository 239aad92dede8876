#!/usr/bin/env bash
# oldest_system.sh FILE...: the oldest glibc and libstdc++ that all of these libraries and programs run on together, by
# the versions of the symbols that they ask for. Of any architecture.
set -euo pipefail

[ $# -gt 0 ] || { echo "usage: oldest_system.sh FILE..." >&2; exit 2; }

for file in "$@"; do readelf --dyn-syms --wide "$file"; done | awk '
    function newer(version, than,    a, b, i, n) {
        n = split(version, a, "."); split(than, b, ".")
        for (i = 1; i <= n; ++i) if (a[i] + 0 != b[i] + 0) return a[i] + 0 > b[i] + 0
        return 0
    }
    $7 == "UND" && match($8, /@(GLIBC|GLIBCXX)_[0-9.]+$/) {
        split(substr($8, RSTART + 1), part, "_")
        if (newer(part[2], most[part[1]])) most[part[1]] = part[2]
    }
    END {
        if (!most["GLIBC"]) { print "no symbol of glibc" > "/dev/stderr"; exit 1 }
        print "glibc " most["GLIBC"] ", " (most["GLIBCXX"] ? "libstdc++ GLIBCXX_" most["GLIBCXX"] : "no libstdc++")
    }'
