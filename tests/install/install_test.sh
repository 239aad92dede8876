#!/usr/bin/env bash
# install_test.sh BUILD WORK: installs a build into an empty prefix in the folder WORK, and uses it as strangers do.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
build=$1
work=$2
prefix=$work/prefix
rm -rf "$work"
mkdir -p "$work"

fail() { echo "FAILED: $1"; exit 1; }
expect() { [ "$2" = "$3" ] || fail "$1: expected '$3', got '$2'"; }

cmake --install "$build" --prefix "$prefix" >/dev/null
library=$(find "$prefix" -name 'libgeoidx.so')
libraries=$(dirname "$library")
cd "$work"

cc -std=c99 -pedantic-errors -Wall -Wextra -Werror "$here/consumer.c" -I"$prefix/include" -L"$libraries" -lgeoidx -lm -o c99
expect "a C99 program" "$(LD_LIBRARY_PATH=$libraries ./c99)" 1.41421

export PKG_CONFIG_PATH=$libraries/pkgconfig
read -ra flags <<<"$(pkg-config --cflags --libs geoidx)"
c++ -std=c++20 -Wall -Wextra -Wpedantic -Wconversion -Werror "$here/consumer.cpp" "${flags[@]}" -o pkg_config
expect "a program by pkg-config" "$(LD_LIBRARY_PATH=$libraries ./pkg_config)" 1.41421
expect "its version" "$(pkg-config --modversion geoidx)" "$("$prefix/bin/geoidx" --version | grep -o '[0-9.]*$')"
/usr/bin/python3 "$here/../tools/manual_test.py" "$prefix/bin/geoidx" "$here/../../tools/README.md" manual ||
    fail "the tool's page, followed with the installed tool"

cmake -S "$here" -B consumer -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build consumer >/dev/null
for program in consumer_c consumer_cpp consumer_cpp_static; do
    expect "$program by find_package" "$(consumer/$program)" 1.41421
done
# Of projects that know no C++, and that have the sources inside of theirs.
cmake -S "$here/c_only" -B c_only -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build c_only >/dev/null
expect "a C project with the static library" "$(c_only/consumer_c_static)" 1.41421
cmake -S "$here/subdirectory" -B subdirectory -DGEOIDX_SOURCE="$here/../.." -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
[ -e subdirectory/geoidx/tests ] && fail "a project with the sources inside builds the tests"

# Optimized where no build type is given, and only then; the project around keeps its own.
level_of() { grep -E '"command":.*'"$2"'\.c' "$1/compile_commands.json" | grep -oE ' -O[0-3a-z]+' | sort -u | tr -d ' \n'; }
expect "the optimization of a project's own program" "$(level_of subdirectory consumer)" ""
expect "the optimization of geoidx inside of it" "$(level_of subdirectory intake)" -O3
expect "the build type of that project" "$(grep -c '^CMAKE_BUILD_TYPE:.*=.' subdirectory/CMakeCache.txt)" 0
cmake -S "$here/subdirectory" -B subdirectory_debug -DGEOIDX_SOURCE="$here/../.." -DCMAKE_BUILD_TYPE=Debug >/dev/null
expect "the optimization of geoidx in a project of Debug" "$(level_of subdirectory_debug intake)" ""
alone=(-DGEOIDX_BUILD_TOOLS=OFF -DGEOIDX_BUILD_TESTS=OFF -DGEOIDX_BUILD_BENCH=OFF)
cmake -S "$here/../.." -B alone "${alone[@]}" >/dev/null
expect "the build type of geoidx alone" "$(sed -n 's/^CMAKE_BUILD_TYPE:.*=//p' alone/CMakeCache.txt)" Release
cmake -S "$here/../.." -B alone_debug "${alone[@]}" -DCMAKE_BUILD_TYPE=Debug >/dev/null
expect "the build type that was given" "$(sed -n 's/^CMAKE_BUILD_TYPE:.*=//p' alone_debug/CMakeCache.txt)" Debug

readelf -d consumer/consumer_cpp_static | grep -q 'libgeoidx' && fail "the static program needs the shared library"
readelf -d "$prefix/bin/geoidx" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' >needed.txt
sed -E '/^(libgeoidx|libstdc\+\+|libm|libgcc_s|libc|ld-linux.*)\.so/d' needed.txt | grep . && fail "the tool needs more than libc and libstdc++"
echo '#include <geoidx.hpp>' >old.cpp
c++ -std=c++17 -fsyntax-only -I"$prefix/include" old.cpp 2>old.txt && fail "geoidx.hpp passes as C++17"
grep -q 'needs C++20' old.txt || fail "geoidx.hpp does not say that it needs C++20"

# The packages.
(cd "$build" && cpack -B "$work/packages" >/dev/null 2>&1) || fail cpack
mkdir tar deb
tar -xzf packages/*.tar.gz -C tar --strip-components=1
dpkg-deb -x packages/*.deb deb
[ -e tar/include/geoidx.h ] || fail "no header in the .tar.gz, or not in its folder include"
[ -e tar/share/doc/geoidx/THIRD-PARTY-NOTICES.txt ] || fail "no notices in the .tar.gz"
expect "the tool of the .tar.gz" "$(tar/bin/geoidx --version)" "$("$prefix/bin/geoidx" --version)"
grep -q '/usr/lib/.*libgeoidx.so' <<<"$(dpkg-deb -c packages/*.deb)" || fail "no library in the .deb"
grep -q 'libc6' <<<"$(dpkg-deb -f packages/*.deb Depends)" || fail "the .deb does not say what it needs"
for name in 'MIT License' libpng zlib zstd xxHash Eigen CLI11 tinyobjloader mingw-w64 libstdc++; do
    grep -qF "$name" deb/usr/share/doc/geoidx/copyright || fail "the .deb has no notice of $name"
done

# The oldest systems that the page names, which depend on the compiler's own.
packaged=$(find deb -name 'libgeoidx.so.*.*')
says() { sed -n "s/^| $1.* | \(glibc .*\) |$/\1/p" "$here/../../include/README.md"; }
if grep -q '^VERSION_ID="12"' /etc/os-release && grep -q '^ID=debian' /etc/os-release; then
    oldest=$here/../../scripts/oldest_system.sh
    expect "the oldest system of the packages" "$(says '`.deb`')" "$("$oldest" "$packaged" deb/usr/bin/geoidx)"
    expect "the oldest system of the library" "$(says 'the library alone')" "$("$oldest" "$packaged")"
fi
echo "installed, linked and packaged: all as expected"
