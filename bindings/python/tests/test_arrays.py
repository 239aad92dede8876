"""Which meshes are taken, and which of them are not copied."""

import tracemalloc
import unittest

import numpy as np
from meshes import SQUARE, hills, plane

import geoidx
from geoidx import _arrays
from geoidx._mesh import MeshView


def records(vertices, faces):
    """Vertices as a part of larger records, as in a vertex buffer."""
    buffer = np.zeros(len(vertices), [("color", "u1", 4), ("position", "f4", 3), ("normal", "f4", 3)])
    buffer["position"] = vertices
    return buffer["position"], faces


class ZeroCopy(unittest.TestCase):
    def assert_not_copied(self, vertices, faces):
        view = MeshView(vertices, faces)
        self.assertTrue(np.shares_memory(view.vertices, vertices))
        self.assertTrue(np.shares_memory(view.faces, faces))
        self.assertEqual(view.struct.positions, vertices.ctypes.data)
        self.assertEqual(view.struct.triangles, faces.ctypes.data)

    def test_arrays_as_the_library_takes_them(self):
        vertices, faces = hills(6, 5)
        for vertex_type in (np.float32, np.float64):
            for face_type in (np.uint32, np.int32):
                with self.subTest(vertices=vertex_type, faces=face_type):
                    self.assert_not_copied(vertices.astype(vertex_type), faces.astype(face_type))

    def test_parts_of_records(self):
        self.assert_not_copied(*records(*hills(6, 5)))
        wide = np.zeros((30, 8))
        self.assert_not_copied(wide[:, 2:5], hills(6, 5)[1])

    def test_read_only(self):
        vertices, faces = hills(6, 5)
        vertices.flags.writeable = faces.flags.writeable = False
        self.assert_not_copied(vertices, faces)

    def test_ids(self):
        for dtype in (np.uint32, np.int32):
            sources = np.arange(5, dtype=dtype)
            self.assertTrue(np.shares_memory(_arrays.ids(sources, "sources"), sources))

    def test_costs(self):
        costs = np.ones(4)
        self.assertIs(_arrays.doubles(costs, "costs", 4), costs)

    def test_bytes_are_not_copied_to_be_opened(self):
        """Beside the buffer, opening takes no memory of Python's that grows with it."""
        data = bytearray(geoidx.Index.build(*hills(20, 20)).to_bytes())
        tracemalloc.start()
        geoidx.Index.from_bytes(data)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        self.assertLess(peak, len(data) / 4)


class SameMesh(unittest.TestCase):
    """Arrays that have to be copied are the same mesh as those that need not."""

    def setUp(self):
        vertices, self.faces = hills(6, 5)
        self.vertices = vertices.astype(np.float32)
        self.expected = geoidx.Index.build(self.vertices, self.faces).to_bytes()

    def check(self, vertices, faces):
        self.assertEqual(geoidx.Index.build(vertices, faces).to_bytes(), self.expected)

    def test_vertices(self):
        vertices = self.vertices
        unaligned = np.zeros(vertices.nbytes + 1, np.uint8)[1:].view(np.float32).reshape(-1, 3)
        unaligned[:] = vertices
        layouts = {
            "float64": vertices.astype(np.float64),
            "list": vertices.tolist(),
            "column-major": np.asfortranarray(vertices),
            "reversed": vertices[::-1].copy()[::-1],
            "reversed columns": vertices[:, ::-1].copy()[:, ::-1],
            "every second": np.repeat(vertices, 2, axis=0)[::2],
            "big-endian": vertices.astype(">f4"),
            "big-endian doubles": vertices.astype(">f8"),
            "unaligned": unaligned,
            "record": records(vertices, None)[0],
            "longdouble": vertices.astype(np.longdouble),
            "read-only": np.broadcast_to(vertices, vertices.shape),
        }
        for name, layout in layouts.items():
            with self.subTest(name):
                self.check(layout, self.faces)

    def test_integers(self):
        vertices, faces = plane(5, 5)
        expected = geoidx.Index.build(vertices, faces).to_bytes()
        self.assertEqual(geoidx.Index.build(vertices.astype(int), faces).to_bytes(), expected)
        self.assertEqual(geoidx.Index.build(vertices.astype(np.float16), faces).to_bytes(), expected)

    def test_faces(self):
        faces = self.faces
        for dtype in "u1 i2 u2 i4 u4 i8 u8 >u4 >i8".split():
            with self.subTest(dtype):
                self.check(self.vertices, faces.astype(dtype))
        self.check(self.vertices, faces.tolist())
        self.check(self.vertices, np.asfortranarray(faces))
        self.check(self.vertices, np.repeat(faces, 3, axis=0)[::3])

    def test_the_mesh_is_not_needed_after_the_call(self):
        vertices, faces = hills(6, 5)
        index, solver = geoidx.Index.build(vertices, faces), geoidx.Solver(vertices, faces)
        field, exact = index.msad(0), solver.distances(0)
        vertices[:] = np.nan
        faces[:] = 0
        np.testing.assert_array_equal(index.msad(0), field)
        np.testing.assert_array_equal(solver.distances(0), exact)


class Refusals(unittest.TestCase):
    def refused(self, error, vertices, faces):
        for take in (geoidx.Index.build, geoidx.Solver):
            with self.assertRaises(error) as caught:
                take(vertices, faces)
        return str(caught.exception)

    def test_dtypes(self):
        vertices, faces = SQUARE
        for dtype in (complex, bool, object, "U8"):
            self.refused(TypeError, vertices.astype(dtype), faces)
        for dtype in (float, bool, object, "U8"):
            self.refused(TypeError, vertices, faces.astype(dtype))

    def test_masked_values(self):
        """A mask that hides something is refused; one that hides nothing is as none."""
        vertices, faces = SQUARE
        error = geoidx.InvalidArgumentError
        self.assertIn("mask", self.refused(error, np.ma.array(vertices, mask=np.eye(4, 3)), faces))
        self.assertIn("mask", self.refused(error, vertices, np.ma.array(faces, mask=np.eye(2, 3))))
        index = geoidx.Index.build(np.ma.array(vertices), np.ma.array(faces, mask=False))
        with self.assertRaises(error):
            index.msad(np.ma.array([0, 1], mask=[False, True]))

    def test_options_too_large_for_a_float(self):
        for name in ("weld_tolerance", "delta", "rounding", "target_error"):
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, name):
                geoidx.Index.build(*SQUARE, **{name: 10**400})
        for take in (geoidx.Solver, geoidx.Surface):
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "weld_tolerance"):
                take(*SQUARE, weld_tolerance=10**400)

    def test_flags(self):
        """A text, or a number, is neither True nor False."""
        for name in ("store_mesh", "refuse_edges_of_many"):
            for value in ("no", 1, None):
                with self.assertRaisesRegex(TypeError, name):
                    geoidx.Index.build(*SQUARE, **{name: value})
        index = geoidx.Index.build(*SQUARE, store_mesh=np.bool_(True))
        self.assertTrue(index.info.has_mesh)
        data = index.to_bytes()
        for name in ("pairs", "labels", "borrow"):
            with self.assertRaisesRegex(TypeError, name):
                geoidx.Index.from_bytes(data, **{name: "no"})
        for name in ("positions", "mesh"):
            with self.assertRaisesRegex(TypeError, name):
                index.to_bytes(**{name: "no"})
        with self.assertRaisesRegex(TypeError, "unfoldable"):
            geoidx.Solver(*SQUARE, metric=geoidx.Callback(lambda source, targets: targets * 0.0, unfoldable="no"))

    def test_numpy_integers_beside_python_ones(self):
        """NumPy makes floats of a list with a np.uint64 and an int."""
        index = geoidx.Index.build(*SQUARE)
        np.testing.assert_array_equal(index.msad([np.uint64(3), 1]), index.msad([3, 1]))
        with self.assertRaisesRegex(geoidx.InvalidArgumentError, "hold -1"):
            index.msad([np.uint64(3), -1])
        for odd in (1.0, 1.5):
            with self.assertRaisesRegex(TypeError, "float64"):
                index.msad([np.uint64(3), odd])

    def test_a_class_is_no_metric(self):
        """Not even a callback, though it can be called."""
        for metric in (geoidx.Exact, geoidx.Edges, geoidx.Weighted, geoidx.Callback):
            for take in (geoidx.Index.build, geoidx.Solver, geoidx.Surface):
                with self.assertRaisesRegex(TypeError, metric.__name__):
                    take(*SQUARE, metric=metric)

    def test_shapes(self):
        vertices, faces = SQUARE
        error = geoidx.InvalidArgumentError
        for shape in ((12,), (6, 2), (2, 2, 3), (3, 4)):
            self.assertIn("vertices has the shape", self.refused(error, vertices.reshape(shape), faces))
        for shape in ((6,), (3, 2), (1, 2, 3)):
            self.assertIn("faces has the shape", self.refused(error, vertices, faces.reshape(shape)))
        self.refused(error, [], faces)
        self.refused(error, vertices, [])

    def test_empty(self):
        vertices, faces = SQUARE
        self.refused(geoidx.BadMeshError, np.empty((0, 3)), faces)
        self.refused(geoidx.BadMeshError, np.empty((0, 3), np.float32), np.empty((0, 3), np.uint32))
        self.refused(geoidx.BadMeshError, vertices, np.empty((0, 3), int))

    def test_positions_that_are_no_numbers(self):
        for bad in (np.nan, np.inf, -np.inf):
            for dtype in (np.float32, np.float64):
                vertices = SQUARE[0].astype(dtype)
                vertices[2, 1] = bad
                self.assertIn("vertex 2", self.refused(geoidx.BadMeshError, vertices, SQUARE[1]))

    def test_rows_of_different_lengths(self):
        for vertices, faces in (([[0, 0, 0], [1, 1]], [[0, 1, 2]]), (SQUARE[0], [[0, 1, 2], [0, 1]])):
            with self.assertRaises((geoidx.InvalidArgumentError, TypeError)) as caught:  # the latter by old NumPy
                geoidx.Index.build(vertices, faces)
            self.assertNotEqual(type(caught.exception), ValueError)

    def test_faces_out_of_range(self):
        vertices = SQUARE[0]
        for dtype, bad in ((np.uint32, 4), (np.int32, -1), (np.int64, -1), (np.int64, 1 << 32), (np.uint64, 1 << 40)):
            faces = SQUARE[1].astype(dtype)
            faces[1, 1] = bad
            self.assertIn(str(bad), self.refused(geoidx.BadMeshError, vertices, faces))


if __name__ == "__main__":
    unittest.main()
