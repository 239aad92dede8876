"""Points of the surface and paths, on planes."""

import math
import unittest

import numpy as np
from meshes import plane

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

    def test_fields_begin_at_points_with_offsets(self):
        point = geoidx.surface_points(0, [1, 0, 0])
        vertex = self.mesh[1][0][0]
        field = self.query.point_msad(self.surface, point, offsets=[3])
        np.testing.assert_allclose(field - 3, self.index.msad(vertex), atol=1e-3 * field.max())

    def test_between_components_there_is_no_path(self):
        faces = [[0, 1, 2], [3, 4, 5]]
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]]
        query, surface = geoidx.Index.build(vertices, faces).query(), geoidx.Surface(vertices, faces)
        a, b = (geoidx.surface_points(t, [1, 0, 0]) for t in (0, 1))
        self.assertIsNone(query.path(surface, a, b))
        self.assertEqual(query.point_sssd(surface, a, b), math.inf)

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
