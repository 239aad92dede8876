"""Puts the native library into the wheel, which fits any Python 3 of the platform."""

import os
import shutil
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

LIBRARY = "libgeoidx.so"
REPOSITORY = Path(__file__).resolve().parents[2]


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
    released = REPOSITORY / "build" / "release" / "src" / LIBRARY
    return released if released.exists() else run_cmake(scratch)


class BuildWithLibrary(build_py):
    def run(self) -> None:
        super().run()
        scratch = Path(self.get_finalized_command("build").build_temp).resolve() / "cmake"
        shutil.copyfile(native_library(scratch), Path(self.build_lib, "geoidx", LIBRARY))


class PlatformWheel(bdist_wheel):
    def get_tag(self) -> "tuple[str, str, str]":
        return "py3", "none", super().get_tag()[2]


class PlatformDistribution(Distribution):
    def has_ext_modules(self) -> bool:
        return True


setup(
    distclass=PlatformDistribution,
    cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel},
)
