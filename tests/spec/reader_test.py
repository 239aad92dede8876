"""Holds the library's answers against those of a reader written from format/SPEC.md: reader_test.py TOOL FOLDER [MESHES]

Each mesh is built and asked with the command line tool. MESHES: a folder with spot.obj, which is used if it is there.
"""

import itertools
import json
import os
import pathlib
import subprocess
import sys
import unittest

import numpy

from container import Refused
from graph_engine import GraphEngine
from overlay_engine import OverlayEngine
from reader import NONE, OVERLAY, Index

TOOL, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
MESHES = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
TOLERANCE = 1e-5


def torus(around, across, bumps):
    """A torus with bumps, of which no two vertices lie alike."""
    u, v = numpy.meshgrid(numpy.arange(around) * 2 * numpy.pi / around, numpy.arange(across) * 2 * numpy.pi / across)
    small = 0.5 + bumps * numpy.sin(3 * u + 2 * v) * numpy.cos(2 * u - v)
    ring = 1.3 + small * numpy.cos(v)
    points = numpy.stack([ring * numpy.cos(u), ring * numpy.sin(u), small * numpy.sin(v)], axis=-1).reshape(-1, 3)
    at = numpy.arange(around * across).reshape(across, around)
    right, up = numpy.roll(at, -1, axis=1), numpy.roll(at, -1, axis=0)
    both = numpy.roll(right, -1, axis=0)
    corners = [numpy.stack(three, axis=-1).reshape(-1, 3) for three in ((at, right, both), (at, both, up))]
    return points, numpy.concatenate(corners)


def sheet(size, origin):
    """A jagged sheet with a boundary."""
    x, y = numpy.meshgrid(numpy.arange(size) / size, numpy.arange(size) / size)
    points = numpy.stack([x + origin + 0.02 * numpy.sin(17 * y), y, 0.1 * numpy.sin(9 * x * y)], axis=-1).reshape(-1, 3)
    at = numpy.arange(size * size).reshape(size, size)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    return points, numpy.concatenate([numpy.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])


def walls(size):
    """Six half planes that begin at one line: its edges have six triangles each, where borders meet."""
    parts, count = [], 0
    for half_plane in range(6):
        points, triangles = sheet(size, 0)
        x, y = points[:, 0] - 0.02 * numpy.sin(17 * points[:, 1]), points[:, 1]
        angle = half_plane * numpy.pi / 3
        parts.append((numpy.stack([x * numpy.cos(angle), x * numpy.sin(angle), y], axis=-1), triangles + count))
        count += len(points)
    points, triangles = (numpy.concatenate(arrays) for arrays in zip(*parts))
    points[numpy.abs(points) < 1e-9] = 0
    return points, triangles


def write_procedural(path):
    """A torus, a sheet that no path leads to, an id that no triangle uses and one that repeats another's position."""
    parts = [torus(40, 20, 0.08), sheet(14, 4.0)]
    points = numpy.concatenate([parts[0][0], parts[1][0], [[9, 9, 9]], parts[0][0][:1]])
    triangles = numpy.concatenate([parts[0][1], parts[1][1] + len(parts[0][0])])
    triangles[-1] = [len(points) - 1, triangles[0][1], triangles[0][2]]
    write_off(path, points, triangles)
    return points, triangles


def write_off(path, points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, map(float, point))) for point in points]
    lines += [" ".join(map(str, [3, *triangle])) for triangle in triangles]
    path.write_text("\n".join(lines) + "\n")


def run(*arguments):
    return subprocess.run([TOOL, *map(str, arguments)], check=True, stdout=subprocess.PIPE).stdout


class Subject:
    """An index that the tool built, and the reader's engine on it."""

    def __init__(self, mesh, name, *options):
        self.path = FOLDER / f"{name}.geoidx"
        run("build", mesh, "-o", self.path, *options)
        self.index = Index(self.path)
        self.require_same_tables("lossless", 1)
        self.require_same_tables("mapped", 2)
        self.engine = (OverlayEngine if self.index.engine == OVERLAY else GraphEngine)(self.index)

    def require_same_tables(self, codec, number):
        """The file in another form holds the same entries."""
        if self.index.engine != OVERLAY:
            return
        converted = FOLDER / f"{codec}.geoidx"
        run("convert", self.path, "-o", converted, "--codec", codec)
        other = Index(converted)
        assert (self.index.codec, other.codec) == (0, number)
        numpy.testing.assert_array_equal(self.index.quantum, other.quantum)
        for mine, others in zip(self.index.overlay_table, other.overlay_table):
            numpy.testing.assert_array_equal(mine, others)
        for leaf in self.index.leaves:
            numpy.testing.assert_array_equal(self.index.border_internal[leaf], other.border_internal[leaf])
            numpy.testing.assert_array_equal(self.index.internal[leaf], other.internal[leaf])

    def msad_by_library(self, sources):
        fields = FOLDER / "field.npy"
        run("msad", self.path, *sources, "-o", fields)
        return numpy.load(fields).astype(float)

    def msad_by_reader(self, sources):
        of_id = self.index.number_of_id
        used = of_id != NONE
        distance = numpy.full(len(of_id), numpy.inf)
        numbers = sorted({int(of_id[source]) for source in sources if used[source]})
        if numbers:
            distance[used] = self.engine.msad(numbers)[of_id[used]]
        distance[list(sources)] = 0
        return distance

    def sssd_by_library(self, pairs):
        answers = json.loads(run("sssd", "--json", self.path, *pairs.ravel()))["pairs"]
        return numpy.array([numpy.inf if a["distance"] is None else a["distance"] for a in answers])

    def sssd_by_reader(self, pairs):
        return numpy.array([self._pair(int(a), int(b)) for a, b in pairs])

    def _pair(self, a, b):
        numbers = [int(self.index.number_of_id[vertex]) for vertex in (a, b)]
        if a == b:
            return 0.0
        return numpy.inf if NONE in numbers else float(self.engine.sssd(*numbers))


def excess(library, reader):
    """How much longer the library's answers are, relatively; both have a path to the same vertices."""
    numpy.testing.assert_array_equal(numpy.isinf(library), numpy.isinf(reader))
    numpy.testing.assert_array_equal(library == 0, reader == 0)
    is_there = numpy.isfinite(reader) & (reader > 0)
    return (library[is_there] - reader[is_there]) / reader[is_there]


class ReaderTest(unittest.TestCase):
    PAIRS = int(os.environ.get("GEOIDX_READER_PAIRS", 60))

    def check(self, mesh, name, *options):
        subject = Subject(mesh, name, *options)
        random, count = numpy.random.default_rng(1), subject.index.id_count
        # Enough levels for every step of the document: up over several, across, down over several.
        self.assertGreaterEqual(subject.index.levels, 2)
        sources = [[int(s)] for s in random.integers(count, size=8)] + [[0], [count - 1], [count - 2]]
        sources += [random.integers(count, size=n).tolist() for n in (2, 3, 7, 20, 60)]
        for source in random.integers(count, size=8).tolist():
            sources.append(self.near(subject, source, 4, 40, 12))
        for several in sources:
            with self.subTest(sources=several):
                off = excess(subject.msad_by_library(several), subject.msad_by_reader(several))
                self.assertLessEqual(numpy.abs(off).max(initial=0), TOLERANCE)
        self.check_pairs(subject, self.pairs(subject, random))
        return subject.index

    def pairs(self, subject, random):
        """Some anywhere, and some that are near each other."""
        pairs = random.integers(subject.index.id_count, size=(self.PAIRS, 2)).tolist()
        pairs += [[0, subject.index.id_count - 1], [0, subject.index.id_count - 2], [3, 3]]
        for source in random.integers(subject.index.id_count, size=10).tolist():
            pairs += [[source, target] for target in self.near(subject, source, 1, 30, 4)]
        return numpy.array(pairs)

    def near(self, subject, source, *those):
        """Of all vertices by their distance, a slice."""
        return numpy.argsort(subject.msad_by_reader([source]), kind="stable")[slice(*those)].tolist()

    def check_pairs(self, subject, pairs):
        off = excess(subject.sssd_by_library(pairs), subject.sssd_by_reader(pairs))
        self.assertGreater(len(off), self.PAIRS // 2)
        self.assertLessEqual(numpy.abs(off).max(), TOLERANCE)

    def procedural(self, name, *options):
        mesh = FOLDER / "procedural.off"
        write_procedural(mesh)
        return self.check(mesh, f"procedural_{name}", "--patches", "4,3", *options)

    def test_overlay_engine(self):
        self.procedural("overlay", "--engine", "overlay")

    def test_added_vertices(self):
        named = {}
        for target_error in ("0", "1e-9"):
            index = self.procedural("added", "--target-error", target_error)
            named[target_error] = (len(set(index.number_of_id.tolist()) - {NONE}), index.vertex_count)
        self.assertEqual(named["0"][0], named["0"][1])
        self.assertEqual(named["1e-9"][0], named["0"][0])
        self.assertGreater(named["1e-9"][1], named["1e-9"][0])

    def test_overlay_engine_without_segments(self):
        self.procedural("edges", "--engine", "overlay", "--metric", "edges")

    def test_bridges(self):
        mesh = FOLDER / "walls.off"
        write_off(mesh, *walls(14))
        index = self.check(mesh, "walls", "--patches", "4,4", "--engine", "overlay")
        self.assertGreater(sum(map(len, index.bridges)), 10)

    def test_graph_engine(self):
        self.procedural("graph", "--engine", "graph")

    def test_measured_pairs(self):
        """A sheet so rough that tables are wrong for many near pairs. Those that they have too short, and one more source."""
        mesh = self.rough_sheet(26)
        index = self.check(mesh, "rough", "--target-error", "0")
        subject, id_of = Subject(mesh, "rough", "--target-error", "0"), numpy.argsort(index.number_of_id)
        checked = {True: 0, False: 0}
        for source in index.measured:
            field = subject.engine.ssad(source)
            too_short = [b for b, measured in index.measured[source].items() if field[b] < 0.99 * measured]
            for number in too_short:
                is_border = index.is_border(number)
                checked[is_border] += 1
                if checked[is_border] <= 8:
                    several = [int(id_of[source]), int(id_of[numpy.argmax(field)])]
                    off = excess(subject.msad_by_library(several), subject.msad_by_reader(several))
                    self.assertLessEqual(numpy.abs(off).max(initial=0), TOLERANCE)
        self.assertGreater(min(checked.values()), 8)

    def test_steep_edges(self):
        """Sources of which fields are lowered, and two of them together."""
        subject = Subject(self.rough_sheet(38), "steep", "--target-error", "0")
        id_of = numpy.argsort(subject.index.number_of_id)
        some = range(0, subject.index.vertex_count, 5)
        lowered = list(itertools.islice((source for source in some if self.is_lowered(subject, source)), 12))
        last = next(source for source in reversed(some) if self.is_lowered(subject, source))
        self.assertGreater(len(lowered), 8)
        for sources in [[source] for source in lowered[:8]] + [[lowered[0], last]]:
            ids = [int(id_of[source]) for source in sources]
            off = excess(subject.msad_by_library(ids), subject.msad_by_reader(ids))
            self.assertLessEqual(numpy.abs(off).max(initial=0), TOLERANCE)

    def is_lowered(self, subject, source):
        steep = dict(subject.index.steep)
        field = subject.engine.msad([source])
        subject.index.steep.clear()
        before = subject.engine.msad([source])
        subject.index.steep.update(steep)
        return (before != field).any()

    def rough_sheet(self, side):
        points, triangles = sheet(side, 0.0)
        points[:, 2] = numpy.random.default_rng(2).random(len(points)) / 4
        mesh = FOLDER / f"rough{side}.off"
        write_off(mesh, points, triangles)
        return mesh

    def test_large_overlays(self):
        """Of these, a mapped file has distances among owned vertices once."""
        x, y = numpy.meshgrid(numpy.arange(330) / 20, numpy.arange(14))
        points = numpy.stack([x, y, numpy.sin(x * y)], axis=-1).reshape(-1, 3)
        at = numpy.arange(330 * 14).reshape(14, 330)
        corners = (at[:-1, :-1], at[:-1, 1:], at[1:, 1:]), (at[:-1, :-1], at[1:, 1:], at[1:, :-1])
        mesh = FOLDER / "large.off"
        write_off(mesh, points, numpy.concatenate([numpy.stack(c, axis=-1).reshape(-1, 3) for c in corners]))
        Subject(mesh, "large", "--patches", "2,2,3", "--metric", "edges")  # which is quick to build
        self.assertGreater(len(Index(FOLDER / "mapped.geoidx").large), 1)

    def test_positions_that_are_left_out(self):
        mesh = FOLDER / "far_off.off"
        points, triangles = write_procedural(mesh)
        points = points + 1000  # where floats are so far apart that steps tell them from doubles
        write_off(mesh, points, triangles)
        for engine in ("overlay", "graph"):
            for codec in ("packed", "lossless", "mapped"):
                with self.subTest(engine=engine, codec=codec):
                    paths = [FOLDER / f"{name}.geoidx" for name in ("whole", "bare")]
                    for path, more in zip(paths, ([], ["--no-positions"])):
                        run("build", mesh, "-o", path, "--engine", engine, "--codec", codec, "--patches", "4,3", *more)
                    whole, bare = Index(paths[0]), Index(paths[1], (points, triangles))
                    self.assertTrue(whole.has_positions and not bare.has_positions)
                    self.assert_same(whole, bare)
                    with self.assertRaisesRegex(Refused, "no mesh"):
                        Index(paths[1])
                    with self.assertRaisesRegex(Refused, "checksum of the positions"):
                        Index(paths[1], (points.astype("f4"), triangles))

    def test_mesh_that_is_kept(self):
        mesh, kept, without = (FOLDER / name for name in ("kept.off", "kept.geoidx", "without.geoidx"))
        points, triangles = write_procedural(mesh)
        self.assertLess(points.min(), 0)  # of either sign, so that differences of bits wrap around
        for engine in ("overlay", "graph"):
            for codec in ("packed", "lossless", "mapped"):
                with self.subTest(engine=engine, codec=codec):
                    form = ("--engine", engine, "--codec", codec, "--patches", "4,3")
                    run("build", mesh, "-o", kept, *form, "--store-mesh")
                    index = Index(kept)
                    found_points, found_triangles = index.kept_mesh()
                    self.assertEqual(found_points.tobytes(), points.astype("<f8").tobytes())
                    numpy.testing.assert_array_equal(found_triangles, triangles)
                    run("convert", kept, "-o", without, "--codec", codec, "--no-mesh")
                    self.assertIsNone(Index(without).kept_mesh())
                    self.assert_same(index, Index(without))

    def assert_same(self, a, b):
        numpy.testing.assert_array_equal(a.positions, b.positions)
        for leaf in a.leaves:
            numpy.testing.assert_array_equal(a.border_internal[leaf], b.border_internal[leaf])
            numpy.testing.assert_array_equal(a.internal[leaf], b.internal[leaf])

    def spot(self):
        mesh = MESHES / "spot.obj" if MESHES else None
        if not mesh or not mesh.exists():
            self.skipTest("spot.obj is not there")
        return mesh

    def test_overlay_engine_on_spot(self):
        self.check(self.spot(), "spot_overlay", "--engine", "overlay")

    def test_graph_engine_on_spot(self):
        self.check(self.spot(), "spot_graph", "--engine", "graph", "--patches", "5,5")


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    numpy.seterr(invalid="ignore", divide="ignore")
    unittest.main(argv=sys.argv[:1], verbosity=2)
