#!/usr/bin/env bash
# Builds the library for linux-arm64 and win-x64 on Debian 12 and checks it there: opening and querying under
# qemu-user, the C tests under Wine. Puts the libraries into bindings/csharp/runtimes. With names, only those.
set -euo pipefail
cd "$(dirname "$0")/.."

targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(linux-arm64 win-x64)
root=$PWD
cross=$root/build/cross
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)

install_packages() {
    local missing=()
    for package in "$@"; do
        dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    "${as_root[@]}" apt-get update -qq
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# fetch_source PACKAGE: Debian's source package, unpacked into build/cross/sources/PACKAGE.
fetch_source() {
    local folder=$cross/sources/$1 parts=$cross/sources/parts
    [ -d "$folder" ] && return
    rm -rf "$cross/sources/fetch-$1"
    mkdir -p "$parts" "$cross/sources/fetch-$1"
    awk -v RS= -v ORS='\n\n' '!/security/' /etc/apt/sources.list.d/debian.sources |
        sed 's/^Types:.*/Types: deb-src/' >"$parts/debian.sources"
    local apt=(-o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$parts")
    "${as_root[@]}" apt-get "${apt[@]}" -o APT::Get::List-Cleanup=0 update -qq
    (cd "$cross/sources/fetch-$1" && apt-get "${apt[@]}" source -qq "$1")
    mv "$(find "$cross/sources/fetch-$1" -mindepth 1 -maxdepth 1 -type d)" "$folder"
}

configure_and_build() { # TARGET [cmake arguments]
    local target=$1
    shift
    cmake -G Ninja -S . -B "$cross/$target" -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="cmake/toolchains/$target.cmake" \
        -DGEOIDX_BUILD_TOOLS=OFF -DGEOIDX_BUILD_BENCH=OFF -DGEOIDX_BUILD_TESTS=OFF "$@" >/dev/null
    cmake --build "$cross/$target" --target geoidx
}

# An index file and what this machine answers from it.
prepare_answers() {
    cmake --preset release >/dev/null
    cmake --build --preset release --target geoidx geoidx_tool >/dev/null
    build/release/bin/geoidx build /usr/share/glmark2/models/bunny.obj -o "$cross/bunny.geoidx" >/dev/null
    cc -std=c99 tests/cross/answers.c -Iinclude -Lbuild/release/src -lgeoidx -Wl,-rpath,"$root/build/release/src" -o "$cross/answers"
    "$cross/answers" "$cross/bunny.geoidx" >"$cross/answers.txt"
}

# compare_answers COMMAND: that it answers with the same bits.
compare_answers() {
    diff "$cross/answers.txt" <("$@" | tr -d '\r') || { echo "FAILED: other answers than on this machine"; exit 1; }
}

keep() { # TARGET LIBRARY
    mkdir -p "bindings/csharp/runtimes/$1/native"
    cp -L "$2" "bindings/csharp/runtimes/$1/native/"
}

linux_arm64() {
    dpkg --print-foreign-architectures | grep -qx arm64 || "${as_root[@]}" dpkg --add-architecture arm64
    install_packages g++-aarch64-linux-gnu qemu-user libpng-dev:arm64 libzstd-dev:arm64 zlib1g-dev:arm64
    configure_and_build linux-arm64
    local check=$cross/linux-arm64/answers
    aarch64-linux-gnu-gcc -std=c99 tests/cross/answers.c -Iinclude -L"$cross/linux-arm64/src" -lgeoidx -o "$check"
    compare_answers qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$cross/linux-arm64/src" "$check" "$cross/bunny.geoidx"
    keep linux-arm64 "$cross/linux-arm64/src/libgeoidx.so"
}

win_x64() {
    install_packages g++-mingw-w64-x86-64-posix libz-mingw-w64-dev wine wine64 dpkg-dev
    export GEOIDX_WIN_PREFIX=$cross/win-prefix
    mkdir -p "$GEOIDX_WIN_PREFIX/include" "$GEOIDX_WIN_PREFIX/lib/pkgconfig"
    cp /usr/include/xxhash.h "$GEOIDX_WIN_PREFIX/include/"
    if [ ! -e "$GEOIDX_WIN_PREFIX/lib/libzstd.a" ]; then
        fetch_source libzstd
        make -C "$cross/sources/libzstd/lib" libzstd.a CC=x86_64-w64-mingw32-gcc-posix AR=x86_64-w64-mingw32-ar \
            TARGET_SYSTEM=Windows ZSTD_LIB_DICTBUILDER=0 ZSTD_LIB_DEPRECATED=0 >/dev/null
        cp "$cross/sources/libzstd/lib/"*.h "$GEOIDX_WIN_PREFIX/include/"
        cp "$cross/sources/libzstd/lib/libzstd.a" "$GEOIDX_WIN_PREFIX/lib/"
        printf 'Name: zstd\nDescription: zstd\nVersion: 1\nCflags: -I%s/include\nLibs: -L%s/lib -lzstd\n' \
            "$GEOIDX_WIN_PREFIX" "$GEOIDX_WIN_PREFIX" >"$GEOIDX_WIN_PREFIX/lib/pkgconfig/libzstd.pc"
    fi
    if [ ! -e "$GEOIDX_WIN_PREFIX/lib/libpng16.a" ]; then
        fetch_source libpng1.6
        cmake -G Ninja -S "$cross/sources/libpng1.6" -B "$cross/libpng" -DCMAKE_BUILD_TYPE=Release -DPNG_SHARED=OFF -DPNG_TESTS=OFF \
            -DCMAKE_TOOLCHAIN_FILE="$root/cmake/toolchains/win-x64.cmake" -DCMAKE_INSTALL_PREFIX="$GEOIDX_WIN_PREFIX" >/dev/null
        cmake --build "$cross/libpng" --target install >/dev/null
    fi
    configure_and_build win-x64
    local work=$cross/win-x64/check compiler=x86_64-w64-mingw32-gcc-posix
    mkdir -p "$work"
    cp -L "$cross/win-x64/src/"*geoidx*.dll "$work/geoidx.dll"
    echo 'int geoidx_header_test(void); int main(void) { return geoidx_header_test(); }' >"$work/main.c"
    "$compiler" -std=c99 "$work/main.c" tests/capi/header_test.c -Iinclude -L"$work" -lgeoidx -o "$work/header_test.exe"
    "$compiler" -std=c99 tests/install/consumer.c -Iinclude -L"$work" -lgeoidx -o "$work/consumer.exe"
    "$compiler" -std=c99 tests/cross/answers.c -Iinclude -L"$work" -lgeoidx -o "$work/answers.exe"
    cp "$cross/bunny.geoidx" "$work/"
    cd "$work"
    export WINEDEBUG=-all
    wine ./consumer.exe
    wine ./header_test.exe
    compare_answers wine ./answers.exe bunny.geoidx
    cd "$root"
    keep win-x64 "$work/geoidx.dll"
}

mkdir -p "$cross"
prepare_answers
for target in "${targets[@]}"; do
    "${target//-/_}"
    echo "$target: built and checked"
done
