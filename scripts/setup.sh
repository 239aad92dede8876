#!/usr/bin/env bash
# Installs what the build, the tests and the benchmarks need and this machine lacks (Debian 12, with apt-get).
set -euo pipefail

packages=(
    build-essential cmake ninja-build pkg-config
    libeigen3-dev libzstd-dev libpng-dev zlib1g-dev libxxhash-dev
    doctest-dev libcli11-dev libtinyobjloader-dev
    libcgal-dev libgmp-dev libmpfr-dev
    clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14
    glmark2-data abigail-tools
    python3-numpy python3-venv python3-pip python3-setuptools python3-wheel python3-xxhash python3-zstandard mypy
    mono-devel
)

is_installed() { dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed; }

missing=()
for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
echo "installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
