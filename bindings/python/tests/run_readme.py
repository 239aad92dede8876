"""Does what README.md tells a new user to do: runs its blocks of shell and Python, word for word, in a fresh home.

    GEOIDX_LIBRARY=build/release/src/libgeoidx.so /usr/bin/python3 bindings/python/tests/run_readme.py

Blocks of shell and Python run in the order of the page: those before the first block of Python in the folder of the
package, as the page says, the others where that block has been saved. What the last one prints ends with the page's
block of text. `sudo` checks that the packages it is to install are there; `python3` is another than
Debian's, as on the path of many users.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
SCRIPT_NAME = re.compile(r"(\w+\.py)")

SUDO = """#!/bin/bash -e
if [ "$1 $2" != "apt-get install" ]; then echo "sudo $*: not expected" >&2; exit 1; fi
command -v dpkg-query >/dev/null || exit 0  # not Debian: what lacks is said by the next lines
for package in "${@:3}"; do dpkg-query -W "$package" >/dev/null; done
"""
PYTHON_WITHOUT_NUMPY = """#!/bin/sh
echo "the python3 that is first on the path has no NumPy" >&2
exit 1
"""


def install_program(folder: Path, name: str, text: str) -> None:
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(text)
    (folder / name).chmod(0o755)


def environment(home: Path, library: str | None) -> dict[str, str]:
    """Of a new user, offline. The library that is to be installed may be named."""
    of_user = {"HOME": str(home), "PATH": f"{home}/bin:/usr/bin:/bin", "LANG": "C.UTF-8", "PIP_NO_INDEX": "1"}
    return of_user | ({"GEOIDX_LIBRARY": os.path.abspath(library)} if library else {})


def run_shell(commands: str, folder: Path, variables: dict[str, str]) -> str:
    print(commands, end="", flush=True)
    shell = ["/bin/bash", "-e", "-c", commands]
    result = subprocess.run(shell, cwd=folder, env=variables, stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        sys.exit(f"{result.stdout}README.md has a line that fails, with {result.returncode}")
    return result.stdout


def same_words(found: str, expected: str) -> bool:
    """Words and numbers are the same, numbers to the five digits that the index is good for here."""
    words = [re.findall(r"[\w.]+", text) for text in (found, expected)]
    return len(words[0]) == len(words[1]) and all(map(same_word, *words))


def same_word(found: str, expected: str) -> bool:
    try:
        return abs(float(found) - float(expected)) <= 1e-5 * abs(float(expected))
    except ValueError:
        return found == expected


def check_output(output: str, expected: str) -> None:
    end = "\n".join(output.splitlines()[-len(expected.splitlines()) :])
    if not same_words(end, expected):
        sys.exit(f"README.md says that this is printed:\n{expected}\nbut it is:\n{output}")


def follow(page: str, home: Path) -> None:
    user = environment(home, os.environ.get("GEOIDX_LIBRARY"))
    folder, output, checked = PROJECT, "", 0
    blocks = BLOCK.findall(page)
    for number, (language, text) in enumerate(blocks):
        if language == "sh":
            output = run_shell(text, folder, user)
        elif language == "python":
            name = SCRIPT_NAME.search(blocks[number + 1][1])
            if not name:
                sys.exit("the block that follows a block of Python does not run it")
            folder, user = home / "work", environment(home, None)
            folder.mkdir(exist_ok=True)
            (folder / name[1]).write_text(text)
        elif language == "text":
            check_output(output, text)
            checked += 1
    if not checked:
        sys.exit("README.md has no block of text: nothing has been checked")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        install_program(Path(folder, "bin"), "sudo", SUDO)
        install_program(Path(folder, "bin"), "python3", PYTHON_WITHOUT_NUMPY)
        follow((PROJECT / "README.md").read_text(), Path(folder))
    print("README.md does what it says")


if __name__ == "__main__":
    main()
