"""Reads what the command line tool writes by means of its own: outputs_test.py TOOL SCRATCH_FOLDER

The mesh is two boxes apart, one with corners that are no floats, and the distances that are looked for are those that
a box has by unfolding its sides, in closed form.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

TOOL = str(pathlib.Path(sys.argv[1]).resolve())
SCRATCH = pathlib.Path(sys.argv[2])
SIDES = ([3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])


def box(origin, size):
    """Eight corners: the lower four around, then the upper four above them."""
    return [[origin + size * x, size * y, size * z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]


CORNERS = box(0.1, 1.0) + box(5.0, 2.0)
# From corner 0 of the unit box: along an edge, across a side (paths run over the side's diagonal, in whichever way
# it is cut), and over two sides to the opposite corner.
FROM_CORNER_0 = [0, 1, math.sqrt(2), 1, 1, math.sqrt(2), math.sqrt(5), math.sqrt(2)] + [math.inf] * 8
# Distances in an index are rounded to 1/65532 of the longest one that a table may hold, which here is below 3.
ROUNDING = 3 * 3 / 65532


def off_file():
    polygons = [[corner + first for corner in side] for first in (0, 8) for side in SIDES]
    lines = ["OFF", f"{len(CORNERS)} {len(polygons)} 0"]
    lines += [" ".join(map(repr, corner)) for corner in CORNERS]
    lines += [" ".join(map(str, [4, *polygon])) for polygon in polygons]
    return "\n".join(lines) + "\n"


def run(*arguments, **options):
    return subprocess.run([TOOL, *arguments], capture_output=True, check=False, **options)


def output_of(*arguments, **options):
    done = run(*arguments, **options)
    assert done.returncode == 0, (arguments, done.stderr)
    assert done.stderr == b"", (arguments, done.stderr)
    return done.stdout


def strict_json(text):
    """Without the NaN and Infinity that Python would let pass."""

    def refuse(word):
        raise ValueError(word)

    return json.loads(text, parse_constant=refuse)


PLY_TYPES = {"double": "<f8", "float": "<f4", "uchar": "u1", "uint": "<u4"}


def read_ply(content):
    header, rest = content.split(b"end_header\n", 1)
    lines = header.decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"], lines
    elements = []
    for words in (line.split() for line in lines[2:]):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    (vertex_name, vertex_count, vertex_properties), (face_name, face_count, face_properties) = elements
    assert (vertex_name, face_name) == ("vertex", "face")
    assert face_properties == [["list", "uchar", "uint", "vertex_indices"]]
    vertex_type = numpy.dtype([(name, PLY_TYPES[kind]) for kind, name in vertex_properties])
    vertices = numpy.frombuffer(rest, vertex_type, vertex_count)
    face_type = numpy.dtype([("count", "u1"), ("corners", "<u4", 3)])
    faces = numpy.frombuffer(rest, face_type, face_count, vertices.nbytes)
    assert len(rest) == vertices.nbytes + faces.nbytes
    assert (faces["count"] == 3).all()
    return vertices, faces["corners"]


class Outputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        SCRATCH.mkdir(parents=True, exist_ok=True)
        cls.temporary = tempfile.TemporaryDirectory(dir=SCRATCH)
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.mesh = cls.folder / "two boxes.off"
        cls.mesh.write_text(off_file())
        cls.index = cls.folder / "boxes.geoidx"
        output_of("build", cls.mesh, "-o", cls.index)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def assert_distances(self, distances, rounding=ROUNDING):
        self.assertEqual(len(distances), len(FROM_CORNER_0))
        for distance, expected in zip(distances, FROM_CORNER_0):
            if math.isinf(expected):
                self.assertEqual(float(distance), math.inf)
            else:
                self.assertLessEqual(abs(float(distance) - expected), rounding)

    def written(self, name, *arguments):
        path = self.folder / name
        self.assertEqual(output_of(*arguments, "-o", path), b"")
        return path

    def fields(self, suffix):
        """The same field from the index and from scratch, with what each may be off by."""
        yield self.written(f"msad.{suffix}", "msad", self.index, "0", "--mesh", self.mesh), ROUNDING
        yield self.written(f"EXACT.{suffix.upper()}", "exact", self.mesh, "0"), 1e-6

    def test_f32(self):
        for path, rounding in self.fields("f32"):
            self.assert_distances(numpy.fromfile(path, "<f4"), rounding)

    def test_npy(self):
        for path, rounding in self.fields("npy"):
            content = path.read_bytes()
            self.assertEqual(content[:8], b"\x93NUMPY\x01\x00")
            self.assertEqual((10 + int.from_bytes(content[8:10], "little")) % 64, 0)
            distances = numpy.load(path)
            self.assertEqual((distances.dtype.str, distances.shape), ("<f4", (16,)))
            self.assert_distances(distances, rounding)

    def test_csv(self):
        for path, rounding in self.fields("csv"):
            self.assertNotIn(b"\r", path.read_bytes())
            with path.open(newline="") as file:
                rows = list(csv.reader(file))
            self.assertEqual(rows[0], ["vertex", "distance"])
            self.assertEqual([row[0] for row in rows[1:]], [str(v) for v in range(16)])
            self.assertEqual([row[1] for row in rows[9:]], ["inf"] * 8)
            self.assert_distances([row[1] for row in rows[1:]], rounding)

    def test_ply(self):
        for path, rounding in self.fields("ply"):
            vertices, triangles = read_ply(path.read_bytes())
            self.assertEqual(vertices.dtype.names, ("x", "y", "z", "distance", "red", "green", "blue"))
            self.assertEqual([list(map(float, [v["x"], v["y"], v["z"]])) for v in vertices], CORNERS)
            self.assert_distances(vertices["distance"], rounding)
            self.assert_triangles_of_sides(triangles)
            self.assert_colours(vertices)

    def assert_triangles_of_sides(self, triangles):
        self.assertEqual(len(triangles), 24)
        for i, triangle in enumerate(triangles):
            side = [corner + 8 * (i // 12) for corner in SIDES[i // 2 % 6]]
            self.assertEqual(len(set(map(int, triangle)) & set(side)), 3)

    def assert_colours(self, vertices):
        """Unreachable is grey; otherwise the lightness falls with the distance, from yellow to blue."""
        colours = numpy.stack([vertices[name].astype(float) for name in ("red", "green", "blue")], axis=1)
        for red, green, blue in colours[8:]:
            self.assertTrue(red == green == blue)
        light = colours @ [0.2126, 0.7152, 0.0722]
        self.assertGreater(light[0], light[1])
        self.assertGreater(light[1], light[2])
        self.assertGreater(light[2], light[6])
        self.assertLess(colours[0][2], colours[0][0])
        self.assertLess(colours[6][0], colours[6][2])

    def test_ply_is_the_same_mesh(self):
        path = self.written("again.ply", "exact", self.mesh, "0")
        again = self.folder / "again.geoidx"
        output_of("build", path, "-o", again)
        self.assertEqual(again.read_bytes(), self.index.read_bytes())

    def test_formats_hold_the_same_bits(self):
        numbers = numpy.fromfile(self.written("bits.f32", "msad", self.index, "0", "9"), "<f4")
        rows = self.written("bits.csv", "msad", self.index, "0", "9").read_text().splitlines()[1:]
        self.assertTrue((numpy.array([row.split(",")[1] for row in rows], "<f4") == numbers).all())
        shown = strict_json(output_of("msad", self.index, "0", "9", "--json"))
        self.assertTrue((numpy.array(shown["distances"], "<f4") == numbers).all())

    def test_json_of_fields(self):
        for arguments in (["msad", self.index], ["exact", self.mesh]):
            shown = strict_json(output_of(*arguments, "0", "--json"))
            self.assert_distances([math.inf if d is None else d for d in shown["distances"]])
            self.assertEqual(shown["sources"], [0])
            self.assertEqual((shown["vertex_count"], shown["reachable_count"]), (16, 8))
            self.assertEqual(shown["farthest_vertex"], 6)
            self.assertLessEqual(abs(shown["largest_distance"] - math.sqrt(5)), ROUNDING)
            self.assertEqual((shown["output"], shown["picture"]), (None, None))

    def test_json_beside_a_file(self):
        path = self.folder / "beside.csv"
        shown = strict_json(output_of("msad", self.index, "0", "-o", path, "--json"))
        self.assertEqual(shown["output"], str(path))
        self.assertNotIn("distances", shown)
        self.assertTrue(path.exists())

    def test_json_of_pairs(self):
        pairs = b"0 6\n0 8\n3 3\n"
        shown = strict_json(output_of("sssd", self.index, "-", "--json", "--exact", self.mesh, input=pairs))
        across, apart, same = shown["pairs"]
        self.assertEqual((across["source"], across["target"]), (0, 6))
        self.assertAlmostEqual(across["exact"], math.sqrt(5), delta=1e-12)
        self.assertAlmostEqual(across["distance"], math.sqrt(5), delta=ROUNDING)
        error = abs(across["distance"] - across["exact"]) / across["exact"]
        self.assertAlmostEqual(across["relative_error"], error, delta=1e-7)
        self.assertEqual((apart["distance"], apart["exact"], apart["relative_error"]), (None, None, 0))
        self.assertEqual((same["distance"], same["exact"], same["relative_error"]), (0, 0, 0))

    def test_json_of_build_and_info(self):
        for codec in ("packed", "lossless"):
            file = self.folder / f"{codec}.geoidx"
            built = strict_json(output_of("build", self.mesh, "-o", file, "--codec", codec, "--json"))
            info = strict_json(output_of("info", file, "--json"))
            self.assertEqual(built["mesh"], str(self.mesh))
            self.assertEqual(built["file_size"], file.stat().st_size)
            self.assertGreater(built["build_seconds"], 0)
            self.assertEqual((info["vertex_count"], info["triangle_count"]), (16, 24))
            self.assertEqual(info["codec"], codec)
            sections = info.pop("sections")
            self.assertEqual([section["tag"] for section in sections][:3], ["META", "HIER", "VERT"])
            self.assertEqual(sections[-1]["offset"] + sections[-1]["stored_size"], built["file_size"])
            self.assertEqual({key: built[key] for key in info}, info)

    def test_convert(self):
        lossless, packed = self.folder / "there.geoidx", self.folder / "back.geoidx"
        shown = strict_json(output_of("convert", self.index, "-o", lossless, "--codec", "lossless", "--json"))
        self.assertEqual((shown["index"], shown["output"]), (str(self.index), str(lossless)))
        info = strict_json(output_of("info", lossless, "--json"))
        info.pop("sections")
        self.assertEqual({key: shown[key] for key in info}, info)
        self.assertEqual(shown["codec"], "lossless")
        output_of("convert", lossless, "-o", packed)
        self.assertEqual(packed.read_bytes(), self.index.read_bytes())
        self.assertEqual(output_of("convert", lossless, "-o", "-"), self.index.read_bytes())
        self.assertEqual(output_of("convert", packed, "-o", "-", "--codec", "lossless"), lossless.read_bytes())
        for wrong in (["-o", "-", "--json"], ["-o", packed, "--codec", "zip"], []):
            self.assertEqual(run("convert", lossless, *wrong).returncode, 2)
        before = lossless.read_bytes()
        self.assertEqual(run("convert", lossless, "-o", lossless).returncode, 1)
        self.assertEqual(lossless.read_bytes(), before)
        self.assertEqual(run("convert", self.mesh, "-o", packed).returncode, 1)
        self.assertEqual(packed.read_bytes(), self.index.read_bytes())

    def test_without_positions(self):
        """Each command opens the file with the mesh, and says on one line that it needs it."""
        bare, back, built = (self.folder / f"{name}.geoidx" for name in ("bare", "back", "built"))
        shown = strict_json(output_of("convert", self.index, "-o", bare, "--no-positions", "--json"))
        self.assertEqual(shown["has_positions"], 0)
        output_of("build", self.mesh, "-o", built, "--no-positions")
        self.assertEqual(built.read_bytes(), bare.read_bytes())
        mesh = ["--mesh", self.mesh]
        output_of("convert", bare, "-o", back, *mesh)
        self.assertEqual(back.read_bytes(), self.index.read_bytes())
        output_of("convert", bare, "-o", back, "--no-positions", *mesh)
        self.assertEqual(back.read_bytes(), bare.read_bytes())
        self.assertEqual(strict_json(output_of("info", bare, "--json", *mesh))["has_positions"], 0)
        self.assertEqual(strict_json(output_of("info", self.index, "--json", *mesh))["has_positions"], 1)
        for command in (["sssd", "0", "6"], ["msad", "0", "-o", "-"]):
            name, *rest = command
            self.assertEqual(output_of(name, bare, *rest, *mesh), output_of(name, self.index, *rest))
        exact = ["0", "6", "--exact", self.mesh]
        self.assertEqual(output_of("sssd", bare, *exact), output_of("sssd", self.index, *exact))
        self.assertEqual(run("sssd", bare, *exact, *mesh).returncode, 2)
        output_of("verify", bare)
        output_of("bench", bare, "--queries", "1", *mesh)
        for name, *rest in (
            ["info"],
            ["convert", "-o", back],
            ["sssd", "0", "6"],
            ["msad", "0", "-o", "-"],
            ["bench", "--queries", "1"],
        ):
            done = run(name, bare, *rest)
            self.assertEqual((done.returncode, done.stdout), (1, b""))
            self.assertEqual(done.stderr.count(b"\n"), 1)
            self.assertIn(b"--mesh", done.stderr)
        other = self.folder / "other.off"
        other.write_text(off_file().replace("0.1", "0.2"))
        done = run("info", bare, "--mesh", other)
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"other positions", done.stderr)

    def test_json_of_verify(self):
        good = strict_json(output_of("verify", self.index, "--json"))
        self.assertEqual((good["ok"], good["problems"]), (True, []))
        cut = self.folder / "cut.geoidx"
        cut.write_bytes(self.index.read_bytes()[:-1])
        done = run("verify", cut, "--json")
        bad = strict_json(done.stdout)
        self.assertEqual((done.returncode, bad["ok"]), (1, False))
        self.assertEqual(done.stderr.count(b"\n"), 1)
        (problem,) = bad["problems"]
        self.assertEqual(list(problem), ["number", "byte", "kind", "message"])
        self.assertEqual((problem["number"], problem["byte"]), (5, cut.stat().st_size))  # ends too early, there
        self.assertIn(f"issue 5, byte {cut.stat().st_size}: ", run("verify", cut).stdout.decode())

    def path(self, *arguments):
        return output_of("path", self.index, self.mesh, "0", "6", *arguments).decode().splitlines()

    def test_path(self):
        for quality in ("straight", "exact"):
            length, *points = self.path("--quality", quality)
            self.assertAlmostEqual(float(length), math.sqrt(5), places=7)
            points = numpy.array([line.split() for line in points], float)
            numpy.testing.assert_allclose(points[[0, -1]], [CORNERS[0], CORNERS[6]], atol=1e-7)
            self.assertAlmostEqual(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1).sum(), math.sqrt(5), places=6)
        shown = strict_json(output_of("path", self.index, self.mesh, "0", "6", "--json"))
        self.assertEqual((shown["source"], shown["target"], shown["points"]), (0, 6, len(points)))

    def test_files_of_a_path(self):
        for name in ("way.obj", "way.ply", "way.csv"):
            self.assertEqual(len(self.path("-o", self.folder / name)), 1)
        obj = (self.folder / "way.obj").read_text().splitlines()
        count = sum(line.startswith("v ") for line in obj)
        self.assertEqual(obj[-1].split(), ["l", *map(str, range(1, count + 1))])
        rows = list(csv.DictReader((self.folder / "way.csv").open(newline="")))
        self.assertEqual(len(rows), count)
        self.assertAlmostEqual(float(rows[0]["x"]), CORNERS[0][0])
        self.assertIn(f"element vertex {count}\n", (self.folder / "way.ply").read_text())

    def test_picture_of_a_path(self):
        picture, plain = self.folder / "way.png", self.folder / "plain.png"
        self.assertEqual(self.path("--png", picture, "--size", "80x60"), self.path())
        output_of("msad", self.index, "0", "6", "--mesh", self.mesh, "--png", plain, "--size", "80x60")
        for file in (picture, plain):
            self.assertEqual(file.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertNotEqual(picture.read_bytes(), plain.read_bytes())

    def test_what_is_wrong_with_a_path(self):
        asked = ["path", self.index, self.mesh, "0"]
        done = run(*asked, "8")  # on the other box
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        self.assertIn(b"component", done.stderr)
        self.assertEqual(run(*asked, "6", "--png", "-").returncode, 2)
        self.assertEqual(run(*asked, "6", "--png", "x.png", "--size", "7x7").returncode, 2)
        self.assertEqual(run(*asked, "6", "-o", "way.txt").returncode, 2)
        same = self.folder / "same.csv"
        self.assertEqual(run(*asked, "6", "--png", same, "-o", same).returncode, 1)
        self.assertEqual(run(*asked, "6", "--png", self.mesh).returncode, 1)
        self.assertFalse(same.exists())

    def test_path_of_a_file_that_keeps_its_mesh(self):
        without = self.folder / "without.geoidx"
        for codec in ("lossless", "mapped", "packed"):
            whole = self.folder / f"whole_{codec}.geoidx"
            output_of("build", self.mesh, "-o", whole, "--store-mesh", "--codec", codec)
            for quality in ("straight", "exact"):
                asked = "0", "6", "--quality", quality
                self.assertEqual(output_of("path", whole, *asked), output_of("path", whole, self.mesh, *asked))
                self.assertEqual(output_of("path", whole, *asked).decode().splitlines(), self.path(*asked[2:]))
        shown = strict_json(output_of("info", whole, "--json"))
        self.assertEqual((shown["has_mesh"], shown["sections"][-1]["tag"]), (1, "MESH"))
        shown = strict_json(output_of("convert", whole, "-o", without, "--no-mesh", "--json"))
        self.assertEqual(shown["has_mesh"], 0)
        self.assertEqual(without.read_bytes(), self.index.read_bytes())

    def test_a_file_that_keeps_its_mesh_has_positions(self):
        """Without them it would not open by itself, so that the mesh would be of no use in it."""
        whole, bare = self.folder / "whole.geoidx", self.folder / "bare_whole.geoidx"
        output_of("build", self.mesh, "-o", whole, "--store-mesh")
        for asked in (("build", self.mesh, "--store-mesh"), ("convert", whole)):
            done = run(*asked, "-o", bare, "--no-positions")
            self.assertEqual((done.returncode, done.stdout), (2, b""))
            self.assertIn(b"--no-positions", done.stderr)
            self.assertFalse(bare.exists())
        output_of("convert", whole, "-o", bare, "--no-positions", "--no-mesh")
        done = run("path", bare, "0", "6")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"geoidx path FILE MESH A B", done.stderr)
        self.assertNotIn(b"--mesh", done.stderr)
        self.assertEqual(output_of("path", bare, self.mesh, "0", "6"), output_of("path", whole, "0", "6"))

    def test_path_without_a_mesh(self):
        whole = self.folder / "whole_again.geoidx"
        output_of("build", self.mesh, "-o", whole, "--store-mesh")
        for asked in ((self.index, "0", "6"), (self.index, self.mesh, "0"), (whole, "0"), (whole, "0", "1", "2", "3")):
            done = run("path", *asked)
            self.assertEqual((done.returncode, done.stdout), (2, b""))
        self.assertIn(b"keeps no mesh", run("path", self.index, "0", "6").stderr)
        done = run("path", whole, "0", "6", "--png", self.folder / "no.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"--png needs MESH", done.stderr)
        done = run("path", whole, "0", "16")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"vertex 16 is out of range", done.stderr)

    def test_json_of_bench(self):
        shown = strict_json(output_of("bench", self.index, "--queries", "3", "--seed", "9", "--json"))
        self.assertEqual((shown["queries"], shown["seed"], shown["vertex_count"]), (3, 9, 16))
        for key in ("sssd_median_us", "msad_median_us", "msad_median_ns_per_vertex"):
            self.assertGreaterEqual(shown[key], 0)

    def test_json_of_odd_names(self):
        names = {b'a"b\\c\n\x01.geoidx': 'a"b\\c\n\x01.geoidx', "Fläche 面.geoidx".encode(): "Fläche 面.geoidx"}
        # What is no UTF-8: a byte that begins nothing, one that lacks its second, and half of a surrogate pair.
        names[b"x\xff\xc3.geoidx"] = "x\ufffd\ufffd.geoidx"
        names[b"\xed\xa0\x80.geoidx"] = "\ufffd\ufffd\ufffd.geoidx"
        for name, shown_name in names.items():
            (self.folder / "odd").mkdir(exist_ok=True)
            output_of("build", self.mesh, "-o", name, cwd=self.folder / "odd")
            shown = strict_json(output_of("verify", name, "--json", cwd=self.folder / "odd"))
            self.assertEqual(shown["index"], shown_name)

    def test_failures_print_no_json(self):
        for arguments in (["build", self.mesh, "-o", self.folder], ["info", self.mesh], ["msad", self.index, "16"],
                          ["sssd", self.index, "0", "16"], ["exact", self.mesh, "16"], ["bench", self.mesh],
                          ["verify", self.folder]):
            done = run(*arguments, "--json")
            self.assertEqual((done.returncode, done.stdout, done.stderr.count(b"\n")), (1, b"", 1), arguments)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
