"""Closing, finalizing, and threads that share an index."""

import copy
import ctypes
import gc
import os
import pickle
import subprocess
import sys
import threading
import unittest
import weakref
from pathlib import Path

import numpy as np
from meshes import SQUARE, hills, plane, straight

import geoidx

libc = ctypes.CDLL(None)
libc.aligned_alloc.restype = ctypes.c_void_p
libc.aligned_alloc.argtypes = [ctypes.c_size_t, ctypes.c_size_t]
libc.free.argtypes = [ctypes.c_void_p]


class Memory:
    """An allocator that knows what is in use."""

    def __init__(self):
        self.blocks = {}
        self.allocator = geoidx.Allocator(geoidx.AllocateFn(self.allocate), geoidx.ReleaseFn(self.release))

    def allocate(self, user, size, alignment):
        memory = libc.aligned_alloc(alignment, (size + alignment - 1) // alignment * alignment)
        self.blocks[memory] = size
        return memory

    def release(self, user, memory, size, alignment):
        assert self.blocks.pop(memory) == size
        libc.free(memory)


class Making(unittest.TestCase):
    def test_an_index_is_not_made_by_its_class(self):
        """Such handles went to the library, and the process crashed."""
        for wrong in ("square.geoidx", b"bytes", 5, None):
            with self.assertRaisesRegex(TypeError, "Index.open"):
                geoidx.Index(wrong)
        with self.assertRaisesRegex(TypeError, "Index.query"):
            geoidx.Query(geoidx.Index.build(*SQUARE), 4)

    def test_scratch_is_neither_copied_nor_pickled(self):
        query, solver = geoidx.Index.build(*SQUARE).query(), geoidx.Solver(*SQUARE)
        for scratch in (query, solver):
            for call in (pickle.dumps, copy.copy, copy.deepcopy):
                with self.assertRaisesRegex(TypeError, "each thread makes its own"):
                    call(scratch)


class Closing(unittest.TestCase):
    def setUp(self):
        self.memory = Memory()
        self.index = geoidx.Index.build(*SQUARE, allocator=self.memory.allocator)
        self.assertTrue(self.memory.blocks)

    def test_close_gives_memory_back(self):
        self.index.close()
        self.assertFalse(self.memory.blocks)
        self.index.close()
        self.assertTrue(self.index.closed)

    def test_context_manager(self):
        with self.index as index:
            self.assertIs(index, self.index)
            self.assertFalse(index.closed)
        self.assertTrue(self.index.closed)
        self.assertFalse(self.memory.blocks)
        with self.assertRaises(ValueError), self.index:
            pass

    def test_finalizer(self):
        del self.index
        self.assertFalse(self.memory.blocks)

    def test_finalizer_in_a_cycle(self):
        cycle = [self.index]
        cycle.append(cycle)
        del self.index, cycle
        gc.collect()
        self.assertFalse(self.memory.blocks)

    def test_an_allocator_that_reaches_what_it_is_for(self):
        """Everything at once is garbage: the memory is given back while the allocator still works."""
        blocks = self.memory.blocks
        self.memory.index = self.index
        self.memory.queries = [self.index.query() for _ in range(3)]
        for query in self.memory.queries:
            query.msad(0)
        del self.index, self.memory, query
        gc.collect()
        self.assertFalse(blocks)

    def test_a_query_outlives_its_index(self):
        query = self.index.query()
        expected = query.msad(0)
        self.index.close()
        np.testing.assert_array_equal(query.msad(0), expected)
        del self.index
        gc.collect()
        np.testing.assert_array_equal(query.msad(0), expected)
        query.close()
        self.assertFalse(self.memory.blocks)

    def test_the_allocator_lives_as_long_as_the_index(self):
        allocator = self.memory.allocator
        gone = weakref.ref(allocator)
        index = geoidx.Index.from_bytes(self.index.to_bytes(), allocator=allocator)
        del allocator, self.memory.allocator
        self.index.close()
        gc.collect()
        self.assertIsNotNone(gone())
        index.msad(0)
        index.close()
        self.assertIsNone(gone())
        self.assertFalse(self.memory.blocks)

    def test_borrowed_bytes_live_as_long_as_the_index_and_its_queries(self):
        data = geoidx.Index.build(*hills(24, 24)).to_bytes(codec="mapped")
        unborrowed = sys.getrefcount(data)
        copied = geoidx.Index.from_bytes(data)
        self.assertEqual(sys.getrefcount(data), unborrowed)
        borrowed = geoidx.Index.from_bytes(data, borrow=True)
        query = borrowed.query()
        borrowed.close()
        del borrowed
        gc.collect()
        self.assertGreater(sys.getrefcount(data), unborrowed)
        np.testing.assert_array_equal(query.msad(0), copied.msad(0))
        query.close()
        self.assertEqual(sys.getrefcount(data), unborrowed)

    def test_tables_of_a_mapped_file_take_no_memory_of_the_index(self):
        data = geoidx.Index.build(*hills(24, 24)).to_bytes(codec="mapped")
        sizes = []
        for borrow in (False, True):
            memory = Memory()
            with geoidx.Index.from_bytes(data, borrow=borrow, allocator=memory.allocator):
                sizes.append(sum(memory.blocks.values()))
            self.assertFalse(memory.blocks)
        self.assertGreaterEqual(sizes[0], sizes[1] + len(data))

    def test_the_limit_of_memory_holds_for_queries(self):
        data = geoidx.Index.build(*hills(40, 40)).to_bytes()
        memory = Memory()
        with geoidx.Index.from_bytes(data, allocator=memory.allocator) as opened:
            opened.msad(0)
            with_fields = sum(memory.blocks.values())
            opened.sssd(0, 1599)
            with_pairs = sum(memory.blocks.values())
        limited = geoidx.Index.from_bytes(data, max_memory=(with_fields + with_pairs) // 2)
        field = limited.msad(0)
        with self.assertRaisesRegex(geoidx.LimitError, "max_memory"):
            limited.sssd(0, 1599)
        np.testing.assert_array_equal(limited.msad(0), field)

    def test_pairs_without_labels_take_less_memory(self):
        vertices, faces = plane(40, 40)
        built = geoidx.Index.build(vertices, faces)
        data = built.to_bytes()
        targets = np.arange(0, 1600, 37)
        for pairs in (False, True):
            sizes = []
            for labels in (False, True):
                memory = Memory()
                with geoidx.Index.from_bytes(data, pairs=pairs, labels=labels, allocator=memory.allocator) as opened:
                    distances = opened.sssd(17, targets)
                    sizes.append(sum(memory.blocks.values()))
                    np.testing.assert_allclose(distances, straight(vertices, 17, targets), rtol=0.05)
                    np.testing.assert_array_equal(opened.msad(17), built.msad(17))
                    self.assertEqual(opened.to_bytes(), data)
            np.testing.assert_array_equal(distances, built.sssd(17, targets))
            self.assertLess(*sizes)

    def test_failures_leak_nothing(self):
        self.index.close()

        def late(fraction, stage):
            if fraction == 1:
                raise LookupError

        for options in ({"progress": lambda f, s: False}, {"progress": late}, {"delta": -1}):
            with self.assertRaises((LookupError, geoidx.Error)):
                geoidx.Index.build(*SQUARE, allocator=self.memory.allocator, **options)
            self.assertFalse(self.memory.blocks)
        data = geoidx.Index.build(*SQUARE).to_bytes(codec="mapped")
        references = sys.getrefcount(data)
        with self.assertRaises(geoidx.LimitError):
            geoidx.Index.from_bytes(data, borrow=True, max_vertices=1, allocator=self.memory.allocator)
        self.assertFalse(self.memory.blocks)
        self.assertEqual(sys.getrefcount(data), references)


class Cycles(unittest.TestCase):
    """A callback that reaches the object it belongs to is collected with it."""

    class Owner:
        def metric(self, source, targets):
            return straight(SQUARE[0], source, targets)

        def progress(self, fraction, stage):
            return None

    def test_solver(self):
        owner = self.Owner()
        owner.solver = geoidx.Solver(*SQUARE, metric=owner.metric)
        self.assertEqual(owner.solver.distances(0, 1), 1)
        gone = weakref.ref(owner)
        del owner
        gc.collect()
        self.assertIsNone(gone())

    def test_index(self):
        owner = self.Owner()
        owner.index = geoidx.Index.build(*SQUARE, metric=owner.metric, progress=owner.progress)
        gone = weakref.ref(owner)
        del owner
        gc.collect()
        self.assertIsNone(gone())


class UseAfterClose(unittest.TestCase):
    def refused(self, call):
        with self.assertRaisesRegex(ValueError, "closed"):
            call()

    def test_index(self):
        index = geoidx.Index.build(*SQUARE)
        index.close()
        for call in (
            lambda: index.info,
            lambda: index.vertex_count,
            lambda: index.sssd(0, 1),
            lambda: index.sssd([0], 1),
            lambda: index.matrix([0]),
            lambda: index.matrix([]),
            lambda: index.msad(0),
            lambda: index.msad(0, radius=1),
            lambda: index.ssad([0]),
            lambda: index.ssad([]),
            lambda: index.nearest(0),
            lambda: index.within(0, 1),
            lambda: index.nearest_targets(0, [1], 1),
            lambda: index.farthest_points(1),
            lambda: index.query(),
            lambda: index.save("never"),
            lambda: index.to_bytes(),
            lambda: index.sections,
        ):
            self.refused(call)
        self.assertIn("closed", repr(index))

    def test_query(self):
        query = geoidx.Index.build(*SQUARE).query()
        surface, point = geoidx.Surface(*SQUARE), geoidx.surface_points(0, [1, 0, 0])
        with query:
            query.prepare(0)
            query.prepare_target(surface, point)
        for call in (
            lambda: query.sssd(0, 1),
            lambda: query.msad(0),
            lambda: query.msad(0, radius=1),
            lambda: query.ssad([0]),
            lambda: query.matrix([0]),
            lambda: query.nearest(0),
            lambda: query.within(0, 1),
            lambda: query.nearest_targets(0, [1], 1),
            lambda: query.farthest_points(1),
            lambda: query.prepare(0),
            lambda: query.prepared([0]),
            lambda: query.prepare_target(surface, point),
            lambda: query.next_step(surface, point),
            lambda: query.threads,
            lambda: setattr(query, "threads", 2),
        ):
            self.refused(call)

    def test_solver(self):
        with geoidx.Solver(*SQUARE) as solver:
            point = geoidx.surface_points(0, [1, 0, 0])
        self.refused(lambda: solver.vertex_count)
        self.refused(lambda: solver.distances(0))
        self.refused(lambda: solver.point_distances(point, point))


class Threads(unittest.TestCase):
    COUNT = 8

    @classmethod
    def setUpClass(cls):
        cls.mesh = hills(25, 24)
        cls.index = geoidx.Index.build(*cls.mesh, patches=(4, 4))

    def run_threads(self, work):
        """work(number) on each thread; raises what one of them raises."""
        failures = []
        barrier = threading.Barrier(self.COUNT)

        def run(number):
            try:
                barrier.wait()
                work(number)
            except BaseException as error:
                failures.append(error)

        threads = [threading.Thread(target=run, args=(number,)) for number in range(self.COUNT)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for failure in failures:
            raise failure

    def test_one_index(self):
        vertices = np.arange(self.COUNT)
        expected = self.index.ssad(vertices)
        matrix = self.index.matrix(vertices)

        def work(number):
            with self.index.query() as query:
                for _ in range(30):
                    np.testing.assert_array_equal(self.index.msad(number), expected[number])
                    np.testing.assert_array_equal(query.msad(number), expected[number])
                    np.testing.assert_array_equal(self.index.matrix(number, vertices)[0], matrix[number])
                    self.assertEqual(self.index.sssd(number, 5), matrix[number, 5])
                    self.assertEqual(query.sssd(number, 5), matrix[number, 5])

        self.run_threads(work)

    def test_errors_are_each_threads_own(self):
        def work(number):
            for _ in range(200):
                with self.assertRaisesRegex(geoidx.InvalidArgumentError, f"vertex {1000 + number} is"):
                    self.index.sssd(0, 1000 + number)

        self.run_threads(work)

    def test_closing_while_others_ask(self):
        """Calls under way end well; later ones say that the index is closed."""
        index = geoidx.Index.from_bytes(self.index.to_bytes())
        expected = self.index.ssad(range(self.COUNT))

        def work(number):
            with self.assertRaisesRegex(ValueError, "closed"):
                for turn in range(1 << 20):
                    np.testing.assert_array_equal(index.msad(number), expected[number])
                    if turn == 20 and number == 0:
                        index.close()

        self.run_threads(work)

    def test_a_call_lets_other_threads_run(self):
        """A Python metric called from threads of the library, while the calling thread waits in the library."""
        callers = set()

        def metric(source, targets):
            callers.add(threading.get_ident())
            return straight(vertices, source, targets)

        vertices, faces = plane(30, 30)
        geoidx.Index.build(vertices, faces, metric=metric, threads=3)
        self.assertGreater(len(callers), 1)

    def test_python_runs_during_a_build(self):
        done = threading.Event()
        turns = []

        def build():
            geoidx.Index.build(*hills(40, 40), threads=1)
            done.set()

        thread = threading.Thread(target=build)
        thread.start()
        while not done.wait(0.005):
            turns.append(None)
        thread.join()
        self.assertGreater(len(turns), 3)

    def test_a_query_is_one_threads(self):
        """Whoever asks a busy query is told so, and nothing else goes wrong."""
        query = self.index.query()
        expected = self.index.msad(0)
        refused = []

        def work(number):
            for _ in range(100):
                try:
                    np.testing.assert_array_equal(query.msad(0), expected)
                except RuntimeError as error:
                    refused.append(error)

        self.run_threads(work)
        np.testing.assert_array_equal(query.msad(0), expected)


class Exit(unittest.TestCase):
    def assert_ends(self, program):
        here = os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
        result = subprocess.run(
            [sys.executable, "-B", "-c", program],
            env={**os.environ, "PYTHONPATH": here},
            capture_output=True,
            text=True,
            timeout=60,
        )
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_the_interpreter_ends_with_everything_open(self):
        """Also while a thread is still inside the library."""
        self.assert_ends("""
import threading, geoidx, meshes
index = geoidx.Index.build(*meshes.hills(40, 40))
query = index.query()
solver = geoidx.Solver(*meshes.SQUARE)
def ask():
    while True:
        index.ssad(range(200))
threading.Thread(target=ask, daemon=True).start()
index.msad(0)
""")

    def test_the_interpreter_ends_while_the_library_calls_python(self):
        for call in (
            "geoidx.Index.build(*mesh, metric=metric)",
            "geoidx.Index.build(*mesh, metric=metric, threads=1)",
            "geoidx.Index.build(*mesh, metric=metric_by_solver)",
            "geoidx.Index.build(*meshes.hills(60, 60), progress=progress)",
            "geoidx.Solver(*mesh, metric=metric).distances(range(900))",
        ):
            with self.subTest(call):
                self.assert_ends(f"""
import threading, time, geoidx, meshes
mesh = meshes.plane(30, 30)
inside = threading.Event()
def metric(source, targets):
    inside.set()
    time.sleep(0.001)
    return meshes.straight(mesh[0], source, targets)
def metric_by_solver(source, targets):
    return geoidx.Solver(*mesh, metric=metric).distances(source, targets)
def progress(fraction, stage):
    inside.set()
    for _ in range(200):
        time.sleep(0.001)
def work():
    while True:
        {call}
threading.Thread(target=work, daemon=True).start()
inside.wait()
time.sleep(0.05)
""")

    def test_a_build_at_the_end_of_the_interpreter(self):
        self.assert_ends("""
import atexit, functools
@atexit.register
def build():
    metric = functools.partial(meshes.straight, meshes.SQUARE[0])
    assert abs(geoidx.Index.build(*meshes.SQUARE, metric=metric).sssd(0, 1) - 1) < 1e-3
import geoidx, meshes
""")

    def test_a_child_does_not_wait_for_calls_of_its_parent(self):
        self.assert_ends("""
import os, sys, threading, geoidx, meshes
inside = threading.Event()
begin = threading.Event()
def progress(fraction, stage):
    inside.set()
    begin.wait()
threading.Thread(target=geoidx.Index.build, args=meshes.SQUARE, kwargs={"progress": progress}, daemon=True).start()
inside.wait()
child = os.fork()
if child == 0:
    sys.exit()
os.waitpid(child, 0)  # while the parent's call goes on, which would not end before
begin.set()
""")


if __name__ == "__main__":
    unittest.main()
