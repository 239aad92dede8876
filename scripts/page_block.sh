#!/usr/bin/env bash
# page_block.sh PAGE HEADING LANGUAGE [NUMBER]: prints the first (or NUMBER-th) code block of that language below that
# heading of a Markdown page, so that a test runs the very lines that the page shows. It fails when there is none.
set -euo pipefail
awk -v heading="## $2" -v fence="\`\`\`$3" -v wanted="${4:-1}" '
    inside && $0 == "```" { exit }
    inside { print; found = 1; next }
    /^```/ && !other { if (below && $0 == fence && ++seen == wanted) inside = 1; else other = 1; next }
    $0 == "```" { other = 0; next }
    !other && /^## / { below = $0 == heading }
    END { exit !found }' "$1" || { echo "$1: there is no such block: $*" >&2 && exit 1; }
