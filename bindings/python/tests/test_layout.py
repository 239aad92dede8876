"""What the package says of geoidx.h, compared with what a C compiler says of it."""

import ctypes
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import geoidx
from geoidx import _native

INCLUDE = Path(__file__).resolve().parents[3] / "include"
STRUCTS = [
    value
    for value in vars(_native).values()
    if isinstance(value, type) and issubclass(value, ctypes.Structure) and value is not ctypes.Structure
]
ENUMS = {
    "GEOIDX_ERROR_": [status for status in geoidx.Status if status != geoidx.Status.OK],
    "GEOIDX_METRIC_": geoidx.MetricKind,
    "GEOIDX_ENGINE_": geoidx.Engine,
    "GEOIDX_CODEC_": geoidx.Codec,
    "GEOIDX_ISSUE_": geoidx.IssueNumber,
}


def c_name(struct):
    return "geoidx" + re.sub("([A-Z])", lambda upper: "_" + upper[1].lower(), struct.__name__)


def run_c(lines):
    """The output of a program of these statements."""
    source = "\n".join(["#include <stddef.h>", "#include <stdio.h>", "#include <geoidx.h>", "int main(void) {"])
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder, "layout")
        source_file = program.with_suffix(".c")
        source_file.write_text("\n".join([source, *lines, "return 0; }"]))
        subprocess.run(["cc", "-std=c99", f"-I{INCLUDE}", source_file, "-o", program], check=True)
        return subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()


def prototypes():
    """name -> (type of the result, types of the parameters) of each function of the header."""
    header = re.sub(r"/\*.*?\*/", "", (INCLUDE / "geoidx.h").read_text(), flags=re.DOTALL)
    found = re.findall(r"GEOIDX_API\s+([\w\s*]+?)\s*\b(geoidx_\w+)\(([^)]*)\);", header)
    return {name: (result, parameter_types(parameters)) for result, name, parameters in found}


def parameter_types(parameters):
    types = [re.sub(r"\w+$", "", parameter.strip()).strip() for parameter in parameters.split(",")]
    return [] if parameters.strip() == "void" else types


def spelled(ctype):
    """A ctypes type as the header spells it; None for an address of anything."""
    if ctype in (None, ctypes.c_void_p, ctypes.c_char_p):
        return {None: "void", ctypes.c_void_p: None, ctypes.c_char_p: "const char*"}[ctype]
    if issubclass(ctype, ctypes._CFuncPtr):
        return {_native.IssueFn: "geoidx_issue_fn"}[ctype]
    if issubclass(ctype, ctypes.Structure):
        return c_name(ctype)
    if issubclass(ctype, ctypes._Pointer):
        pointed = spelled(ctype._type_)
        return pointed and pointed + "*"
    scalars = {ctypes.c_float: "float", ctypes.c_int32: "geoidx_status"}
    return scalars.get(ctype) or f"uint{8 * ctypes.sizeof(ctype)}_t"


class Layout(unittest.TestCase):
    def test_structs(self):
        lines, expected = [], []
        for struct in STRUCTS:
            name = c_name(struct)
            lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
            expected.append(f"{name} {ctypes.sizeof(struct)}")
            for field, _ in struct._fields_:
                member = f"(({name}*)0)->{field}"
                lines.append(f'printf("{name}.{field} %zu %zu\\n", offsetof({name}, {field}), sizeof({member}));')
                place = getattr(struct, field)
                expected.append(f"{name}.{field} {place.offset} {place.size}")
        self.assertEqual(run_c(lines), expected)

    def test_every_struct_and_field_is_there(self):
        header = re.sub(r"/\*.*?\*/", "", (INCLUDE / "geoidx.h").read_text(), flags=re.DOTALL)
        bodies = dict(
            (name, body) for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", header, re.DOTALL)
        )
        self.assertEqual(set(bodies), {c_name(struct) for struct in STRUCTS})
        for struct in STRUCTS:
            declared = re.findall(r"(?:\(\*(\w+)\)\([^)]*\)|(\w+)(?:\[\d+\])?);", bodies[c_name(struct)])
            self.assertEqual([a or b for a, b in declared], [field for field, _ in struct._fields_])

    def test_constants(self):
        expected = {prefix + member.name: int(member) for prefix, enum in ENUMS.items() for member in enum}
        names = "POSITION_FLOAT", "POSITION_DOUBLE", "METRIC_UNFOLDABLE", "MAX_LEVELS", "NO_SOURCE"
        flags = "OPEN_PAIRS", "OPEN_BORROW", "OPEN_NO_LABELS", "SAVE_NO_POSITIONS", "SAVE_NO_MESH"
        for name in names + flags:
            expected["GEOIDX_" + name] = getattr(_native, name)
        for name, number in zip(("MAJOR", "MINOR", "PATCH"), _native.HEADER_VERSION):
            expected["GEOIDX_VERSION_" + name] = number
        expected["GEOIDX_ABI_VERSION"] = _native.ABI_VERSION
        lines = [f'printf("%lld\\n", (long long){name});' for name in expected]
        self.assertEqual(run_c(lines), [str(number) for number in expected.values()])

    def test_every_status_is_there(self):
        text = (INCLUDE / "geoidx.h").read_text()
        self.assertEqual(len(re.findall(r"^ +GEOIDX_ERROR_\w+ = ", text, re.MULTILINE)), len(geoidx.Status) - 1)

    def test_every_issue_number_is_there(self):
        text = (INCLUDE / "geoidx.h").read_text()
        self.assertEqual(len(re.findall(r"^ +GEOIDX_ISSUE_\w+ = ", text, re.MULTILINE)), len(geoidx.IssueNumber))

    def test_functions(self):
        declared = prototypes()
        self.assertEqual(set(declared), set(_native.FUNCTIONS))
        for name, (result, parameters) in _native.FUNCTIONS.items():
            for ours, theirs in zip([result, *parameters], [declared[name][0], *declared[name][1]], strict=True):
                with self.subTest(function=name, declared=theirs):
                    self.assert_same(ours, theirs)

    def assert_same(self, ours, theirs):
        name = spelled(ours)
        if name is None or name == "void**":
            self.assertTrue(theirs.endswith("*"))
        else:
            self.assertEqual(name.replace("const ", ""), theirs.replace("const ", ""))

    def test_surface_point(self):
        self.assertEqual(geoidx.SURFACE_POINT.itemsize, ctypes.sizeof(_native.SurfacePoint))
        self.assertEqual(geoidx.SURFACE_POINT["weights"], np.dtype((np.float64, 3)))


if __name__ == "__main__":
    unittest.main()
