"""Every status as its exception; files and bytes, whole and damaged."""

import io
import mmap
import os
import pickle
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from meshes import SQUARE, hills, plane

import geoidx
from geoidx import Status
from geoidx._errors import error_of


class Statuses(unittest.TestCase):
    def setUp(self):
        self.data = geoidx.Index.build(*SQUARE).to_bytes()

    def opened_with(self, offset, value):
        damaged = bytearray(self.data)
        damaged[offset] ^= value
        geoidx.Index.from_bytes(damaged)

    def raised(self, status, error, builtin, call, *arguments, **options):
        with self.assertRaises(error) as caught:
            call(*arguments, **options)
        found = caught.exception
        self.assertIs(type(found), error)
        self.assertIsInstance(found, geoidx.Error)
        self.assertIsInstance(found, builtin)
        self.assertEqual(found.status, status)
        self.assertTrue(found.detail)
        self.assertTrue(str(found).endswith(": " + found.detail))
        copy = pickle.loads(pickle.dumps(found))
        self.assertEqual((type(copy), copy.status, str(copy)), (error, status, str(found)))

    def test_invalid_argument(self):
        index = geoidx.Index.build(*SQUARE)
        self.raised(Status.INVALID_ARGUMENT, geoidx.InvalidArgumentError, ValueError, index.sssd, 0, 4)

    def test_io(self):
        index = geoidx.Index.build(*SQUARE)
        for call in (geoidx.Index.open, index.save):
            self.raised(Status.IO, geoidx.MissingFileError, FileNotFoundError, call, "/nonexistent/index.geoidx")
            self.raised(Status.IO, geoidx.FileError, OSError, call, "/dev/null/index.geoidx")

    def test_not_an_index(self):
        self.raised(Status.NOT_AN_INDEX, geoidx.NotAnIndexError, ValueError, geoidx.Index.from_bytes, b"solid " * 20)

    def test_truncated(self):
        for size in (0, 1, 47, len(self.data) - 1):
            data = self.data[:size]
            self.raised(Status.TRUNCATED, geoidx.TruncatedError, geoidx.FormatError, geoidx.Index.from_bytes, data)

    def test_corrupt(self):
        open_ = geoidx.Index.from_bytes
        self.raised(Status.CORRUPT, geoidx.CorruptError, geoidx.FormatError, open_, self.data + b"\0")

    def test_checksum(self):
        self.raised(Status.CHECKSUM, geoidx.ChecksumError, geoidx.FormatError, self.opened_with, len(self.data) // 2, 1)

    def test_unsupported_version(self):
        # The major version follows the magic of 8 bytes.
        error = geoidx.UnsupportedVersionError
        self.raised(Status.UNSUPPORTED_VERSION, error, geoidx.FormatError, self.opened_with, 8, 64)

    def test_mesh_mismatch(self):
        for expected in (hills(3, 3), (SQUARE[0] * 2, SQUARE[1]), (SQUARE[0], SQUARE[1][::-1])):
            self.raised(
                Status.MESH_MISMATCH,
                geoidx.MeshMismatchError,
                ValueError,
                geoidx.Index.from_bytes,
                self.data,
                expected_mesh=expected,
            )
        geoidx.Index.from_bytes(self.data, expected_mesh=SQUARE)
        vertices, faces = hills(6, 5)
        wide, narrow = vertices.astype(np.float64), vertices.astype(np.float32)
        self.assertFalse(np.array_equal(wide, narrow))
        for built, expected in ((wide, narrow), (narrow, wide)):
            data = geoidx.Index.build(built, faces).to_bytes()
            geoidx.Index.from_bytes(data, expected_mesh=(expected, faces))

    def test_limit(self):
        self.raised(
            Status.LIMIT,
            geoidx.LimitError,
            OverflowError,
            geoidx.Index.build,
            *SQUARE,
            metric=lambda source, targets: np.where(targets == source, 0, 1e300),
        )

    def test_limits_of_opening(self):
        index = geoidx.Index.build(*hills(20, 20))
        for codec in geoidx.Codec:
            data = index.to_bytes(codec=codec)
            for limit in ({"max_vertices": 399}, {"max_memory": 1000}):
                self.raised(
                    Status.LIMIT, geoidx.LimitError, OverflowError, geoidx.Index.from_bytes, data, **limit
                )
            opened = geoidx.Index.from_bytes(data, max_vertices=400, max_memory=1 << 40)
            self.assertEqual(opened.sssd(0, 399), index.sssd(0, 399))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "index")
            index.save(path, codec="mapped")
            for limit in ({"max_vertices": 399}, {"max_memory": 1000}):
                with self.assertRaisesRegex(geoidx.LimitError, *limit):
                    geoidx.Index.open(path, **limit)
            geoidx.Index.open(path, max_vertices=400, max_memory=1 << 40).close()
        for limit in ({"max_vertices": -1}, {"max_memory": 1 << 64}):
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, *limit):
                geoidx.Index.from_bytes(data, **limit)

    def test_out_of_memory(self):
        refusing = geoidx.Allocator(geoidx.AllocateFn(lambda *_: None), geoidx.ReleaseFn(lambda *_: None))
        for call, arguments in ((geoidx.Index.build, SQUARE), (geoidx.Index.from_bytes, (self.data,))):
            self.raised(
                Status.OUT_OF_MEMORY, geoidx.OutOfMemoryError, MemoryError, call, *arguments, allocator=refusing
            )

    def test_cancelled(self):
        self.raised(
            Status.CANCELLED,
            geoidx.CancelledError,
            geoidx.Error,
            geoidx.Index.build,
            *SQUARE,
            progress=lambda fraction, stage: False,
        )

    def test_bad_mesh(self):
        self.raised(Status.BAD_MESH, geoidx.BadMeshError, ValueError, geoidx.Index.build, SQUARE[0], [[0, 1, 4]])

    def test_callback(self):
        self.raised(
            Status.CALLBACK,
            geoidx.CallbackError,
            RuntimeError,
            geoidx.Index.build,
            *SQUARE,
            metric=lambda source, targets: np.full(len(targets), np.nan),
        )

    def test_internal(self):
        def fail():
            raise error_of(Status.INTERNAL, "a defect")

        self.raised(Status.INTERNAL, geoidx.InternalError, RuntimeError, fail)

    def test_each_status_has_its_own_exception(self):
        found = {type(error_of(status, "")) for status in Status if status != Status.OK}
        self.assertEqual(len(found), len(Status) - 1)
        self.assertNotIn(geoidx.Error, found)
        self.assertLessEqual({error.__name__ for error in found}, set(geoidx.__all__))

    def test_a_status_of_a_newer_library(self):
        error = error_of(-99, "new")
        self.assertEqual((type(error), error.status, str(error)), (geoidx.Error, -99, "unknown status: new"))


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = hills(15, 14)
        cls.index = geoidx.Index.build(*cls.mesh, patches=(3, 3))
        cls.data = cls.index.to_bytes()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def assert_same(self, index):
        np.testing.assert_array_equal(index.msad([0, 9]), self.index.msad([0, 9]))
        self.assertEqual(index.info, self.index.info)
        self.assertEqual(index.to_bytes(), self.data)

    def test_paths(self):
        plain = self.folder / "Käse 距離.geoidx"
        for path in (plain, str(plain), os.fsencode(plain), os.fsencode(self.folder) + b"/\xff.geoidx"):
            self.index.save(path)
            self.assert_same(geoidx.Index.open(path))
            self.assert_same(geoidx.Index.open(path, expected_mesh=self.mesh))
            self.assertEqual(geoidx.Index.open(path, pairs=True, threads=2).sssd(0, 9), self.index.sssd(0, 9))
            self.assert_same(geoidx.Index.open(path, labels=False))
        self.assertEqual(plain.read_bytes(), self.data)
        for path in ("a\0b", b"a\0b"):
            with self.assertRaises(ValueError):
                self.index.save(path)
        with self.assertRaises(TypeError):
            geoidx.Index.open(3)

    def test_buffers(self):
        path = self.folder / "index"
        path.write_bytes(self.data)
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as mapped:
            self.assert_same(geoidx.Index.from_bytes(mapped))
        for buffer in (self.data, bytearray(self.data), memoryview(self.data), np.frombuffer(self.data, np.uint8)):
            self.assert_same(geoidx.Index.from_bytes(buffer))
        self.assert_same(geoidx.Index.from_bytes(io.BytesIO(self.data).getbuffer()))

    def test_buffers_that_cannot_be_read(self):
        closed = mmap.mmap(-1, 100)
        closed.close()
        released = memoryview(self.data)
        released.release()
        columns = np.asfortranarray(np.zeros((9, 9)))
        for buffer in (memoryview(self.data)[::2], np.frombuffer(self.data, "u1")[::2], columns, closed, released):
            for call in (geoidx.Index.from_bytes, geoidx.verify):
                with self.assertRaisesRegex(geoidx.InvalidArgumentError, type(buffer).__name__):
                    call(buffer)
        for nothing in (3, None, [1, 2], io.BytesIO(self.data)):
            for call in (geoidx.Index.from_bytes, geoidx.verify):
                with self.assertRaises(TypeError):
                    call(nothing)
        for empty in (b"", bytearray(), memoryview(b""), np.empty(0, np.uint8)):
            with self.assertRaises(geoidx.TruncatedError):
                geoidx.Index.from_bytes(empty)

    def test_no_file_is_an_error_of_another_kind(self):
        """Whatever is wrong with a path, it is a geoidx.Error, and an OSError where the system says so."""
        empty = self.folder / "empty"
        empty.touch()
        for call in (geoidx.Index.open, geoidx.verify, self.index.save):
            for path in ("a\0b", "\ud800", Path("a\0b")):
                with self.subTest(call=call, path=path), self.assertRaises(geoidx.InvalidArgumentError):
                    call(path)
            for path in (self.folder, str(self.folder), empty / "below", "n" * 5000, self.folder / "no" / "such"):
                with self.subTest(call=call, path=path), self.assertRaises(geoidx.FileError) as caught:
                    call(path)
                self.assertEqual(caught.exception.filename, os.fspath(path))
        for call in (geoidx.Index.open, geoidx.verify):
            with self.assertRaises(geoidx.MissingFileError):
                call("")
        with self.assertRaises(geoidx.TruncatedError):
            geoidx.Index.open(empty)
        self.assertEqual([issue.status for issue in geoidx.verify(empty)], [Status.TRUNCATED])

    def test_path_like_bytes(self):
        class PathLike:
            def __fspath__(_):
                return os.fsencode(self.folder / "index")

        self.index.save(PathLike())
        self.assert_same(geoidx.Index.open(PathLike()))
        self.assertEqual(geoidx.verify(PathLike()), [])

    def test_an_expected_mesh_is_a_pair(self):
        for other in ((), self.mesh[0], (*self.mesh, 3), "ab"):
            with self.assertRaisesRegex(TypeError, "expected_mesh"):
                geoidx.Index.from_bytes(self.data, expected_mesh=other)
        self.assert_same(geoidx.Index.from_bytes(self.data, expected_mesh=list(self.mesh)))

    def test_bytes_are_not_needed_after_the_call(self):
        data = bytearray(self.data)
        index = geoidx.Index.from_bytes(data)
        data[:] = bytes(len(data))
        self.assert_same(index)

    def test_more_bytes_than_expected(self):
        for size in (0, 100, len(self.data) - 1, len(self.data)):
            with mock.patch.object(geoidx.Index, "_likely_size", return_value=size):
                self.assertEqual(self.index.to_bytes(), self.data)

    def assert_like_open(self, path, call):
        """An OSError as that of Python's own `open`."""
        with self.assertRaises(OSError) as expected:
            open(path, "rb")
        with self.assertRaises(geoidx.FileError) as caught:
            call(path)
        copy = pickle.loads(pickle.dumps(caught.exception))
        for name in ("errno", "strerror", "filename"):
            for found in (caught.exception, copy):
                self.assertEqual(getattr(found, name), getattr(expected.exception, name))

    def test_what_the_system_says(self):
        for path in (self.folder / "missing", b"/dev/null/index"):
            self.assert_like_open(path, geoidx.Index.open)
        for path in (self.folder / "missing", self.folder, "/dev/null/index"):
            self.assert_like_open(path, geoidx.verify)
        self.assert_like_open("/nonexistent/index", self.index.save)

    def test_without_a_reason_of_the_system(self):
        error = error_of(Status.IO, "cannot write 'index': nothing was written", "index")
        self.assertIs(type(error), geoidx.FileError)
        self.assertEqual((error.errno, error.strerror, error.filename), (None, None, "index"))

    def test_pickle(self):
        self.assert_same(pickle.loads(pickle.dumps(self.index)))

    def test_a_failed_save_leaves_the_old_file(self):
        path = self.folder / "index"
        path.mkdir()
        with self.assertRaisesRegex(geoidx.FileError, "directory"):
            self.index.save(path)
        self.assertEqual(list(self.folder.iterdir()), [path])


class Verify(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.data = geoidx.Index.build(*plane(9, 9), patches=(3, 2)).to_bytes()

    def test_sound(self):
        self.assertEqual(geoidx.verify(self.data), [])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "index")
            path.write_bytes(self.data)
            self.assertEqual(geoidx.verify(path), [])
            self.assertEqual(geoidx.verify(str(path)), [])
            with self.assertRaises(geoidx.MissingFileError):
                geoidx.verify(Path(folder, "other"))

    def test_issues(self):
        (issue,) = geoidx.verify(self.data[:-1])
        self.assertEqual(issue.status, Status.TRUNCATED)
        self.assertEqual(issue.number, geoidx.IssueNumber.FILE_TRUNCATED)
        self.assertEqual(issue.offset, len(self.data) - 1)
        self.assertTrue(issue.message)
        damaged = bytearray(self.data)
        for offset in range(len(damaged) // 2, len(damaged), 64):
            damaged[offset] ^= 1
        issues = geoidx.verify(damaged)
        self.assertGreater(len(issues), 1)
        statuses = {issue.status for issue in issues}
        self.assertIn(Status.CHECKSUM, statuses)
        self.assertLessEqual(statuses, {Status.CHECKSUM, Status.CORRUPT})  # of data, of what says where it is
        self.assertTrue(all(0 < issue.offset < len(damaged) for issue in issues))
        self.assertEqual(geoidx.verify(damaged, most=1), issues[:1])
        for most in (0, -1, 1.5):
            with self.assertRaises((geoidx.InvalidArgumentError, TypeError)):
                geoidx.verify(damaged, most=most)

    def test_number_and_place(self):
        other_version = bytearray(self.data)
        other_version[8] = 77
        (issue,) = geoidx.verify(other_version)
        self.assertEqual((issue.number, issue.offset), (geoidx.IssueNumber.VERSION, 8))


if __name__ == "__main__":
    unittest.main()
