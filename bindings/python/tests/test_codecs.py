"""The forms of a file, and what it is made of."""

import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np
from meshes import hills

import geoidx
from geoidx import Codec, Coding, _native
from geoidx._info import info_of
from geoidx._sections import section_of

TABLES = ["OVOV", "BVIV", "IVIV"]
NAMES = {"packed": Codec.PACKED, "lossless": Codec.LOSSLESS, "mapped": Codec.MAPPED}


class Codecs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.index = geoidx.Index.build(*hills(24, 24))

    def test_names(self):
        for name, codec in NAMES.items():
            self.assertEqual(self.index.to_bytes(codec=name), self.index.to_bytes(codec=codec))
        for larger in ("lossless", "mapped"):
            self.assertLess(len(self.index.to_bytes(codec="packed")), len(self.index.to_bytes(codec=larger)))

    def test_the_default_is_that_of_the_index(self):
        self.assertIs(self.index.info.codec, Codec.PACKED)
        self.assertEqual(self.index.to_bytes(), self.index.to_bytes(codec="packed"))
        for name, codec in NAMES.items():
            data = self.index.to_bytes(codec=name)
            opened = geoidx.Index.from_bytes(data)
            self.assertIs(opened.info.codec, codec)
            self.assertEqual(opened.to_bytes(), data)

    def assert_answers(self, opened):
        np.testing.assert_array_equal(opened.ssad([5, 99]), self.index.ssad([5, 99]))
        self.assertEqual(opened.sssd(0, 575), self.index.sssd(0, 575))

    def test_answers_are_the_same_bits(self):
        for name in NAMES:
            opened = geoidx.Index.from_bytes(self.index.to_bytes(codec=name))
            self.assert_answers(opened)
            for other in NAMES:
                self.assertEqual(opened.to_bytes(codec=other), self.index.to_bytes(codec=other))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "index")
            for codec in (None, *NAMES):
                self.index.save(path, codec=codec)
                self.assertEqual(path.read_bytes(), self.index.to_bytes(codec=codec))
                self.assertEqual(geoidx.verify(path), [])
                self.assert_answers(geoidx.Index.open(path))

    def test_a_mapped_file_that_is_replaced_while_it_is_open(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "index")
            self.index.save(path, codec="mapped")
            opened = geoidx.Index.open(path)
            opened.save(path, codec="packed")
            self.assertEqual(path.read_bytes(), self.index.to_bytes())
            self.assert_answers(opened)

    def test_the_buffer_of_a_mapped_file_is_not_needed_afterwards(self):
        data = bytearray(self.index.to_bytes(codec="mapped"))
        opened = geoidx.Index.from_bytes(data)
        data[:] = bytes(len(data))
        self.assert_answers(opened)

    def test_borrowed_bytes(self):
        for name in NAMES:
            for pairs in (False, True):
                data = self.index.to_bytes(codec=name)
                opened = geoidx.Index.from_bytes(data, borrow=True, pairs=pairs)
                self.assert_answers(opened)
                self.assertEqual(opened.to_bytes(), data)

    def test_only_bytes_are_borrowed(self):
        class Subclass(bytes):
            pass

        data = self.index.to_bytes(codec="mapped")
        for other in (bytearray(data), memoryview(data), np.frombuffer(data, np.uint8), Subclass(data)):
            with self.assertRaisesRegex(TypeError, f"not {type(other).__name__}"):
                geoidx.Index.from_bytes(other, borrow=True)
            self.assert_answers(geoidx.Index.from_bytes(other))

    def test_a_mapped_file_has_its_tables_as_they_are(self):
        sections = geoidx.Index.from_bytes(self.index.to_bytes(codec="mapped")).sections
        (tables,) = [section for section in sections if section.tag == "HOPS"]
        self.assertIs(tables.coding, Coding.RAW)
        self.assertEqual(tables.stored_size, tables.raw_size)
        self.assertFalse({section.tag for section in sections} & set(TABLES))

    def test_a_codec_that_is_none(self):
        for codec in ("PACKED", "", "none", 7):
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "codec"):
                self.index.to_bytes(codec=codec)
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "codec"):
                self.index.save("never.geoidx", codec=codec)

    def test_a_graph_is_always_lossless(self):
        graph = geoidx.Index.build(*hills(9, 9), engine="graph")
        self.assertIs(graph.info.codec, Codec.LOSSLESS)
        self.assertEqual(graph.to_bytes(codec="packed"), graph.to_bytes(codec="lossless"))
        self.assertEqual((graph.info.smallest_step, graph.info.largest_step), (0, 0))

    def test_positions_that_are_left_out(self):
        mesh = hills(24, 24)
        self.assertTrue(self.index.info.has_positions)
        for name in NAMES:
            data = self.index.to_bytes(codec=name, positions=False)
            self.assertLess(len(data), len(self.index.to_bytes(codec=name)))
            opened = geoidx.Index.from_bytes(data, expected_mesh=mesh)
            self.assertFalse(opened.info.has_positions)
            self.assert_answers(opened)
            self.assertEqual(opened.to_bytes(), data)
            self.assertEqual(opened.to_bytes(codec="packed"), self.index.to_bytes(codec="packed", positions=False))
            self.assertEqual(opened.to_bytes(positions=True), self.index.to_bytes(codec=name))
            self.assert_answers(pickle.loads(pickle.dumps(opened)))
            self.assertEqual(geoidx.verify(data), [])
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "expected_mesh"):
                geoidx.Index.from_bytes(data)
            with self.assertRaises(geoidx.MeshMismatchError):
                geoidx.Index.from_bytes(data, expected_mesh=hills(24, 23))

    def test_a_file_without_positions(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "index")
            self.index.save(path, positions=False)
            self.assertEqual(path.read_bytes(), self.index.to_bytes(positions=False))
            self.assert_answers(geoidx.Index.open(path, expected_mesh=hills(24, 24)))
            with self.assertRaisesRegex(geoidx.InvalidArgumentError, "expected_mesh"):
                geoidx.Index.open(path)

    def test_sections(self):
        self.assertEqual(self.index.sections, ())
        for codec, coding in (("packed", Coding.IMAGES), ("lossless", Coding.PNG)):
            data = self.index.to_bytes(codec=codec)
            sections = geoidx.Index.from_bytes(data).sections
            self.assertEqual([section.tag for section in sections][:3], ["META", "HIER", "VERT"])
            self.assertEqual(sections[-1].offset + sections[-1].stored_size, len(data))
            tables = [section for section in sections if section.tag in TABLES]
            self.assertEqual([section.tag for section in tables], TABLES)
            for section in tables:
                self.assertIs(section.coding, coding)
                self.assertLess(section.stored_size, section.raw_size)

    def test_numbers_of_later_versions_have_no_name(self):
        info = _native.Info()
        info.metric = 4
        self.assertEqual(info_of(info).metric, 4)
        info.metric = 3
        self.assertIs(info_of(info).metric, geoidx.MetricKind.WEIGHTED)
        section = _native.Section()
        section.tag, section.coding = b"\xffA\n\x1b", 77
        self.assertEqual(section_of(section).coding, 77)
        self.assertEqual(section_of(section).tag.encode("ascii"), b"\\xffA\n\x1b")

    def test_rounding_makes_steps_larger_and_the_file_smaller(self):
        mesh = hills(40, 40)
        coarse, fine = geoidx.Index.build(*mesh), geoidx.Index.build(*mesh, rounding=0)
        self.assertEqual(geoidx.Index.build(*mesh, rounding=1 / 64).to_bytes(), coarse.to_bytes())
        self.assertGreater(fine.info.smallest_step, 0)
        self.assertLessEqual(fine.info.smallest_step, fine.info.largest_step)
        self.assertGreater(coarse.info.smallest_step, 2 * fine.info.smallest_step)
        self.assertLess(len(coarse.to_bytes()), len(fine.to_bytes()))


if __name__ == "__main__":
    unittest.main()
