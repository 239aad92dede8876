#!/usr/bin/env bash
# make.sh LIBRARY FOLDER: what the tests take from C. Into FOLDER go header.txt (layouts, constants and functions of
# geoidx.h as the C compiler sees them), square.geoidx (an index built and saved from C), and two libraries that are not
# geoidx: one of another version, and one where opening fails with an internal error.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
include=$here/../../../../include
library=$1
out=$2
mkdir -p "$out"

facts() {
    local flat
    flat=$(cc -E -P "$include/geoidx.h" | tr -s '\n ' ' ')
    grep -oE 'typedef struct geoidx_[a-z_]+ \{[^}]*\}' <<<"$flat" | awk '{
        struct = $3
        printf "printf(\"struct %s %%zu\\n\", sizeof(%s));\n", struct, struct
        sub(/^[^{]*\{/, ""); sub(/\}$/, "")
        count = split($0, fields, ";")
        for (i = 1; i < count; ++i) {
            field = fields[i]
            if (field ~ /\(\*/) { sub(/.*\(\*/, "", field); sub(/\).*/, "", field) }
            else { sub(/\[.*/, "", field); sub(/.*[ *]/, "", field) }
            printf "printf(\"field %s %s %%zu %%zu\\n\", offsetof(%s, %s), sizeof(((%s*)0)->%s));\n",
                   struct, field, struct, field, struct, field
        } }'
    grep -oE 'GEOIDX_[A-Z_]+ = ' <<<"$flat" | awk '{ printf "printf(\"constant %s %%d\\n\", %s);\n", $1, $1 }'
    grep -oE 'visibility\("default"\)\)\)[^(]*\(' <<<"$flat" | # what is exported, not what is inline
        grep -oE 'geoidx_[a-z_]+\($' | awk '{ sub(/\(/, ""); printf "printf(\"function %s\\n\");\n", $1 }'
}

{
    printf '#include <stddef.h>\n#include <stdio.h>\n#include "geoidx.h"\nint main(void) {\n'
    facts
    printf 'printf("version %%d\\n", GEOIDX_VERSION_MAJOR * 10000 + GEOIDX_VERSION_MINOR * 100 + GEOIDX_VERSION_PATCH);\n'
    printf 'printf("constant GEOIDX_NO_SOURCE %%d\\n", (int)GEOIDX_NO_SOURCE);\n'
    printf 'return 0;\n}\n'
} >"$out/header.c"
cc -I"$include" -o "$out/header" "$out/header.c"
"$out/header" >"$out/header.txt"

cc -I"$include" -o "$out/square" "$here/square.c" -ldl
"$out/square" "$library" "$out/square.geoidx"

fake() { cc -I"$include" -shared -fPIC -o "$out/$1" "$here/fake.c" "-DFAKE_VERSION=$2"; }
fake libgeoidx-other.so 990102
fake libgeoidx-failing.so 'GEOIDX_VERSION_MAJOR * 10000 + GEOIDX_VERSION_MINOR * 100 + GEOIDX_VERSION_PATCH'
