#!/usr/bin/env bash
# Builds and tests bindings/csharp and bindings/unity into build/csharp, against the libgeoidx.so in the folder that
# GEOIDX_NATIVE names (default: build/release/src). Without .NET or Mono, what needs them is skipped, which is said.
#   --pack        packs the NuGet package into build/csharp/packages instead, without a test
#   --pack-unity  packs the Unity package into build/csharp/unity instead, without a test or .NET
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-} in
'' | --pack | --pack-unity) [ $# -le 1 ] || { echo "too many arguments: $*" >&2 && exit 2; } ;;
*) echo "usage: test_csharp.sh [--pack|--pack-unity]" >&2 && exit 2 ;;
esac

if [ "${1:-}" != --pack-unity ] && ! command -v dotnet >/dev/null; then
    [ "${1:-}" != --pack ] || { echo "the .NET SDK is missing" >&2 && exit 1; }
    echo "SKIPPED: .NET SDK is missing"
    exit 0
fi

GEOIDX_NATIVE=$(realpath -m "${GEOIDX_NATIVE:-build/release/src}")
if [ ! -e "$GEOIDX_NATIVE/libgeoidx.so" ]; then
    echo "there is no $GEOIDX_NATIVE/libgeoidx.so: build the shared library, or set GEOIDX_NATIVE:" >&2
    echo "    cmake --preset release && cmake --build --preset release --target geoidx" >&2
    exit 1
fi
export GEOIDX_NATIVE DOTNET_NOLOGO=1 DOTNET_CLI_TELEMETRY_OPTOUT=1 MSBUILDDISABLENODEREUSE=1
unset GEOIDX_LIBRARY
out=$PWD/build/csharp
csharp=bindings/csharp
mono_tests=$out/artifacts/bin/Geoidx.Tests.Mono/release/Geoidx.Tests.dll
quiet=(--nologo -v quiet)

fill_runtimes() {
    local architecture
    case $(uname -m) in
    x86_64) architecture=x64 ;;
    aarch64) architecture=arm64 ;;
    *) echo "unknown machine $(uname -m)" >&2 && exit 1 ;;
    esac
    mkdir -p "$csharp/runtimes/linux-$architecture/native"
    cp -Lp "$GEOIDX_NATIVE/libgeoidx.so" "$csharp/runtimes/linux-$architecture/native"
}

# Other platforms' libraries are what scripts/cross.sh left, whenever that was.
say_runtimes() {
    local library age
    for library in "$csharp"/runtimes/*/native/*; do
        age=
        [ -z "$(find include src format -name '*.[ch]*' -newer "$library" -print -quit)" ] || age=", OLDER THAN THE SOURCES"
        echo "packed: ${library#"$csharp"/runtimes/}, built $(date -r "$library" '+%F %R')$age"
    done
}

refuses_a_package_without_libraries() {
    local message
    message=$(dotnet pack "$csharp/Geoidx" -c Release --no-build --nologo "-p:GeoidxRuntimes=$out/no-runtimes" \
        -o "$out/empty-packages") && return 1
    grep -q 'Run scripts/test_csharp.sh' <<<"$message"
}

check_licences() { # FOLDER
    cmp LICENSE "$1/LICENSE"
    cmp THIRD-PARTY-NOTICES.txt "$1/THIRD-PARTY-NOTICES.txt"
}

pack() { # [OPTION]
    rm -rf "$out/packages"
    say_runtimes
    dotnet pack "$csharp/Geoidx" -c Release "$@" "${quiet[@]}" -o "$out/packages"
}

test_package() {
    rm -rf "$out"/{consumer-packages,artifacts/bin/Geoidx.Consumer}
    refuses_a_package_without_libraries
    pack --no-build
    dotnet build "$csharp/Geoidx.Consumer" -c Release --force "${quiet[@]}"
    dotnet "$out/artifacts/bin/Geoidx.Consumer/release/Geoidx.Consumer.dll"
    check_licences "$out"/consumer-packages/geoidx/*
    diff -r "$csharp/runtimes" "$out"/consumer-packages/geoidx/*/runtimes
}

check_identities() {
    local twice
    twice=$(grep -rh --include='*.meta' '^guid: ' "$1" | sort | uniq -d)
    [ -z "$twice" ] || { echo "assets of the Unity package share an identity: $twice" >&2 && exit 1; }
}

# The assembly that Mono and Unity take, on .NET.
test_netstandard_on_dotnet() {
    dotnet exec --runtimeconfig "$out/artifacts/bin/Geoidx.Tests/release/Geoidx.Tests.runtimeconfig.json" "$mono_tests"
}

refuses_a_unity_package_without_libraries() {
    local message
    mkdir -p "$out/empty-unity"
    touch "$out/empty-unity/com.geoidx-0.0.0.tgz"
    message=$(GEOIDX_RUNTIMES=$out/no-runtimes bindings/unity/pack.sh "$out/empty-unity" 2>&1) && return 1
    grep -q 'Run scripts/test_csharp.sh --pack-unity' <<<"$message"
    [ -z "$(find "$out/empty-unity" -name '*.tgz')" ]
}

# An assembly that is left out on a platform takes the scripts that use it with it.
compiles_everywhere() {
    local definition
    for definition in Runtime/Geoidx Samples~/ColourByDistance/Geoidx.Samples.ColourByDistance \
        Samples~/WalkAlongSurface/Geoidx.Samples.WalkAlongSurface; do
        grep -q '"includePlatforms": \[\]' "$GEOIDX_UNITY_OUT/package/$definition.asmdef"
        grep -q '"excludePlatforms": \[\]' "$GEOIDX_UNITY_OUT/package/$definition.asmdef"
    done
}

take_unity_page() {
    mkdir -p "$GEOIDX_UNITY_OUT/page"
    for heading in "Ten lines" Jobs; do
        { echo '#nullable disable' && scripts/page_block.sh bindings/unity/README.md "$heading" csharp; } \
            >"$GEOIDX_UNITY_OUT/page/${heading// /}.cs"
    done
}

compile_unity() {
    export GEOIDX_UNITY_OUT=$out/unity
    refuses_a_unity_package_without_libraries
    rm -rf "$GEOIDX_UNITY_OUT/package"
    mkdir -p "$GEOIDX_UNITY_OUT"
    scripts/page_block.sh bindings/unity/README.md Install sh 2 >"$GEOIDX_UNITY_OUT/install.sh"
    bash -euo pipefail "$GEOIDX_UNITY_OUT/install.sh"
    check_identities "$GEOIDX_UNITY_OUT/package"
    check_licences "$GEOIDX_UNITY_OUT/package"
    compiles_everywhere
    take_unity_page
    dotnet build bindings/unity/Tests~/Program "${quiet[@]}"
    cp "$GEOIDX_NATIVE/libgeoidx.so" "$GEOIDX_UNITY_OUT/tests/bin/Program/debug"
}

refuses_another_version() {
    local message
    message=$(GEOIDX_LIBRARY=$(dirname "$mono_tests")/libgeoidx-other.so mono "$mono_tests" version) && return 1
    grep -q 'has version 99.1.2' <<<"$message"
    grep -q 'from .*/libgeoidx-other.so' <<<"$message"
}

# A native thread that crashes after Main leaves the exit code alone, but not the output.
ends_during_calls() { # leave|unload CALLBACKS
    local output
    output=$(mono "$mono_tests" "$@" 2>&1) && [ -z "$output" ] && return
    echo "mono $mono_tests $*: $output" >&2
    return 1
}

test_under_mono() {
    mono "$mono_tests"
    refuses_another_version
    for callbacks in none progress token metric solver visitor allocator; do
        ends_during_calls leave "$callbacks"
        ends_during_calls unload "$callbacks"
    done
    test_unity_under_mono
}

test_unity_under_mono() {
    local programs=$GEOIDX_UNITY_OUT/tests/bin/Program
    mono "$programs/debug/Program.dll"
    rm -rf "$programs/without-library"
    mkdir "$programs/without-library"
    cp "$programs"/debug/*.dll "$programs/without-library"
    mono "$programs/without-library/Program.dll" without-library
}

fill_runtimes
case ${1:-} in
--pack)
    pack
    exit
    ;;
--pack-unity)
    bindings/unity/pack.sh "$out/unity"
    exit
    ;;
esac
dotnet build "$csharp/Geoidx.slnx" -c Release "${quiet[@]}"
dotnet test "$csharp/Geoidx.Tests" -c Release --no-build "${quiet[@]}"
dotnet "$out/artifacts/bin/Geoidx.Bench/release/Geoidx.Bench.dll"
test_package
bindings/csharp/test_page.sh "$out/page"
compile_unity
if command -v mono >/dev/null; then
    echo "netstandard2.1 on Mono:"
    test_under_mono
else
    echo "SKIPPED: Mono is missing: the Unity package is compiled, but not run; netstandard2.1 on .NET:"
    test_netstandard_on_dotnet
fi
