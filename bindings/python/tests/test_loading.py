"""Which library is loaded, and which are refused."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import geoidx
from geoidx import _native

PACKAGE = Path(geoidx.__file__).parent
PRINT = "import geoidx._native as native; print(native.library._name)"


def run_python(program, *, package=PACKAGE, **environment):
    inherited = {name: value for name, value in os.environ.items() if name != "GEOIDX_LIBRARY"}
    return subprocess.run(
        [sys.executable, "-B", "-c", program],
        env={**inherited, "PYTHONPATH": str(package.parent), **environment},
        capture_output=True,
        text=True,
    )


class Loading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.native = self.folder / "native.so"
        shutil.copyfile(_native.library._name, self.native)
        self.package = self.folder / "packages" / "geoidx"
        ignored = shutil.ignore_patterns("*.so", "__pycache__")
        shutil.copytree(PACKAGE, self.package, ignore=ignored)

    def assert_loads(self, path, **environment):
        result = run_python(PRINT, package=self.package, **environment)
        self.assertEqual((result.stdout.strip(), result.stderr), (str(path), ""))

    def refusal(self, library):
        result = run_python("import geoidx", package=self.package, GEOIDX_LIBRARY=str(library))
        self.assertEqual(result.returncode, 1)
        last = result.stderr.strip().splitlines()[-1]
        self.assertTrue(last.startswith("ImportError: "), last)
        return last

    def compiled(self, source):
        library = self.folder / "other.so"
        command = ["cc", "-shared", "-fPIC", "-x", "c", "-", "-o", library]
        subprocess.run(command, input=source, text=True, check=True)
        return library

    def test_the_order(self):
        self.assertIn("cannot be loaded", run_python("import geoidx", package=self.package).stderr)
        by_loader = self.folder / "libgeoidx.so.0"
        shutil.copyfile(self.native, by_loader)
        search = {"LD_LIBRARY_PATH": str(self.folder)}
        self.assert_loads(by_loader.name, **search)
        by_loader.rename(self.folder / "libgeoidx.so")
        self.assert_loads("libgeoidx.so", **search)
        beside = self.package / "libgeoidx.so"
        shutil.copyfile(self.native, beside)
        self.assert_loads(beside, **search)
        self.assert_loads(self.native, GEOIDX_LIBRARY=str(self.native), **search)

    def test_a_named_library_that_is_not_there(self):
        self.assertIn("/nonexistent/x.so", self.refusal("/nonexistent/x.so"))

    def test_another_library(self):
        self.assertIn("geoidx_version", self.refusal(self.compiled("int other;")))

    def versioned(self, number, abi):
        return self.compiled(
            f"unsigned geoidx_version(void) {{ return {number}; }}"
            f"unsigned geoidx_abi_version(void) {{ return {abi}; }}"
        )

    def test_another_version(self):
        for number, abi, version in ((10000, 1, "1.0.0"), (20304, 7, "2.3.4"), (0, 0, "0.0.0"), (99, 0, "0.0.99")):
            message = self.refusal(self.versioned(number, abi))
            self.assertIn(f"is geoidx {version} with ABI {abi}", message)
            self.assertIn(f"needs {geoidx.__version__}", message)

    def test_a_later_version_that_lacks_a_function(self):
        self.assertIn("geoidx_", self.refusal(self.versioned(200, 0)))

    def test_versions(self):
        self.assertEqual(geoidx.library_version, geoidx.__version__)


if __name__ == "__main__":
    unittest.main()
