#!/usr/bin/env bash
# From nothing to a picture: installs what is missing, builds build/release, indexes the Stanford bunny, answers a
# few queries beside exact distances and draws a distance field. Results are in build/quickstart.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target geoidx_tool

tool=build/release/bin/geoidx
out=build/quickstart
mesh=/usr/share/glmark2/models/bunny.obj
mkdir -p "$out"

echo "indexing $mesh"
"$tool" build "$mesh" -o "$out/bunny.geoidx"
"$tool" info "$out/bunny.geoidx"
echo
echo "single source, single destination: index, exact, relative error"
"$tool" sssd "$out/bunny.geoidx" 100 20000 5000 30000 12345 31000 --exact "$mesh"
echo
"$tool" msad "$out/bunny.geoidx" 100 -o "$out/bunny.f32" --png "$out/bunny.png" --mesh "$mesh"
echo "all distances from vertex 100: $out/bunny.f32, as a picture: $out/bunny.png"
