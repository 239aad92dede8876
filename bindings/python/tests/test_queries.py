"""Shapes, broadcasting and bits of the queries of an index, a query and a solver."""

import math
import tracemalloc
import unittest
from unittest import mock

import numpy as np
from meshes import hills, plane

import geoidx
from geoidx import _matrix


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
    def test_is_sssd_of_each_pair(self):
        a, b = [5, 0, 250], [9, 200, 5, 5]
        matrix = self.index.matrix(a, b)
        self.assertEqual((matrix.shape, matrix.dtype), ((3, 4), np.float32))
        np.testing.assert_array_equal(matrix, self.index.sssd(np.array(a)[:, None], b))
        np.testing.assert_array_equal(self.index.matrix(a), self.index.matrix(a, a))
        self.assertEqual(self.index.matrix([], b).shape, (0, 4))
        self.assertEqual(self.index.matrix(a, []).shape, (3, 0))
        self.assertEqual(self.index.matrix(4, b).shape, (1, 4))

    def test_few_vertices_are_pairs(self):
        for count in (1, 2, 9, 24):
            a = np.arange(count) * 10
            for matrix in (self.index.matrix(a), self.index.matrix(a, a.copy())):
                np.testing.assert_array_equal(matrix, self.index.sssd(a[:, None], a))

    def test_many_columns_are_fields_of_the_rows(self):
        a, b = np.arange(3, 22), np.arange(self.n)[::-1].repeat(2)
        fields = self.index.ssad(a)[:, b]
        self.assertTrue((fields != self.index.sssd(a[:, None], b)).any())  # the test can tell them apart
        np.testing.assert_array_equal(self.index.matrix(a, b), fields)
        np.testing.assert_array_equal(self.index.matrix(b, a), fields.T)
        same_length = np.arange(self.n), np.arange(self.n)[::-1]
        np.testing.assert_array_equal(self.index.matrix(*same_length), self.index.ssad(same_length[0])[:, ::-1])

    def test_equal_rows_and_columns_are_symmetric(self):
        a = np.random.default_rng(5).permutation(self.n)
        fields = self.index.ssad(a)[:, a]
        self.assertTrue((fields != fields.T).any())
        for a_again in (None, list(a)):
            matrix = self.index.matrix(a, a_again)
            np.testing.assert_array_equal(matrix, matrix.T)
            np.testing.assert_array_equal(matrix, (fields + fields.T) / 2)
            self.assertFalse(np.diag(matrix).any())

    def test_strips_of_a_few_pairs(self):
        for at_once in (1, 30, 255):
            with mock.patch.object(_matrix, "_PAIRS_AT_ONCE", at_once):
                self.test_is_sssd_of_each_pair()
                self.test_few_vertices_are_pairs()
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


class WorkOfAMatrix(unittest.TestCase):
    """How many pairs and fields are asked for, on a mesh of 43,243 vertices."""

    def work(self, row_count, column_count, first_column=0, engine=geoidx.Engine.OVERLAY):
        asked = {"pairs": 0, "fields": 0, "fields at once": 0}

        def pairs(vertices, distances):
            asked["pairs"] += distances.size

        def fields(sources):
            asked["fields"] += sources.size
            asked["fields at once"] = max(asked["fields at once"], sources.size)
            return np.zeros((sources.size, 43243), np.float32)

        rows = np.arange(row_count, dtype=np.uint32)
        columns = np.arange(first_column, first_column + column_count, dtype=np.uint32)
        distances = np.empty((row_count, column_count), np.float32)
        _matrix.Matrix(engine, 43243, pairs, fields).fill(rows, columns, distances)
        return asked

    def test_many_landmarks_are_a_field_each(self):
        expected = {"pairs": 0, "fields": 1000, "fields at once": 16}
        self.assertEqual(self.work(1000, 1000), expected)
        self.assertEqual(self.work(1000, 1000, first_column=1), expected)

    def test_the_shorter_side_is_the_source(self):
        for rows, columns in ((20, 900), (900, 20)):
            self.assertEqual(self.work(rows, columns, first_column=5)["fields"], 20)

    def test_few_rows_and_columns_are_pairs(self):
        for rows, columns in ((1, 10), (10, 1), (50, 60)):
            expected = {"pairs": rows * columns, "fields": 0, "fields at once": 0}
            self.assertEqual(self.work(rows, columns, first_column=5), expected)
            graph = self.work(rows, columns, first_column=5, engine=geoidx.Engine.GRAPH)
            self.assertEqual(graph["fields"], min(rows, columns))

    def test_a_square_of_pairs_is_little_more_than_half_of_it(self):
        asked = self.work(100, 100)
        self.assertEqual(asked["fields"], 0)
        self.assertLess(asked["pairs"], 0.6 * 100 * 100)


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
        for threads in (1, 2, 0):
            with self.index.query(threads=threads) as query:
                self.assertEqual(query.threads, threads)
                np.testing.assert_array_equal(query.msad([4, 240]), expected)

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
        yield lambda v: self.index.matrix([0, v])
        yield lambda v: self.index.matrix([0], [v])
        for asked in (self.index, self.query):
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
            for call in (self.index.msad, self.index.ssad, self.query.prepare, lambda v: self.query.sssd(v, 2)):
                with self.assertRaises(TypeError):
                    call(true)
            with self.assertRaises(TypeError):
                self.index.sssd(2, true)

    def test_rows_of_different_lengths(self):
        solver = geoidx.Solver(*self.mesh)
        calls = (self.index.msad, self.index.ssad, self.index.matrix, solver.distances, self.query.prepared)
        for call in (*calls, lambda v: self.index.sssd(v, 1), lambda v: solver.distances(0, v)):
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
