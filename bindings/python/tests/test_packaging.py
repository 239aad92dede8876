"""What the installed package consists of."""

import inspect
import os
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import unittest
import zipfile
from ctypes import byref, sizeof
from importlib import metadata
from pathlib import Path

import geoidx
from geoidx import _native

PROJECT = Path(__file__).parents[1]
NOTICES = {"LICENSE", "THIRD-PARTY-NOTICES.txt"}


class Packaging(unittest.TestCase):
    def test_the_wheel_is_for_any_python_3_of_this_platform(self):
        platform = sysconfig.get_platform().replace("-", "_")
        self.assertIn(f"Tag: py3-none-{platform}", metadata.distribution("geoidx").read_text("WHEEL"))

    def test_files(self):
        files = {Path(file).name for file in metadata.files("geoidx") if file.parts[0] == "geoidx"}
        self.assertLessEqual({"__init__.py", "py.typed", "libgeoidx.so"}, files)

    def test_notices(self):
        notices = [file for file in metadata.files("geoidx") if file.name in NOTICES]
        self.assertEqual({file.name for file in notices}, NOTICES)
        for file in notices:
            self.assertEqual(file.read_text(), (PROJECT.parents[1] / file.name).read_text())

    def test_version(self):
        self.assertEqual(metadata.version("geoidx"), geoidx.__version__)

    def test_what_is_public_is_documented(self):
        for name in geoidx.__all__:
            value = getattr(geoidx, name)
            if inspect.isclass(value) and value.__module__.startswith("geoidx"):
                with self.subTest(name):
                    self.assertTrue(value.__doc__)
                    for member, function in inspect.getmembers(value, inspect.isfunction):
                        self.assertTrue(member.startswith("_") or inspect.getdoc(function), member)

    def test_defaults_are_those_of_the_library(self):
        defaults = _native.BuildOptions()
        _native.library.geoidx_build_options_init_sized(byref(defaults), sizeof(defaults))
        names = {name for name, _ in defaults._fields_}
        parameters = inspect.signature(geoidx.Index.build).parameters
        for name in names & set(parameters) - {"metric", "patches", "progress", "allocator"}:
            with self.subTest(name):
                self.assertEqual(parameters[name].default, getattr(defaults, name))
        self.assertEqual(geoidx.Weighted([]).points_per_edge, defaults.points_per_edge)
        self.assertEqual(parameters["levels"].default, defaults.level_count)


class Building(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def ask_backend(self, call, project=PROJECT, before="", options=(), **environment):
        inherited = {name: value for name, value in os.environ.items() if name != "GEOIDX_LIBRARY"}
        program = f"{before}\nimport build_backend\nprint(build_backend.{call})"
        return subprocess.run(
            [sys.executable, "-B", *options, "-c", program],
            cwd=project,
            env={**inherited, **environment},
            capture_output=True,
            text=True,
        )

    def unpacked_sdist(self):
        result = self.ask_backend(f"build_sdist({str(self.folder)!r})")
        name = result.stdout.splitlines()[-1]
        with tarfile.open(self.folder / name) as archive:
            archive.extractall(self.folder)
        return self.folder / name.removesuffix(".tar.gz")

    def test_a_sdist_holds_the_notices(self):
        project = self.unpacked_sdist()
        self.assertLessEqual(NOTICES | {"README.md", "build_backend.py"}, {path.name for path in project.iterdir()})
        self.assertFalse(list(project.rglob("*.so")))

    def test_a_sdist_says_that_it_lacks_the_sources(self):
        result = self.ask_backend("build_wheel('..')", self.unpacked_sdist())
        self.assertEqual(result.returncode, 1)
        self.assertIn("C++ sources", result.stderr)
        self.assertNotIn("Traceback", result.stderr)

    def test_a_sdist_and_a_library_are_a_wheel(self):
        library = _native.library._name
        result = self.ask_backend("build_wheel('..')", self.unpacked_sdist(), GEOIDX_LIBRARY=library)
        with zipfile.ZipFile(self.folder / result.stdout.splitlines()[-1]) as wheel:
            self.assertEqual(wheel.read("geoidx/libgeoidx.so"), Path(library).read_bytes())
            self.assertLessEqual(NOTICES, {Path(name).name for name in wheel.namelist()})

    def test_what_the_backend_asks_for(self):
        """Nothing where setuptools and wheel are installed."""
        asked = "get_requires_for_build_wheel()"
        self.assertEqual(self.ask_backend(asked).stdout, "[]\n")
        nothing = "import site; site.getsitepackages = list"
        lacking = self.ask_backend(asked, before=nothing, options=["-S"])
        self.assertEqual(lacking.stdout, "['setuptools>=61', 'wheel']\n")


if __name__ == "__main__":
    unittest.main()
