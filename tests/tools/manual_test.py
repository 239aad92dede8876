"""Runs the lines that the tool's manual shows: manual_test.py TOOL PAGE SCRATCH_FOLDER

The lines are taken from the blocks of the page that are marked `console`: what follows "$ " is run, lines that follow
with "> " belong to it, and the others are what it prints, on stdout and stderr. All run one after the other in one
folder. A number is right when it is near the one on the page: distances of an index are rounded.
"""

import math
import pathlib
import re
import subprocess
import sys
import tempfile

# Pages round to six digits, and an index of distances up to 3 to 3/65532.
TOLERANCE = 1e-4


def console_blocks(page):
    return re.findall(r"^```console\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


def sessions(block):
    """(command, what it prints) of a block."""
    found = []
    for line in block.splitlines():
        if line.startswith("$ "):
            found.append(([line[2:]], []))
        elif line.startswith("> ") and not found[-1][1]:
            found[-1][0].append(line[2:])
        else:
            found[-1][1].append(line)
    return [("\n".join(command), "\n".join(printed)) for command, printed in found]


def is_same_word(word, expected):
    try:
        return math.isclose(float(word), float(expected), rel_tol=TOLERANCE, abs_tol=TOLERANCE)
    except ValueError:
        return word == expected


def is_same_text(text, expected):
    words, expected_words = ([re.findall(r"[\w.+-]+|\S", line) for line in t.splitlines()] for t in (text, expected))
    return len(words) == len(expected_words) and all(
        len(line) == len(expected_line) and all(map(is_same_word, line, expected_line))
        for line, expected_line in zip(words, expected_words)
    )


def run(command, tool, folder):
    environment = {"PATH": f"{tool.parent}:/usr/bin:/bin", "LC_ALL": "C.UTF-8"}
    # Only the command that the page means to fail may: it says its exit status.
    script = command if "exit status" in command else f"set -e -o pipefail\n{command}"
    done = subprocess.run(["/bin/bash", "-c", script], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout.rstrip("\n")


def main():
    tool, page, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    scratch.mkdir(parents=True, exist_ok=True)
    commands = [session for block in console_blocks(page.read_text()) for session in sessions(block)]
    if not commands:
        sys.exit(f"FAILED: {page} shows no command")
    failures = 0
    with tempfile.TemporaryDirectory(dir=scratch) as folder:
        for command, expected in commands:
            status, printed = run(command, tool, folder)
            if status == 0 and is_same_text(printed, expected):
                continue
            failures += 1
            print(f"FAILED: {command}\nexit status {status}; the page says:\n{expected}\nit is:\n{printed}")
    print(f"{len(commands)} commands of {page.name}, {failures} failures")
    sys.exit(1 if failures else 0)


main()
