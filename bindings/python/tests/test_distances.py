"""Distances of indices and solvers against closed forms."""

import math
import unittest

import numpy as np
from meshes import SQUARE, cone, cube, hills, plane, rim_distance, straight

import geoidx

ONE_LEAF = {"patches": (1,)}
QUANTUM = 1 / 65532
"""Of a leaf's longest distance: the precision of the overlay engine."""


class ClosedForms(unittest.TestCase):
    def check(self, mesh, expected, longest):
        """expected[a, b] is the distance of each pair of vertices."""
        solver = geoidx.Solver(*mesh)
        overlay = geoidx.Index.build(*mesh, **ONE_LEAF)
        graph = geoidx.Index.build(*mesh, engine="graph", **ONE_LEAF)
        everything = np.arange(len(mesh[0]))
        for source in everything:
            np.testing.assert_allclose(solver.distances(source), expected[source], rtol=1e-12, atol=1e-14)
        np.testing.assert_allclose(overlay.matrix(everything), expected, atol=longest * QUANTUM)
        np.testing.assert_allclose(graph.matrix(everything), expected, rtol=1e-6)

    def test_plane(self):
        vertices, faces = plane(7, 5)
        self.check((vertices, faces), straight(vertices, np.arange(35)[:, None], np.arange(35)), math.hypot(6, 4))

    def test_cube(self):
        vertices, faces = cube()
        differing = (vertices[:, None] != vertices).sum(axis=-1)
        self.check((vertices, faces), np.sqrt([0, 1, 2, 5])[differing], math.sqrt(5))

    def test_cone(self):
        for corners, height in ((5, 0.2), (12, 1.0), (9, 4.0)):
            vertices, faces = cone(corners, height)
            slant = math.hypot(1, height)
            expected = np.full((corners + 1, corners + 1), slant)
            for a in range(corners):
                for b in range(corners):
                    expected[a, b] = rim_distance(corners, height, abs(a - b))
            expected[corners, corners] = 0
            with self.subTest(corners=corners, height=height):
                self.check((vertices, faces), expected, 2 * slant)


class LargerMeshes(unittest.TestCase):
    """Paths that cross many patches: within the engine's errors of the exact distance."""

    @classmethod
    def setUpClass(cls):
        cls.mesh = hills(31, 29)
        cls.exact = geoidx.Solver(*cls.mesh)

    def test_a_tolerant_solver_is_nearly_exact(self):
        exact = self.exact.distances(0)
        tolerant = geoidx.Solver(*self.mesh, tolerance=1e-4).distances(0)
        self.assertFalse(np.array_equal(exact, tolerant))
        np.testing.assert_allclose(tolerant, exact, rtol=5e-3)
        for wrong in (-1e-9, 0.1, math.nan):
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "tolerance"):
                geoidx.Solver(*self.mesh, tolerance=wrong)

    def test_every_engine_is_near_the_exact_distance(self):
        for engine in geoidx.Engine:
            index = geoidx.Index.build(*self.mesh, engine=engine, patches=(5, 3))
            for source in (0, 410, 898):
                exact = self.exact.distances(source)
                others = exact > 0
                error = np.abs(index.msad(source)[others] / exact[others] - 1)
                with self.subTest(engine=engine, source=source):
                    self.assertLess(error.mean(), 0.01)
                    self.assertLess(error.max(), 0.5)
            self.assertEqual(index.info.engine, engine)
            self.assertLess(index.info.error_mean, 0.01)


class Metrics(unittest.TestCase):
    def test_edges(self):
        mesh = plane(4, 4)
        for metric in ("edges", geoidx.Edges()):
            index = geoidx.Index.build(*mesh, metric=metric, **ONE_LEAF)
            self.assertAlmostEqual(index.sssd(0, 15), 3 * math.sqrt(2), delta=QUANTUM * 6)
            self.assertAlmostEqual(index.sssd(3, 12), 6, delta=QUANTUM * 6)  # against the diagonals
            self.assertEqual(index.info.metric, geoidx.MetricKind.EDGES)
            self.assertFalse(index.info.metric_unfoldable)

    def test_edge_costs(self):
        metric = geoidx.Edges(vertices=[[2, 0], [0, 2], [0, 1]], costs=[5, 0.25, 0])
        np.testing.assert_array_equal(geoidx.Solver(*SQUARE, metric=metric).distances(1), [0, 0, 0.25, 1])
        index = geoidx.Index.build(*SQUARE, metric=metric, engine="graph")
        np.testing.assert_array_equal(index.msad(1), np.float32([0, 0, 0.25, 1]))
        self.assertNotEqual(index.info.metric_fingerprint, 0)
        for half in ({"vertices": [[0, 2]]}, {"costs": [1]}):
            with self.assertRaises(geoidx.InvalidArgumentError):
                geoidx.Solver(*SQUARE, metric=geoidx.Edges(**half))
        with self.assertRaises(geoidx.InvalidArgumentError):
            geoidx.Solver(*SQUARE, metric=geoidx.Edges(vertices=[[0, 2], [0, 1]], costs=[1]))
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "no edge"):
            geoidx.Solver(*SQUARE, metric=geoidx.Edges(vertices=[[1, 3]], costs=[1]))

    def test_weighted(self):
        """Along the diagonal the cheap triangle counts; to the far corner of the dear one the path leaves the
        diagonal at the critical angle, whose sine is 1 / 10."""
        solver = geoidx.Solver(*SQUARE, metric=geoidx.Weighted([1, 10], points_per_edge=100))
        half = math.sqrt(0.5)
        bent = half + half * math.sqrt(99)
        self.assertAlmostEqual(solver.distances(0, 2), math.sqrt(2))
        self.assertGreaterEqual(solver.distances(0, 3), bent * (1 - 1e-12))
        self.assertLessEqual(solver.distances(0, 3), bent * 1.001)
        index = geoidx.Index.build(*SQUARE, metric=geoidx.Weighted([3, 3]))
        self.assertAlmostEqual(index.sssd(0, 1), 3, delta=QUANTUM * 5)
        self.assertEqual(index.info.metric, geoidx.MetricKind.WEIGHTED)
        for costs in ([1], [1, 0], [1, math.nan], [[1, 1]]):
            with self.assertRaises(geoidx.InvalidArgumentError):
                geoidx.Solver(*SQUARE, metric=geoidx.Weighted(costs))

    def test_edge_lengths(self):
        """The surface is that of the lengths, whatever the positions are."""
        vertices, faces = hills(6, 5)
        sides = np.stack(
            [straight(vertices, faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]) for k in range(3)], axis=1
        )
        by_positions = geoidx.Solver(vertices, faces)
        by_lengths = geoidx.Solver(vertices * [7, 7, 0], faces, metric=geoidx.Exact(edge_lengths=sides))
        np.testing.assert_allclose(by_lengths.distances(3), by_positions.distances(3), rtol=1e-9)
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "edge_lengths"):
            geoidx.Solver(vertices, faces, metric=geoidx.Exact(edge_lengths=sides[:, :2]))
        sides[6, 1] = math.nan
        with self.assertRaisesRegex(geoidx.BadMeshError, "triangle 6"):
            geoidx.Index.build(vertices, faces, metric=geoidx.Exact(edge_lengths=sides))
        weighted = geoidx.Weighted([2, 2], edge_lengths=[[3, 5, 4], [4, 3, 5]])
        self.assertAlmostEqual(geoidx.Solver(*SQUARE, metric=weighted).distances(0, 1), 8)

    def test_callback(self):
        """The taxicab metric, which the mesh alone does not have."""
        vertices, faces = plane(6, 6)

        def taxicab(source, targets):
            self.assertEqual(targets.dtype, np.uint32)
            return np.abs(vertices[source] - vertices[targets]).sum(axis=-1)

        expected = taxicab(7, np.arange(36, dtype=np.uint32))
        solver = geoidx.Solver(vertices, faces, metric=taxicab)
        np.testing.assert_array_equal(solver.distances(7), expected)
        for unfoldable in (False, True):
            metric = geoidx.Callback(taxicab, unfoldable=unfoldable)
            index = geoidx.Index.build(vertices, faces, metric=metric, threads=2, **ONE_LEAF)
            np.testing.assert_allclose(index.msad(7), expected, atol=10 * QUANTUM)
            self.assertEqual(index.info.metric, geoidx.MetricKind.CALLBACK)
            self.assertEqual(index.info.metric_unfoldable, unfoldable)

    def test_callback_may_keep_its_targets(self):
        kept = []
        vertices, faces = plane(5, 5)

        def metric(source, targets):
            kept.append((targets, targets.copy()))
            return straight(vertices, source, targets)

        geoidx.Index.build(vertices, faces, metric=metric)
        for targets, copy in kept:
            np.testing.assert_array_equal(targets, copy)

    def test_unknown_names(self):
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "euclid"):
            geoidx.Index.build(*SQUARE, metric="euclid")
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "fast"):
            geoidx.Index.build(*SQUARE, engine="fast")


class SurfacePoints(unittest.TestCase):
    def test_cube(self):
        vertices, faces = cube()
        solver = geoidx.Solver(vertices, faces)
        # The middle of a side lies on the diagonal of its two triangles.
        middles = geoidx.surface_points([0, 2, 4], [[0.5, 0, 0.5]] * 3)
        np.testing.assert_allclose(solver.point_distances(middles[:1], middles), [0, 2, 1], atol=1e-12)
        corner = geoidx.surface_points(0, [1, 0, 0])
        np.testing.assert_allclose(solver.point_distances(corner, middles[:1]), math.sqrt(0.5))
        np.testing.assert_allclose(solver.point_distances(middles[:2], middles), [0, 0, 1], atol=1e-12)
        self.assertEqual(solver.point_distances(corner, middles[:0]).shape, (0,))

    def test_out(self):
        solver = geoidx.Solver(*SQUARE)
        points = geoidx.surface_points([0, 1], np.full((2, 3), 1 / 3))
        out = np.zeros(2)
        self.assertIs(solver.point_distances(points[:1], points, out=out), out)
        np.testing.assert_allclose(out, [0, math.sqrt(2) / 3])

    def test_refusals(self):
        solver = geoidx.Solver(*SQUARE)
        good = geoidx.surface_points(0, [1, 0, 0])
        for triangle, weights in ((2, [1, 0, 0]), (0, [1, 1, 0]), (0, [-1, 1, 1]), (0, [math.nan, 0, 1])):
            bad = geoidx.surface_points(triangle, weights)
            for pair in ((good, bad), (bad, good)):
                with self.assertRaises(geoidx.InvalidArgumentError):
                    solver.point_distances(*pair)
        with self.assertRaises(geoidx.InvalidArgumentError):
            solver.point_distances(good[:0], good)
        with self.assertRaises(geoidx.InvalidArgumentError):
            geoidx.Solver(*SQUARE, metric="edges").point_distances(good, good)
        with self.assertRaises(geoidx.InvalidArgumentError):
            solver.point_distances(np.stack([good, good]), good)
        with self.assertRaises(TypeError):
            solver.point_distances([0], good)
        for triangles, weights in (([0], [1, 0]), ([0, 1, 0], [[1, 0, 0]] * 2), ([-1], [1, 0, 0])):
            with self.assertRaises(geoidx.InvalidArgumentError):
                geoidx.surface_points(triangles, weights)
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "out of range for a triangle"):
            geoidx.surface_points(-1, [1, 0, 0])


if __name__ == "__main__":
    unittest.main()
