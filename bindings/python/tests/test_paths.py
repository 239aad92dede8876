"""Points of the surface and paths, on planes."""

import math
import unittest

import numpy as np
from meshes import hills, plane

import geoidx


class Paths(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = plane(12, 12)
        cls.index = geoidx.Index.build(*cls.mesh)
        cls.surface = geoidx.Surface(*cls.mesh)
        cls.query = cls.index.query()
        low, high = cls.mesh[0].min(axis=0), cls.mesh[0].max(axis=0)
        cls.low, cls.high = low, high
        cls.a = low + (high - low) * 0.13
        cls.b = low + (high - low) * [0.91, 0.77, 0]

    def test_the_closest_point_is_straight_below(self):
        point, distance = self.surface.closest_point(self.a + [0, 0, 7])
        self.assertAlmostEqual(distance, 7)
        self.assertEqual(point.dtype, geoidx.SURFACE_POINT)
        corners = self.mesh[0][self.mesh[1][point["triangle"][0]]]
        np.testing.assert_allclose(point["weights"][0] @ corners, self.a, atol=1e-9)

    def test_a_path_is_the_straight_line(self):
        source, target = self.surface.closest_point(self.a)[0], self.surface.closest_point(self.b)[0]
        straight = math.dist(self.a, self.b)
        for quality in ("straight", "exact"):
            path = self.query.path(self.surface, source, target, quality=quality)
            self.assertAlmostEqual(path.length, straight, places=9)
            self.assertEqual(len(path.points), len(path.positions))
            pieces = np.linalg.norm(np.diff(path.positions, axis=0), axis=1)
            self.assertAlmostEqual(pieces.sum(), path.length)
            np.testing.assert_allclose(path.positions[[0, -1]], [self.a, self.b], atol=1e-9)
        self.assertLess(abs(self.query.point_sssd(self.surface, source, target) - straight), 0.02 * straight)

    def test_a_path_by_costs_is_the_straight_line_times_the_cost(self):
        metric = geoidx.Weighted(np.full(len(self.mesh[1]), 2.5))
        query = geoidx.Index.build(*self.mesh, metric=metric).query()
        source, target = self.surface.closest_point(self.a)[0], self.surface.closest_point(self.b)[0]
        path = query.path(geoidx.Surface(*self.mesh, metric=metric), source, target)
        self.assertAlmostEqual(path.length / math.dist(self.a, self.b), 2.5, places=6)
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "face_costs"):
            query.path(self.surface, source, target)

    def test_a_path_by_costs_of_edges_takes_the_cheap_ones(self):
        vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        faces = [[0, 1, 2], [0, 2, 3]]
        metric = geoidx.Edges([[0, 2]], [10])
        query = geoidx.Index.build(vertices, faces, metric=metric).query()
        surface = geoidx.Surface(vertices, faces, metric=metric)
        source, target = geoidx.surface_points(0, [1, 0, 0]), geoidx.surface_points(0, [0, 0, 1])
        path = query.path(surface, source, target)
        self.assertAlmostEqual(path.length, 2)
        self.assertEqual(len(path.points), 3)

    def test_fields_begin_at_points_with_offsets(self):
        point = geoidx.surface_points(0, [1, 0, 0])
        vertex = self.mesh[1][0][0]
        field = self.query.point_msad(self.surface, point, offsets=[3])
        np.testing.assert_allclose(field - 3, self.index.msad(vertex), atol=1e-3 * field.max())

    def test_offsets_are_numbers(self):
        point = geoidx.surface_points(0, [1, 0, 0])
        calls = (
            lambda offsets: self.query.point_msad(self.surface, point, offsets=offsets),
            lambda offsets: self.query.point_nearest(self.surface, point, offsets=offsets),
            lambda offsets: self.query.point_within(self.surface, point, 1, offsets=offsets),
        )
        for call in calls:
            for bad in ([1 + 2j], [True], ["1"], [None], np.array([1], object)):
                with self.assertRaises(TypeError):
                    call(bad)
            for bad in ([-1], [math.nan], [math.inf], [1e300], [[1], [2]], []):
                with self.assertRaises(geoidx.InvalidArgumentError):
                    call(bad)
        expected = calls[0]([1])
        for good in (1, 1.0, np.float32(1), np.array([1.0]), np.array([1], np.int8), np.array([1], ">f4")):
            np.testing.assert_array_equal(calls[0](good), expected)

    def test_points_are_broadcast(self):
        for triangles, weights, count in (
            (0, [1, 0, 0], 1),
            ([0, 1, 2], [1, 0, 0], 3),
            ([0, 1, 2], [[1, 0, 0]], 3),
            (0, [[1, 0, 0], [0, 1, 0]], 2),
            ([0, 1], [[1, 0, 0], [0, 1, 0]], 2),
            ([], [], 0),
            ([], np.empty((0, 3)), 0),
            ([], [1, 0, 0], 0),
        ):
            points = geoidx.surface_points(triangles, weights)
            self.assertEqual(points.shape, (count,))
            self.assertTrue(np.all(points["triangle"] == triangles))
            self.assertTrue(np.all(points["weights"] == np.reshape(weights, (-1, 3))))
        for triangles, weights in (([0, 1, 2], [[1, 0, 0]] * 2), ([0, 1], []), (0, [1, 0]), (0, [[[1, 0, 0]]])):
            with self.assertRaises(geoidx.InvalidArgumentError):
                geoidx.surface_points(triangles, weights)

    def test_points_ask_for_what_is_near(self):
        sources = np.concatenate([self.surface.closest_point(p)[0] for p in (self.a, self.b)])
        field = np.empty(len(self.mesh[0]), np.float32)
        nearest = self.query.point_nearest(self.surface, sources, out=field)
        fields = [self.query.point_msad(self.surface, source) for source in (sources[:1], sources[1:])]
        np.testing.assert_array_equal(field, self.query.point_msad(self.surface, sources))
        np.testing.assert_allclose(np.choose(nearest, fields), np.min(fields, axis=0), rtol=0.02)
        late = self.query.point_nearest(self.surface, sources, offsets=[1e3, 0])
        self.assertEqual(set(late), {1})
        radius = float(np.median(fields[0]))
        vertices, distances = self.query.point_within(self.surface, sources[:1], radius)
        self.assertEqual(set(vertices), set(np.flatnonzero(fields[0] <= radius)))
        np.testing.assert_array_equal(distances, np.sort(fields[0][vertices]))
        targets = np.concatenate([sources[1:], sources[:1]])
        positions, distances = self.query.point_nearest_targets(self.surface, sources[:1], targets, 5)
        np.testing.assert_array_equal(positions, [1, 0])
        self.assertEqual(distances[0], 0)
        self.assertAlmostEqual(distances[1] / math.dist(self.a, self.b), 1, places=1)
        with self.assertRaises(geoidx.InvalidArgumentError):
            self.query.point_within(self.surface, sources, 1, offsets=[0])

    def test_between_components_there_is_no_path(self):
        faces = [[0, 1, 2], [3, 4, 5]]
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]]
        query, surface = geoidx.Index.build(vertices, faces).query(), geoidx.Surface(vertices, faces)
        a, b = (geoidx.surface_points(t, [1, 0, 0]) for t in (0, 1))
        self.assertIsNone(query.path(surface, a, b))
        query.prepare_target(surface, b)
        self.assertIsNone(query.next_step(surface, a))
        self.assertEqual(query.point_sssd(surface, a, b), math.inf)

    def test_an_index_keeps_its_mesh(self):
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "store_mesh"):
            self.index.surface()
        self.assertFalse(self.index.info.has_mesh)
        for dtype in (np.float32, np.float64):
            vertices, faces = hills(9, 8)[0].astype(dtype), hills(9, 8)[1]
            kept = geoidx.Index.build(vertices, faces, store_mesh=True)
            opened = geoidx.Index.from_bytes(kept.to_bytes(codec="mapped"))
            self.assertTrue(kept.info.has_mesh and opened.info.has_mesh)
            surface, own = opened.surface(), geoidx.Surface(vertices, faces)
            opened.close()
            for position in vertices.astype(float) + 0.3:
                for found, right in zip(surface.closest_point(position), own.closest_point(position)):
                    self.assertEqual(found, right)
            query = kept.query()
            ends = [surface.vertex_point(vertex) for vertex in (0, len(vertices) - 1)]
            paths = [query.path(on, *ends) for on in (surface, own)]
            self.assertEqual(paths[0].length, paths[1].length)
            np.testing.assert_array_equal(paths[0].points, paths[1].points)
            np.testing.assert_array_equal(paths[0].positions[[0, -1]], vertices[[0, -1]])
            plain = geoidx.Index.build(vertices, faces)
            self.assertEqual(kept.to_bytes(mesh=False), plain.to_bytes())

    def test_a_vertex_is_a_point(self):
        for vertex in range(len(self.mesh[0])):
            point = self.surface.vertex_point(vertex)
            corner = self.mesh[1][point["triangle"][0]][point["weights"][0].argmax()]
            self.assertEqual((corner, point["weights"][0].max()), (vertex, 1))
        with self.assertRaises(geoidx.InvalidArgumentError):
            self.surface.vertex_point(len(self.mesh[0]))
        with self.assertRaises(geoidx.InvalidArgumentError):
            self.surface.vertex_point(-1)

    def position(self, mesh, point):
        return point["weights"] @ mesh[0][mesh[1][point["triangle"]]]

    def walk(self, query, surface, point):
        """The steps from the point to the prepared target. Asks the query for something else after each of them."""
        steps = [query.next_step(surface, point)]
        while math.dist(*steps[-1].positions) > 0 and len(steps) < 1000:
            query.path(surface, point, steps[-1].points[1:])
            steps.append(query.next_step(surface, steps[-1].points[1:]))
        return steps

    def assert_leads(self, steps, start, end):
        """The steps are a way from one place to another. Returns its length."""
        for step in steps:
            self.assertEqual((step.points.dtype, step.points.shape), (geoidx.SURFACE_POINT, (2,)))
            self.assertEqual(step.points["triangle"][0], step.points["triangle"][1])
            self.assertEqual((step.positions.dtype, step.positions.shape), (np.float64, (2, 3)))
        np.testing.assert_allclose(steps[0].positions[0], start, atol=1e-9)
        for before, after in zip(steps, steps[1:]):
            np.testing.assert_allclose(after.positions[0], before.positions[1], atol=1e-9)
        np.testing.assert_allclose(steps[-1].positions, [end, end], atol=1e-9)
        self.assertEqual(steps[-1].distance, 0)
        return sum(math.dist(*step.positions) for step in steps)

    def test_steps_lead_to_the_target(self):
        mesh = hills(30, 26)
        surface, query = geoidx.Surface(*mesh), geoidx.Index.build(*mesh).query()
        target = geoidx.surface_points(len(mesh[1]) - 70, [0.2, 0.3, 0.5])
        query.prepare_target(surface, target)
        starts = geoidx.surface_points([3, 300, 700], [[0.5, 0.2, 0.3], [1, 0, 0], [0, 0.4, 0.6]])
        solver = geoidx.Solver(*mesh)
        for start in starts:
            with self.subTest(start=start):
                steps = self.walk(query, surface, start)
                length = self.assert_leads(steps, self.position(mesh, start), self.position(mesh, target[0]))
                exact = solver.point_distances(start, target)[0]
                self.assertGreater(length, exact * (1 - 1e-9))
                self.assertLess(length, 1.03 * exact)
                self.assertLess(abs(steps[0].distance - exact), 0.02 * exact)

    def test_steps_along_edges_lead_from_corner_to_corner(self):
        mesh = hills(12, 10)
        query = geoidx.Index.build(*mesh, metric=geoidx.Edges()).query()
        surface = geoidx.Surface(*mesh)
        query.prepare_target(surface, geoidx.surface_points(len(mesh[1]) - 1, [0, 1, 0]))
        steps = self.walk(query, surface, geoidx.surface_points(0, [1, 0, 0]))
        ends = mesh[1][0][0], mesh[1][-1][1]
        length = self.assert_leads(steps, *mesh[0][list(ends)])
        exact = geoidx.Solver(*mesh, metric=geoidx.Edges()).distances(*ends)
        self.assertGreater(length, exact * (1 - 1e-9))
        self.assertLess(length, 1.03 * exact)
        for step in steps:
            np.testing.assert_array_equal(step.points["weights"].max(axis=1), [1, 1])

    def test_steps_to_no_target_are_refused(self):
        point = geoidx.surface_points(0, [1, 0, 0])
        query = self.index.query()
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "no target"):
            query.next_step(self.surface, point)
        other = geoidx.Surface(*plane(5, 4))
        with self.assertRaises(geoidx.MeshMismatchError):
            query.prepare_target(other, point)
        query.prepare_target(self.surface, point)
        with self.assertRaises(geoidx.MeshMismatchError):
            query.next_step(other, point)
        for bad in (geoidx.surface_points(0, [2, 0, 0]), geoidx.surface_points([0, 0], np.eye(3)[:2])):
            with self.assertRaises(geoidx.InvalidArgumentError):
                query.next_step(self.surface, bad)
            with self.assertRaises(geoidx.InvalidArgumentError):
                query.prepare_target(self.surface, bad)

    def test_what_is_no_surface_is_refused_by_name(self):
        point = geoidx.surface_points(0, [1, 0, 0])
        for ask in (
            lambda: self.query.path(None, point, point),
            lambda: self.query.point_sssd(self.index, point, point),
            lambda: self.query.point_msad(None, point),
            lambda: self.query.point_within(None, point, 1),
            lambda: self.query.prepare_target(None, point),
        ):
            with self.assertRaisesRegex(TypeError, "surface is a (NoneType|Index), not a geoidx.Surface"):
                ask()
        with self.assertRaisesRegex(TypeError, "source"):
            self.query.path(self.surface, None, point)

    def test_what_is_wrong_is_refused(self):
        point = geoidx.surface_points(0, [1, 0, 0])
        other = geoidx.Surface(*plane(5, 4))
        with self.assertRaises(geoidx.MeshMismatchError):
            self.query.point_sssd(other, point, point)
        with self.assertRaises(ValueError):
            self.query.path(self.surface, point, point, quality="best")
        for bad in (geoidx.surface_points(0, [2, 0, 0]), geoidx.surface_points(10**6, [1, 0, 0])):
            with self.assertRaises(geoidx.InvalidArgumentError):
                self.query.path(self.surface, bad, point)
        with self.assertRaises(geoidx.InvalidArgumentError):
            self.query.point_msad(self.surface, point, offsets=[1, 2])
        with self.assertRaises(geoidx.InvalidArgumentError):
            self.surface.closest_point([math.nan, 0, 0])
