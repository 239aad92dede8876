#!/usr/bin/env bash
# Installs the Python package into build/python, offline, and runs its tests against what is installed. Also follows
# the package's README.md, as a new user would.
# GEOIDX_NATIVE: the folder of libgeoidx.so, build/release/src unless set.
set -euo pipefail
cd "$(dirname "$0")/.."

python=/usr/bin/python3
venv=$PWD/build/python/venv
package=$PWD/bindings/python
library=$(realpath -m "${GEOIDX_NATIVE:-build/release/src}")/libgeoidx.so

for module in numpy ensurepip setuptools wheel; do
    if ! "$python" -c "import $module" 2>/dev/null; then
        echo "SKIPPED: the Python tests need python3-numpy, python3-venv, python3-setuptools and python3-wheel"
        exit 0
    fi
done
if [ ! -e "$library" ]; then
    echo "there is no $library: build it, or name its folder in GEOIDX_NATIVE" >&2
    exit 1
fi

files_of_package() { find "$package" -not -path '*__pycache__*' | sort; }
files_before=$(files_of_package)
"$python" -m venv --clear --system-site-packages "$venv"
GEOIDX_LIBRARY=$library "$venv/bin/pip" --quiet --disable-pip-version-check \
    install --no-index "$package"
if [ "$(files_of_package)" != "$files_before" ]; then
    echo "installing has left files in $package" >&2
    exit 1
fi

GEOIDX_LIBRARY=$library "$python" -B "$package/tests/run_readme.py"
if [ "$(files_of_package)" != "$files_before" ]; then
    echo "following README.md has left files in $package" >&2
    exit 1
fi

unset GEOIDX_LIBRARY PYTHONPATH
if [ -x /usr/bin/mypy ]; then
    mypy=(/usr/bin/mypy --strict --cache-dir "$venv/../mypy" --python-executable "$venv/bin/python")
    (cd "$package" && "${mypy[@]}")
    (cd "$package/tests" && "${mypy[@]}" typed_use.py)
else
    echo "SKIPPED: the check of type hints needs mypy"
fi
"$venv/bin/python" -B -m unittest discover --start-directory "$package/tests"
