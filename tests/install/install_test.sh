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
cmake -S "$here/subdirectory" -B subdirectory -DGEOIDX_SOURCE="$here/../.." >/dev/null
[ -e subdirectory/geoidx/tests ] && fail "a project with the sources inside builds the tests"

readelf -d consumer/consumer_cpp_static | grep -q 'libgeoidx' && fail "the static program needs the shared library"

# The packages.
(cd "$build" && cpack -B "$work/packages" >/dev/null 2>&1) || fail cpack
grep -q 'include/geoidx.h$' <<<"$(tar -tzf packages/*.tar.gz)" || fail "no header in the .tar.gz"
grep -q 'THIRD-PARTY-NOTICES.txt$' <<<"$(tar -tzf packages/*.tar.gz)" || fail "no notices in the .tar.gz"
grep -q '/usr/lib/.*libgeoidx.so' <<<"$(dpkg-deb -c packages/*.deb)" || fail "no library in the .deb"
grep -q 'libc6' <<<"$(dpkg-deb -f packages/*.deb Depends)" || fail "the .deb does not say what it needs"
echo "installed, linked and packaged: all as expected"
