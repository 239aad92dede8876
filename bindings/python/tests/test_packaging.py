"""What the installed package consists of."""

import inspect
import sysconfig
import unittest
from ctypes import byref, sizeof
from importlib import metadata
from pathlib import Path

import geoidx
from geoidx import _native


class Packaging(unittest.TestCase):
    def test_the_wheel_is_for_any_python_3_of_this_platform(self):
        platform = sysconfig.get_platform().replace("-", "_")
        self.assertIn(f"Tag: py3-none-{platform}", metadata.distribution("geoidx").read_text("WHEEL"))

    def test_files(self):
        files = {Path(file).name for file in metadata.files("geoidx") if file.parts[0] == "geoidx"}
        self.assertLessEqual({"__init__.py", "py.typed", "libgeoidx.so"}, files)

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


if __name__ == "__main__":
    unittest.main()
