"""Builds with the setuptools that is installed, without a network, in a copy of this folder.

pip builds where installed packages are out of sight, and lets this module say what it lacks.
"""

from __future__ import annotations

import os
import shutil
import site
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Iterator

sys.path += site.getsitepackages()

LIBRARY = "libgeoidx.so"
NOTICES = ("LICENSE", "THIRD-PARTY-NOTICES.txt")
PROJECT = Path(__file__).resolve().parent
REPOSITORY = PROJECT.parents[1]
IN_REPOSITORY = (REPOSITORY / "include" / "geoidx.h").exists()

_NO_SOURCES = f"""
The C++ sources of geoidx are not around {PROJECT}.
Install from bindings/python in a checkout of the repository, or name a {LIBRARY} in GEOIDX_LIBRARY.
"""


def run_cmake(folder: Path) -> Path:
    """Builds the library in `folder`."""
    switches = ["-DCMAKE_BUILD_TYPE=Release"]
    switches += [f"-DGEOIDX_BUILD_{part}=OFF" for part in ("TESTS", "TOOLS", "BENCH")]
    subprocess.run(["cmake", "-S", REPOSITORY, "-B", folder, *switches], check=True)
    jobs = str(os.cpu_count() or 1)
    subprocess.run(["cmake", "--build", folder, "--target", "geoidx", "--parallel", jobs], check=True)
    return folder / "src" / LIBRARY


def native_library(scratch: Path) -> Path:
    """The library named by GEOIDX_LIBRARY, else that of the release build, else a new one."""
    if named := os.environ.get("GEOIDX_LIBRARY"):
        return Path(named)
    if not IN_REPOSITORY:
        sys.exit(_NO_SOURCES)
    released = REPOSITORY / "build" / "release" / "src" / LIBRARY
    return released if released.exists() else run_cmake(scratch)


@contextmanager
def copy_of_project() -> Iterator[Path]:
    """A copy with the repository's notices, as the working directory: setuptools leaves files behind."""
    ignored = shutil.ignore_patterns("build", "dist", "*.egg-info", "__pycache__", LIBRARY)
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(shutil.copytree(PROJECT, Path(folder, "geoidx"), ignore=ignored))
        for name in NOTICES if IN_REPOSITORY else ():
            shutil.copyfile(REPOSITORY / name, copy / name)
        os.chdir(copy)
        try:
            yield copy
        finally:
            os.chdir(before)


def get_requires_for_build_wheel(config_settings: Any = None) -> list[str]:
    return [name for name in ("setuptools>=61", "wheel") if not find_spec(name.partition(">")[0])]


def build_wheel(wheel_directory: str, config_settings: Any = None, metadata_directory: Any = None) -> str:
    from setuptools import build_meta

    target = os.path.abspath(wheel_directory)
    with copy_of_project() as copy:
        shutil.copyfile(native_library(copy / "build" / "cmake"), copy / "src" / "geoidx" / LIBRARY)
        name: str = build_meta.build_wheel(target, config_settings)
    return name


get_requires_for_build_sdist = get_requires_for_build_wheel


def build_sdist(sdist_directory: str, config_settings: Any = None) -> str:
    """Without the C++ sources: from it, geoidx installs with GEOIDX_LIBRARY only."""
    from setuptools import build_meta

    target = os.path.abspath(sdist_directory)
    with copy_of_project():
        name: str = build_meta.build_sdist(target, config_settings)
    return name
