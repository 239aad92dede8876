"""Options, progress, cancelling and interrupting of a build."""

import gc
import math
import signal
import threading
import unittest
import weakref

import numpy as np
from meshes import SQUARE, hills, plane, straight

import geoidx


class Options(unittest.TestCase):
    def test_levels_and_patches(self):
        mesh = hills(15, 15)
        self.assertEqual(geoidx.Index.build(*mesh, levels=3).info.level_count, 3)
        info = geoidx.Index.build(*mesh, patches=[4, 3]).info
        self.assertEqual(len(info.patch_count), 2)
        self.assertGreaterEqual(info.patch_count[0], 4)
        self.assertGreaterEqual(info.patch_count[1], 12)
        self.assertEqual(geoidx.Index.build(*mesh, levels=1, patches=[4, 3]).info.level_count, 1)

    def test_what_is_kept(self):
        vertices, faces = hills(12, 11)
        index = geoidx.Index.build(vertices, faces, delta=0.5, seed=(1 << 64) - 1, lloyd_iterations=2)
        info = index.info
        self.assertEqual((info.vertex_count, info.triangle_count), (132, 220))
        self.assertEqual((info.delta, info.seed), (0.5, (1 << 64) - 1))
        diagonal = np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0))
        self.assertAlmostEqual(info.bounding_box_diagonal, diagonal)
        self.assertTrue(info.metric_unfoldable)
        self.assertGreater(info.error_sources, 0)
        with self.assertRaises(AttributeError):
            info.seed = 1

    def test_seed_and_exact_vertices_count_and_threads_do_not(self):
        mesh = hills(20, 20)
        plain = geoidx.Index.build(*mesh, threads=1).to_bytes()
        self.assertEqual(geoidx.Index.build(*mesh, threads=3).to_bytes(), plain)
        self.assertNotEqual(geoidx.Index.build(*mesh, seed=1).to_bytes(), plain)
        # Two levels, so that the table of the whole mesh is measured or put together. Added vertices count as well,
        # so that there are none here.
        mesh = hills(40, 40)
        exact, closed = (geoidx.Index.build(*mesh, exact_vertices=n, target_error=0).to_bytes() for n in (2000, 400))
        self.assertNotEqual(closed, exact)

    def test_weld_tolerance(self):
        vertices = np.concatenate([SQUARE[0], SQUARE[0][[0, 2]] + 1e-4])
        faces = [[0, 1, 2], [4, 5, 3]]
        self.assertEqual(geoidx.Index.build(vertices, faces).sssd(1, 3), math.inf)
        welded = geoidx.Index.build(vertices, faces, weld_tolerance=1e-3)
        self.assertEqual(welded.info.welded_vertex_count, 4)
        self.assertAlmostEqual(welded.sssd(1, 3), math.sqrt(2), delta=1e-3)
        self.assertAlmostEqual(geoidx.Solver(vertices, faces, weld_tolerance=1e-3).distances(1, 4), 1, delta=1e-3)

    def test_refuse_edges_of_many(self):
        vertices = np.concatenate([SQUARE[0], [[0, 0, 5]]])
        faces = [[0, 1, 2], [0, 2, 3], [0, 2, 4]]
        geoidx.Index.build(vertices, faces)
        with self.assertRaisesRegex(geoidx.BadMeshError, "more than two"):
            geoidx.Index.build(vertices, faces, refuse_edges_of_many=True)

    def test_vertices_are_added_where_the_mean_error_is_over_the_target(self):
        mesh = hills(20, 20)
        plain, default, fine = (
            geoidx.Index.build(*mesh, **options) for options in ({"target_error": 0}, {}, {"target_error": 1e-9})
        )
        self.assertEqual(plain.info.added_vertex_count, 0)
        self.assertEqual(geoidx.Index.build(*mesh, target_error=0.0005).to_bytes(), default.to_bytes())
        self.assertGreater(fine.info.added_vertex_count, 0)
        self.assertLess(fine.info.error_mean, plain.info.error_mean)
        for index in (plain, default, fine):
            self.assertEqual(index.info.welded_vertex_count, len(mesh[0]))
            info = index.info
            self.assertEqual(info.error_max, max(info.error_near_max, info.error_middle_max, info.error_far_max))
            self.assertLess(0, info.error_near_mean)
            self.assertLess(info.error_near_mean, info.error_near_max)
            self.assertLess(info.error_several_mean, info.error_several_max)
            self.assertEqual(len(index.msad([0])), len(mesh[0]))

    def test_out_of_range(self):
        for options in (
            {"levels": 9},
            {"levels": -1},
            {"patches": [1] * 9},
            {"patches": [-1]},
            {"patches": [1 << 32]},
            {"delta": -1},
            {"delta": math.nan},
            {"weld_tolerance": -1},
            {"weld_tolerance": math.inf},
            {"threads": -1},
            {"threads": 1 << 32},
            {"lloyd_iterations": (1 << 32) - 1},
            {"exact_vertices": -1},
            {"rounding": -0.1},
            {"rounding": 1.1},
            {"rounding": math.nan},
            {"target_error": -0.1},
            {"target_error": 1.1},
            {"target_error": math.nan},
            {"seed": -1},
            {"seed": 1 << 64},
        ):
            with self.subTest(**options), self.assertRaises(geoidx.InvalidArgumentError):
                geoidx.Index.build(*SQUARE, **options)
        for options in ({"levels": 1.5}, {"seed": "1"}, {"delta": "1"}, {"rounding": "1"}, {"patches": 3}, {"unknown": 1}):
            with self.subTest(**options), self.assertRaises(TypeError):
                geoidx.Index.build(*SQUARE, **options)


class Progress(unittest.TestCase):
    mesh = hills(15, 15)

    def test_never_falls_and_ends_at_1(self):
        told = []
        geoidx.Index.build(*self.mesh, progress=lambda f, s: told.append((f, s, threading.get_ident())))
        fractions = [fraction for fraction, _, _ in told]
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1)
        self.assertTrue(all(isinstance(stage, str) and stage for _, stage, _ in told))
        self.assertEqual({thread for _, _, thread in told}, {threading.get_ident()})

    def test_what_cancels(self):
        for answer in (False, 0, np.False_):
            with self.assertRaises(geoidx.CancelledError) as caught:
                geoidx.Index.build(*self.mesh, progress=lambda f, s, answer=answer: answer)
            self.assertEqual(caught.exception.status, geoidx.Status.CANCELLED)
        for answer in (True, None, 1):
            geoidx.Index.build(*self.mesh, progress=lambda f, s, answer=answer: answer)

    def test_what_it_raises_is_raised(self):
        for error in (LookupError("mine"), KeyboardInterrupt(), SystemExit(3)):
            def progress(fraction, stage, error=error):
                raise error

            with self.assertRaises(type(error)) as caught:
                geoidx.Index.build(*self.mesh, progress=progress)
            self.assertIs(caught.exception, error)

    def test_raising_at_the_end_of_the_build(self):
        def progress(fraction, stage):
            if fraction == 1:
                raise LookupError("late")

        with self.assertRaises(LookupError):
            geoidx.Index.build(*self.mesh, progress=progress)

    def test_is_not_called_again_after_it_raised(self):
        calls = []

        def progress(fraction, stage):
            calls.append(fraction)
            raise LookupError

        with self.assertRaises(LookupError):
            geoidx.Index.build(*self.mesh, progress=progress)
        self.assertEqual(len(calls), 1)

    def test_is_let_go_after_the_build(self):
        class Function:
            def __call__(self, fraction, stage):
                return None

        function = Function()
        gone = weakref.ref(function)
        index = geoidx.Index.build(*SQUARE, progress=function)
        del function
        self.assertIsNone(gone())
        self.assertFalse(index.closed)


class Interrupts(unittest.TestCase):
    """Signals that arrive while the library works."""

    def setUp(self):
        self.handler = signal.getsignal(signal.SIGINT)

    def tearDown(self):
        self.assertIs(signal.getsignal(signal.SIGINT), self.handler)

    def test_in_progress(self):
        with self.assertRaises(KeyboardInterrupt):
            geoidx.Index.build(*hills(15, 15), progress=lambda f, s: signal.raise_signal(signal.SIGINT))

    def test_in_the_library(self):
        """While this thread is inside the library, and no progress function is given."""
        main = threading.main_thread().ident
        for _ in range(3):
            timer = threading.Timer(0.05, lambda: signal.pthread_kill(main, signal.SIGINT))
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                geoidx.Index.build(*hills(150, 150))
            timer.join()

    def test_in_a_metric(self):
        vertices, faces = plane(6, 6)

        def metric(source, targets):
            signal.raise_signal(signal.SIGINT)
            return straight(vertices, source, targets)

        with self.assertRaises(KeyboardInterrupt):
            geoidx.Index.build(vertices, faces, metric=metric, threads=1)
        solver = geoidx.Solver(vertices, faces, metric=metric)
        with self.assertRaises(KeyboardInterrupt):
            solver.distances(0)

    def test_handlers_that_raise_nothing(self):
        numbers = []
        before = signal.signal(signal.SIGUSR1, lambda number, frame: numbers.append(number))
        try:
            index = geoidx.Index.build(*hills(9, 9), progress=lambda f, s: signal.raise_signal(signal.SIGUSR1))
        finally:
            signal.signal(signal.SIGUSR1, before)
        self.assertGreater(len(numbers), 1)
        self.assertEqual(index.vertex_count, 81)

    def test_on_another_thread(self):
        found = []

        def build():
            found.append(geoidx.Index.build(*hills(9, 9), progress=lambda fraction, stage: None))

        worker = threading.Thread(target=build)
        worker.start()
        worker.join()
        self.assertEqual(found[0].vertex_count, 81)


class MetricFailures(unittest.TestCase):
    mesh = plane(8, 8)

    def build_and_solve(self, metric, **options):
        yield lambda: geoidx.Index.build(*self.mesh, metric=metric, **options)
        yield lambda: geoidx.Solver(*self.mesh, metric=metric).distances(0)

    def test_what_it_raises_is_raised(self):
        def metric(source, targets):
            raise LookupError("mine")

        for threads in (1, 3):
            for call in self.build_and_solve(metric, threads=threads):
                with self.assertRaisesRegex(LookupError, "mine"):
                    call()

    def test_wrong_answers(self):
        answers = (
            (lambda targets: None, TypeError),
            (lambda targets: np.zeros(len(targets) + 1), geoidx.InvalidArgumentError),
            (lambda targets: 1.0, geoidx.InvalidArgumentError),
            (lambda targets: np.full(len(targets), math.nan), geoidx.CallbackError),
            (lambda targets: np.full(len(targets), -1), geoidx.CallbackError),
        )
        for answer, error in answers:
            for call in self.build_and_solve(lambda source, targets, answer=answer: answer(targets)):
                with self.assertRaises(error):
                    call()

    def test_a_solver_works_after_a_failure(self):
        fails = [True]

        def metric(source, targets):
            if fails[0]:
                raise LookupError
            return straight(self.mesh[0], source, targets)

        solver = geoidx.Solver(*self.mesh, metric=metric)
        with self.assertRaises(LookupError):
            solver.distances(0)
        fails[0] = False
        gc.collect()
        self.assertEqual(solver.distances(0, 7), 7)

    def test_asking_the_solver_that_asks(self):
        def metric(source, targets):
            return solver.distances(source, targets)

        solver = geoidx.Solver(*self.mesh, metric=metric)
        with self.assertRaisesRegex(RuntimeError, "in use"):
            solver.distances(0)

    def test_asking_another_solver(self):
        def metric(source, targets):
            return geoidx.Solver(*self.mesh).distances(source, targets)

        index = geoidx.Index.build(*self.mesh, metric=metric)
        self.assertAlmostEqual(index.sssd(0, 7), 7, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
