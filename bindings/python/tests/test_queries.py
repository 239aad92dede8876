"""Shapes, broadcasting and bits of the queries of an index, a query and a solver."""

import math
import tracemalloc
import unittest
from unittest import mock

import numpy as np
from meshes import hills, plane, straight

import geoidx
from geoidx import _matrix, _query

EXACT_ON_A_PLANE = ("overlay", (3,)), ("overlay", (1,)), ("graph", (1,))
"""Engines and patches whose distances on a small plane are straight, or nearly so."""


class Queries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = hills(17, 15)
        cls.n = len(cls.mesh[0])
        cls.index = geoidx.Index.build(*cls.mesh, patches=(4, 3))
        cls.query = cls.index.query()


class FarthestPoints(Queries):
    def test_each_is_as_far_from_those_before_it_as_any_vertex(self):
        points = self.index.farthest_points(6, sources=[5])
        self.assertEqual(points.dtype, np.uint32)
        nearest = self.index.msad(5)
        for point in points:
            self.assertEqual(nearest[point], nearest.max())
            nearest = np.minimum(nearest, self.index.msad(point))
        np.testing.assert_array_equal(self.query.farthest_points(6, sources=5), points)

    def test_there_are_no_more_than_vertices(self):
        points = self.index.farthest_points(self.n + 3)
        self.assertEqual(sorted([0, *points]), list(range(self.n)))

    def test_what_is_wrong_is_refused(self):
        for count, sources in ((1, []), (1, [self.n]), (-1, [0])):
            with self.assertRaises(geoidx.InvalidArgumentError):
                self.index.farthest_points(count, sources=sources)


class Sssd(Queries):
    def test_two_vertices_give_a_float(self):
        for a, b in ((3, 200), (np.int64(3), np.uint8(200)), (np.array(3), 200)):
            distance = self.index.sssd(a, b)
            self.assertIs(type(distance), float)
            self.assertEqual(distance, self.index.sssd(200, 3))
        self.assertEqual(self.index.sssd(7, 7), 0)
        self.assertEqual(self.query.sssd(3, 200), self.index.sssd(3, 200))

    def test_arrays_are_broadcast(self):
        a = np.array([[3], [50]])
        b = np.array([200, 7, 100])
        distances = self.index.sssd(a, b)
        self.assertEqual((distances.shape, distances.dtype), ((2, 3), np.float32))
        for i in range(2):
            for j in range(3):
                self.assertEqual(distances[i, j], self.index.sssd(int(a[i, 0]), int(b[j])))
        np.testing.assert_array_equal(self.index.sssd(3, b), distances[0])
        np.testing.assert_array_equal(self.index.sssd([3, 3, 3], list(b)), distances[0])
        self.assertEqual(self.index.sssd([3], 200).shape, (1,))
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, r"\(2,\) and \(3,\)"):
            self.index.sssd([1, 2], [1, 2, 3])

    def test_no_pairs(self):
        self.assertEqual(self.index.sssd([], []).shape, (0,))
        self.assertEqual(self.index.sssd(np.empty((2, 0), np.uint32), 4).shape, (2, 0))

    def test_near_the_exact_distance(self):
        exact = geoidx.Solver(*self.mesh).distances(3)
        np.testing.assert_allclose(self.index.sssd(3, np.arange(self.n)), exact, rtol=0.2)


class Matrix(Queries):
    def assert_one_way(self, sources, targets, matrix):
        """Of the two lists as they are: pairs, or fields from the sources, or fields from the targets."""
        ways = [
            self.index.sssd(sources[:, None], targets),
            self.index.ssad(sources)[:, targets],
            self.index.ssad(targets)[:, sources].T,
        ]
        self.assertTrue(any(np.array_equal(matrix, way) for way in ways))

    def test_every_entry_is_found_in_the_same_way(self):
        a, b = np.array([5, 0, 250]), np.array([9, 200, 5, 5])
        everything = np.arange(self.n)
        for asked in (self.index, self.query):
            for sources, targets in ((a, b), (b, a), (a, everything), (everything, a), (everything, everything[::-1])):
                matrix = asked.matrix(sources, targets)
                self.assertEqual((matrix.shape, matrix.dtype), ((len(sources), len(targets)), np.float32))
                self.assert_one_way(sources, targets, matrix)
                np.testing.assert_array_equal(matrix, self.index.matrix(sources, targets))
            self.assertFalse(asked.matrix(a, b)[0, 2:].any())

    def test_shapes(self):
        a, b = [5, 0, 250], [9, 200, 5, 5]
        for asked in (self.index, self.query):
            np.testing.assert_array_equal(asked.matrix(a), asked.matrix(a, a))
            self.assertEqual(asked.matrix([], b).shape, (0, 4))
            self.assertEqual(asked.matrix(a, []).shape, (3, 0))
            self.assertEqual(asked.matrix([]).shape, (0, 0))
            self.assertEqual(asked.matrix(4, b).shape, (1, 4))
            self.assertEqual(asked.matrix(4).shape, (1, 1))
            with self.assertRaises(geoidx.InvalidArgumentError):
                asked.matrix([a], b)

    def test_one_pair_is_sssd(self):
        self.assertEqual(self.index.matrix(5, 200), self.index.sssd(5, 200))
        self.assertEqual(self.query.matrix(200, 5), self.index.sssd(5, 200))

    def test_many_columns_are_fields_of_the_rows(self):
        a, b = np.arange(3, 22), np.arange(self.n)[::-1].repeat(2)
        fields = self.index.ssad(a)[:, b]
        self.assertTrue((fields != self.index.sssd(a[:, None], b)).any())  # the test can tell them apart
        np.testing.assert_array_equal(self.index.matrix(a, b), fields)
        np.testing.assert_array_equal(self.index.matrix(b, a), fields.T)

    def test_equal_rows_and_columns_are_symmetric(self):
        a = np.random.default_rng(5).permutation(self.n)
        fields = self.index.ssad(a)[:, a]
        self.assertTrue((fields != fields.T).any())
        for asked in (self.index, self.query):
            for a_again in (None, list(a)):
                matrix = asked.matrix(a, a_again)
                np.testing.assert_array_equal(matrix, matrix.T)
                np.testing.assert_array_equal(matrix, (fields + fields.T) / 2)
                self.assertFalse(np.diag(matrix).any())
            for count in (1, 2, 9, 24):
                matrix = asked.matrix(a[:count])
                np.testing.assert_array_equal(matrix, matrix.T)
                self.assertFalse(np.diag(matrix).any())

    def test_strips_of_a_few_entries(self):
        for at_once in (1, 30, 255):
            with mock.patch.object(_matrix, "_ENTRIES_AT_ONCE", at_once):
                self.test_equal_rows_and_columns_are_symmetric()

    def test_by_the_graph_engine(self):
        index = geoidx.Index.build(*self.mesh, engine="graph")
        a, b = np.arange(40), np.arange(100, 150)
        for rows, columns in ((a, b), (b, a), (a, a), (a[:2], b[:2]), (a[:2], a[:2])):
            matrix = index.matrix(rows, columns)
            np.testing.assert_allclose(matrix, index.sssd(rows[:, None], columns), rtol=1e-5)

    def test_separate_parts_and_vertices_of_no_triangle(self):
        vertices, faces = plane(6, 6)
        two = np.concatenate([vertices, vertices + 10, [[0, 0, 50]]]), np.concatenate([faces, faces + 36])
        index = geoidx.Index.build(*two)
        part = np.arange(73) // 36
        everything = index.matrix(np.arange(73))
        np.testing.assert_array_equal(np.isinf(everything), part[:, None] != part)
        for few in ([0, 40, 72], [72]):
            np.testing.assert_array_equal(np.isinf(index.matrix(few)), np.isinf(everything[np.ix_(few, few)]))
            self.assertFalse(np.diag(index.matrix(few)).any())

    def test_a_vertex_out_of_range(self):
        few, many = np.arange(3), np.arange(self.n)
        for good in (few, many):
            bad = good.copy()
            bad[-1] = self.n
            for a, b in ((good, bad), (bad, good), (bad, bad), (bad, few), (few, bad)):
                out = np.full((len(a), len(b)), -1, np.float32)
                with self.assertRaisesRegex(geoidx.InvalidArgumentError, f"vertex {self.n} is out of range"):
                    self.index.matrix(a, b, out=out)
                self.assertTrue((out == -1).all())

    def test_scratch_does_not_grow_with_the_rows(self):
        a, b = np.arange(400) % self.n, np.arange(401) % self.n
        out = np.empty((400, 401), np.float32)
        tracemalloc.start()
        self.index.matrix(a, b, out=out)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        self.assertLess(peak, 400 * self.n * 4 / 3)

    def test_out(self):
        out = np.empty((2, 2), np.float32)
        self.assertIs(self.index.matrix([1, 2], out=out), out)
        np.testing.assert_array_equal(out, self.index.matrix([1, 2]))


class Nearest(Queries):
    def test_no_other_source_is_nearer(self):
        sources = [5, 200, 41, 120]
        exact = np.stack([geoidx.Solver(*self.mesh).distances(source) for source in sources])
        nearest, second = np.sort(exact, axis=0)[:2]
        clear = second > 1.2 * nearest
        self.assertGreater(clear.sum(), self.n / 2)
        everywhere = self.index.nearest(sources)
        for asked in (self.index, self.query):
            out = np.zeros(self.n, np.float32)
            positions = asked.nearest(sources, out=out)
            self.assertEqual((positions.shape, positions.dtype), ((self.n,), np.uint32))
            np.testing.assert_array_equal(positions[clear], exact.argmin(axis=0)[clear])
            np.testing.assert_array_equal(positions[sources], np.arange(4))
            own = self.index.ssad(sources)[positions, np.arange(self.n)]
            np.testing.assert_allclose(own, self.index.msad(sources), rtol=0.02)
            np.testing.assert_array_equal(out, self.index.msad(sources))
            np.testing.assert_array_equal(asked.nearest(sources), everywhere)

    def test_halves_of_a_plane(self):
        vertices, faces = plane(20, 4)
        index = geoidx.Index.build(vertices, faces, patches=(3,))
        np.testing.assert_array_equal(index.nearest([20, 39]), vertices[:, 0] > 9.5)
        np.testing.assert_array_equal(index.nearest([39, 20]), vertices[:, 0] < 9.5)

    def test_one_source_and_repeated_ones(self):
        for asked in (self.index, self.query):
            self.assertFalse(asked.nearest(7).any())
            self.assertFalse(asked.nearest([7, 7]).any())
            positions = asked.nearest([5, 200, 5, 200])
            np.testing.assert_array_equal(positions, asked.nearest([5, 200]))

    def test_where_no_source_is_reached(self):
        self.assertEqual(geoidx.NO_SOURCE, 0xFFFFFFFF)
        vertices, faces = plane(3, 3)
        two = np.concatenate([vertices, vertices + 10, [[0, 0, 50]]]), np.concatenate([faces, faces + 9])
        for engine in geoidx.Engine:
            index = geoidx.Index.build(*two, engine=engine)
            out = np.zeros(19, np.float32)
            positions = index.nearest([12, 3], out=out)
            np.testing.assert_array_equal(positions, [1] * 9 + [0] * 9 + [geoidx.NO_SOURCE])
            np.testing.assert_array_equal(out, index.msad([12, 3]))
            positions = index.nearest(18)
            np.testing.assert_array_equal(positions, [geoidx.NO_SOURCE] * 18 + [0])

    def test_what_is_wrong_is_refused(self):
        for asked in (self.index, self.query):
            for sources in ([], [self.n], [[1, 2]]):
                with self.assertRaises(geoidx.InvalidArgumentError):
                    asked.nearest(sources)
            with self.assertRaises(geoidx.InvalidArgumentError):
                asked.nearest(4, out=np.zeros(self.n + 1, np.float32))
            with self.assertRaises(TypeError):
                asked.nearest(4, out=np.zeros(self.n))


class Within(Queries):
    def assert_in_order(self, vertices, distances, field):
        """They are all vertices that the field reaches, with its distances."""
        order = np.lexsort((np.arange(field.size), field))[: np.isfinite(field).sum()]
        self.assertEqual((vertices.dtype, distances.dtype), (np.uint32, np.float32))
        np.testing.assert_array_equal(vertices, order)
        np.testing.assert_array_equal(distances, field[order])

    def test_a_disk_of_a_plane(self):
        mesh = plane(9, 9)
        exact = straight(mesh[0], 40, np.arange(81))
        for engine, patches in EXACT_ON_A_PLANE:
            vertices, distances = geoidx.Index.build(*mesh, engine=engine, patches=patches).within(40, 2.5)
            self.assertEqual(sorted(vertices), list(np.flatnonzero(exact < 2.5)))
            self.assertEqual((vertices[0], distances[0]), (40, 0))
            np.testing.assert_allclose(distances, exact[vertices], rtol=0.02)
            self.assertTrue((np.diff(distances) >= 0).all())

    def test_of_one_source_as_msad(self):
        for asked in (self.index, self.query):
            for radius in (0, 1.5, 5, 1e300, math.inf):
                self.assert_in_order(*asked.within(4, radius), asked.msad(4, radius=radius))

    def test_of_several_sources_the_least(self):
        for asked in (self.index, self.query):
            for radius in (2, 5.5):
                field = np.min([asked.msad(source, radius=radius) for source in (4, 240, 120)], axis=0)
                self.assert_in_order(*asked.within([240, 4, 120, 4], radius), field)

    def test_the_sources_alone(self):
        for asked in (self.index, self.query):
            vertices, distances = asked.within([9, 4, 9], 0)
            np.testing.assert_array_equal(vertices, [4, 9])
            np.testing.assert_array_equal(distances, [0, 0])

    def test_more_than_there_is_room_for_at_first(self):
        expected = self.query.within([4, 240], 5)
        count = len(expected[0])
        self.assertTrue(10 < count < self.n)
        for room in (1, count - 1, count, count + 1):
            with mock.patch.object(_query, "_LIKELY_COUNT", room):
                for asked in (self.index, self.query):
                    for found, wanted in zip(asked.within([4, 240], 5), expected):
                        np.testing.assert_array_equal(found, wanted)

    def test_separate_parts(self):
        vertices, faces = plane(3, 3)
        index = geoidx.Index.build(np.concatenate([vertices, vertices + 10]), np.concatenate([faces, faces + 9]))
        self.assertEqual(sorted(index.within(0, 100)[0]), list(range(9)))
        self.assertEqual(sorted(index.within([10, 3], 100)[0]), list(range(18)))

    def test_what_is_wrong_is_refused(self):
        for asked in (self.index, self.query):
            for sources in ([], [self.n], [[1, 2]]):
                with self.assertRaises(geoidx.InvalidArgumentError):
                    asked.within(sources, 1)
            for radius in (-1, math.nan, 10**400):
                with self.assertRaisesRegex(geoidx.InvalidArgumentError, "radius"):
                    asked.within(4, radius)
            for radius in ("5", None, [5]):
                with self.assertRaises(TypeError):
                    asked.within(4, radius)


class NearestTargets(Queries):
    def test_on_a_plane(self):
        mesh = plane(9, 9)
        targets = [80, 10, 4, 10, 0]
        for engine, patches in EXACT_ON_A_PLANE:
            index = geoidx.Index.build(*mesh, engine=engine, patches=patches)
            for count in (0, 1, 3, 5, 6, 0xFFFFFFFF):
                positions, distances = index.nearest_targets(0, targets, count)
                self.assertEqual((positions.dtype, distances.dtype), (np.uint32, np.float32))
                np.testing.assert_array_equal(positions, [4, 1, 3, 2, 0][:count])
                expected = np.sqrt([0, 2, 2, 16, 128])[:count]
                np.testing.assert_allclose(distances, expected, rtol=0.02)

    def test_no_other_target_is_nearer(self):
        field = self.index.msad(100)
        exact = geoidx.Solver(*self.mesh).distances(100)
        targets = np.random.default_rng(3).permutation(self.n)
        for asked in (self.index, self.query):
            for some in (targets[:6], targets[:60], targets, targets.repeat(2)):
                for count in (1, 5, len(some)):
                    positions, distances = asked.nearest_targets(100, some, count)
                    self.assertEqual((len(positions), len(distances)), (min(count, len(some)),) * 2)
                    self.assertEqual(len(set(positions)), len(positions))
                    self.assertTrue((np.diff(distances) >= 0).all())
                    np.testing.assert_allclose(distances, field[some[positions]], rtol=0.05)
                    others = np.delete(exact[some], positions)
                    self.assertTrue((others >= 0.8 * distances[-1]).all())

    def test_as_the_query_does(self):
        targets = [250, 7, 41, 8, 120, 7]
        expected = self.query.nearest_targets(4, targets, 4)
        for found, wanted in zip(self.index.nearest_targets(4, targets, 4), expected):
            np.testing.assert_array_equal(found, wanted)

    def test_targets_that_cannot_be_reached(self):
        vertices, faces = plane(3, 3)
        two = np.concatenate([vertices, vertices + 10, [[0, 0, 50]]]), np.concatenate([faces, faces + 9])
        for engine in geoidx.Engine:
            index = geoidx.Index.build(*two, engine=engine)
            positions, distances = index.nearest_targets(0, [12, 3, 18, 1], 4)
            np.testing.assert_array_equal(positions, [1, 3])
            np.testing.assert_allclose(distances, [1, 1], rtol=1e-3)
            self.assertEqual(index.nearest_targets(18, [0, 12], 2)[0].size, 0)

    def test_one_target_and_none(self):
        for asked in (self.index, self.query):
            positions, distances = asked.nearest_targets(4, 240, 1)
            np.testing.assert_array_equal(positions, [0])
            np.testing.assert_allclose(distances, self.index.sssd(4, 240), rtol=0.02)
            self.assertEqual([found.size for found in asked.nearest_targets(4, [], 3)], [0, 0])

    def test_what_is_wrong_is_refused(self):
        for asked in (self.index, self.query):
            for source, targets, count in ((self.n, [0], 1), (0, [self.n], 1), (0, [[1]], 1), (0, [1], -1)):
                with self.assertRaises(geoidx.InvalidArgumentError):
                    asked.nearest_targets(source, targets, count)
            with self.assertRaises(TypeError):
                asked.nearest_targets(0, [1], 1.0)


class Fields(Queries):
    def test_msad_is_the_nearest_source(self):
        for asked in (self.index, self.query):
            one, other = asked.msad(4), asked.msad([240])
            self.assertEqual((one.shape, one.dtype), ((self.n,), np.float32))
            both = asked.msad([4, 240])
            np.testing.assert_allclose(both, np.minimum(one, other), rtol=1e-3)
            self.assertEqual((both[4], both[240]), (0, 0))

    def test_ssad_is_msad_of_each_source(self):
        for asked in (self.index, self.query):
            sources = [4, 240, 4, *range(20)]
            fields = asked.ssad(sources)
            self.assertEqual((fields.shape, fields.dtype), ((23, self.n), np.float32))
            for source, field in zip(sources, fields):
                np.testing.assert_array_equal(field, asked.msad(source))
            np.testing.assert_array_equal(asked.ssad(4), asked.msad(4))
            self.assertEqual(asked.ssad([]).shape, (0, self.n))
            with self.assertRaises(geoidx.InvalidArgumentError):
                asked.ssad([[1, 2]])

    def test_radius(self):
        everything = self.index.msad([4, 240])
        for asked in (self.index, self.query):
            near = asked.msad([4, 240], radius=5)
            np.testing.assert_array_equal(near, np.where(everything <= 5, everything, np.inf))
            np.testing.assert_array_equal(asked.msad(4, radius=math.inf), asked.msad(4))
            for radius in (-1, math.nan):
                with self.assertRaisesRegex(geoidx.InvalidArgumentError, "radius"):
                    asked.msad(4, radius=radius)
            np.testing.assert_array_equal(asked.msad(4, radius=1e300), asked.msad(4))
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "radius"):
                asked.msad(4, radius=10**400)
            for radius in ("5", None, [5]):
                with self.assertRaises(TypeError):
                    asked.msad(4, radius=radius)

    def test_out(self):
        for asked in (self.index, self.query):
            out = np.zeros(self.n, np.float32)
            self.assertIs(asked.msad(4, out=out), out)
            np.testing.assert_array_equal(out, self.index.msad(4))
            self.assertIs(asked.msad(4, radius=2, out=out), out)
            rows = np.zeros((5, self.n), np.float32)
            self.assertTrue(np.shares_memory(asked.ssad([4, 5], out=rows[1:3]), rows))
            np.testing.assert_array_equal(rows[1], self.index.msad(4))
            self.assertFalse(rows[[0, 3, 4]].any())

    def test_out_that_cannot_be_written_to(self):
        n = self.n
        read_only = np.zeros(n, np.float32)
        read_only.flags.writeable = False
        unaligned = np.zeros(4 * n + 1, np.uint8)[1:].view(np.float32)
        for out in (np.zeros(n), np.zeros(n, ">f4"), [0.0] * n):
            with self.assertRaises(TypeError):
                self.index.msad(4, out=out)
        for out in (np.zeros(n + 1, np.float32), np.zeros(2 * n, np.float32)[::2], read_only, unaligned):
            with self.assertRaises(geoidx.InvalidArgumentError):
                self.index.msad(4, out=out)

    def test_no_source(self):
        for asked in (self.index, self.query):
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "no source"):
                asked.msad([])

    def test_unreachable(self):
        vertices, faces = plane(3, 3)
        two = np.concatenate([vertices, vertices + 10, [[0, 0, 50]]]), np.concatenate([faces, faces + 9])
        index = geoidx.Index.build(*two)
        field = index.msad(0)
        self.assertTrue(np.isfinite(field[:9]).all())
        self.assertTrue((field[9:] == np.inf).all())
        self.assertEqual(index.sssd(0, 18), math.inf)
        self.assertEqual(geoidx.Solver(*two).distances(0, 12), math.inf)


class Prepared(Queries):
    def test_near_the_field(self):
        self.query.prepare(4)
        targets = np.arange(self.n)
        distances = self.query.prepared(targets)
        np.testing.assert_allclose(distances, self.index.msad(4), rtol=0.05)
        self.assertEqual(self.query.prepared(targets[:6].reshape(2, 3)).shape, (2, 3))
        self.assertEqual(self.query.prepared([]).shape, (0,))
        out = np.zeros(self.n, np.float32)
        self.assertIs(self.query.prepared(targets, out=out), out)
        np.testing.assert_array_equal(out, distances)
        one = self.query.prepared(9)
        self.assertIs(type(one), float)
        self.assertEqual(one, distances[9])

    def test_without_a_source(self):
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "prepared"):
            self.index.query().prepared([1])


class Threads(Queries):
    def test_the_same_bits(self):
        expected = self.index.msad([4, 240])
        nearest = self.index.nearest([4, 240])
        for threads in (1, 2, 0):
            with self.index.query(threads=threads) as query:
                self.assertEqual(query.threads, threads)
                np.testing.assert_array_equal(query.msad([4, 240]), expected)
                np.testing.assert_array_equal(query.nearest([4, 240]), nearest)

    def test_out_of_range(self):
        for threads in (-1, 1025, 1 << 40):
            with self.assertRaises(geoidx.InvalidArgumentError):
                self.query.threads = threads
        self.assertEqual(self.query.threads, 1)


class Ids(Queries):
    """Ids that are none, in every call that takes some."""

    def calls(self):
        solver = geoidx.Solver(*self.mesh)
        self.query.prepare(0)
        yield lambda v: self.index.sssd(v, 0)
        yield lambda v: self.index.sssd([0, 1], [v, v])
        for asked in (self.index, self.query):
            yield lambda v: asked.matrix([0, v])
            yield lambda v: asked.matrix([0], [v])
            yield lambda v: asked.nearest([0, v])
            yield lambda v: asked.within([0, v], 1.0)
            yield lambda v: asked.nearest_targets(v, [0], 1)
            yield lambda v: asked.nearest_targets(0, [0, v], 1)
            yield lambda v: asked.msad([0, v])
            yield lambda v: asked.ssad([0, v])
            yield lambda v: asked.msad([0, v], radius=1.0)
        yield lambda v: self.query.sssd(0, v)
        yield lambda v: self.query.prepare(v)
        yield lambda v: self.query.prepared([v])
        yield lambda v: solver.distances(v)
        yield lambda v: solver.distances(0, [v])

    def test_out_of_range(self):
        for number, call in enumerate(self.calls()):
            for vertex in (self.n, -1, 1 << 32, (1 << 32) - 1, -(1 << 40), 1 << 70, -(1 << 70)):
                with self.subTest(call=number, vertex=vertex):
                    with self.assertRaises(geoidx.InvalidArgumentError) as caught:
                        call(vertex)
                    self.assertEqual(caught.exception.status, geoidx.Status.INVALID_ARGUMENT)
                    self.assertIn(str(vertex), str(caught.exception))

    def test_not_an_integer(self):
        for number, call in enumerate(self.calls()):
            for vertex in (1.0, "1", None, 1j):
                with self.subTest(call=number, vertex=vertex), self.assertRaises(TypeError):
                    call(vertex)

    def test_truth_values_are_no_vertices(self):
        for true in (True, np.True_):
            for call in (
                self.index.msad,
                self.index.ssad,
                self.index.nearest,
                self.query.prepare,
                lambda v: self.query.sssd(v, 2),
                lambda v: self.query.nearest_targets(v, [2], 1),
            ):
                with self.assertRaises(TypeError):
                    call(true)
            with self.assertRaises(TypeError):
                self.index.sssd(2, true)

    def test_rows_of_different_lengths(self):
        solver = geoidx.Solver(*self.mesh)
        calls = (self.index.msad, self.index.ssad, self.index.matrix, self.index.nearest, self.query.prepared)
        two = (lambda v: self.index.sssd(v, 1), lambda v: self.index.within(v, 1), lambda v: solver.distances(0, v))
        for call in (*calls, *two, solver.distances):
            with self.assertRaises((geoidx.InvalidArgumentError, TypeError)) as caught:  # the latter by old NumPy
                call([[1], [2, 3]])
            self.assertNotEqual(type(caught.exception), ValueError)

    def test_every_integer_type_and_layout(self):
        expected = self.index.msad([4, 240])
        for dtype in "u1 i2 u2 i4 u4 i8 u8 >u4 >i4 >i8".split():
            with self.subTest(dtype=dtype):
                sources = np.array([4, 240 if np.iinfo(dtype).max > 240 else 4], dtype)
                np.testing.assert_array_equal(self.index.msad(sources), expected)
        for strided in (np.array([4, 9, 240], np.uint32)[::2], np.array([240, 4], np.int32)[::-1]):
            np.testing.assert_array_equal(self.index.msad(strided), expected)
        with self.assertRaises(TypeError):
            self.index.msad(np.array([True, False]))


class SolverQueries(Queries):
    def test_targets(self):
        solver = geoidx.Solver(*self.mesh)
        self.assertEqual(solver.vertex_count, self.n)
        field = solver.distances([4, 240])
        self.assertEqual((field.shape, field.dtype), ((self.n,), np.float64))
        np.testing.assert_array_equal(field, np.minimum(solver.distances(4), solver.distances(240)))
        targets = np.array([[1, 2], [3, 4]])
        np.testing.assert_allclose(solver.distances([4, 240], targets), field[targets], rtol=1e-12)
        self.assertEqual(solver.distances(4, []).shape, (0,))
        self.assertEqual(solver.distances(4, 4), 0)
        out = np.zeros(self.n)
        self.assertIs(solver.distances([4, 240], out=out), out)
        np.testing.assert_array_equal(out, field)
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "no source"):
            solver.distances([])


if __name__ == "__main__":
    unittest.main()
