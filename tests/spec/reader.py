"""An index file, read as format/SPEC.md has it, without the library.

It reads what a valid file holds and checks the header, the padding and the checksums; the other refusals of the
document are tested elsewhere.
"""

import struct

import numpy
import xxhash

from container import RAW, read_sections, require
from middle_offsets import NO_PATH, means, offsets, strides
from packed import PackedTables
from raised_middles import raised_middles

NONE = 0xFFFFFFFF
GRAPH, OVERLAY = 0, 1
PACKED, LOSSLESS, MAPPED = 0, 1, 2


class Fields:
    """Arrays that follow each other without padding."""

    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, kind, count):
        array = numpy.frombuffer(self.content, kind, count, self.at)
        self.at += array.nbytes
        return array

    def remaining(self):
        return len(self.content) - self.at

    def planes(self, count, size=4):
        """Numbers of 4 or 8 bytes, of which all lowest bytes stand first."""
        planes = self.take("u1", size * count).reshape(size, count)
        return numpy.ascontiguousarray(planes.T).view(f"<u{size}").reshape(count)

    def differences(self, count, columns, size=4):
        """The rows of a matrix, each number as its difference from the one above, with a sign in the lowest bit."""
        stored = self.planes(count * columns, size)
        one = stored.dtype.type(1)
        differences = stored >> one ^ (~(stored & one) + one)
        return differences.reshape(count, columns).cumsum(axis=0, dtype=stored.dtype)

    def rest(self, kind):
        return self.take(kind, self.remaining() // numpy.dtype(kind).itemsize)


def unfold(matrix, size):
    """The symmetric table of a folded triangle, with 0 on its diagonal."""
    table = numpy.zeros((size, size), "f4")
    if size < 2:
        return table
    for r, line in enumerate(matrix):
        long = size - 1 - r
        short = r if size % 2 == 0 else r + 1
        table[long, :long] = line[:long]
        if short != long:
            table[short, :short] = line[long : long + short]
    return table + table.T


def fingerprint_of(points, triangles):
    rounded = numpy.asarray(points).astype("<f4") + numpy.float32(0)
    first = xxhash.xxh3_64_intdigest(rounded.tobytes())
    return xxhash.xxh3_64_intdigest(numpy.asarray(triangles).astype("<u4").tobytes(), seed=first)


class Index:
    """What a file holds: the hierarchy, whose each vertex number is, and the tables of its engine.

    mesh: the positions of all ids, in the precision that the index was built with, and the triangles; for a file that
    leaves positions out.
    """

    def __init__(self, path, mesh=None):
        with open(path, "rb") as file:
            self.sections, self.fingerprint = read_sections(file.read())
        meta = self.sections["META"].bytes()
        require(len(meta) == 184, "META of another size")
        (self.id_count, self.triangle_count) = struct.unpack_from("<QQ", meta)
        (self.engine,) = struct.unpack_from("<I", meta, 104)
        (self.codec,) = struct.unpack_from("<I", meta, 116)
        self._read_hierarchy()
        if mesh:
            counts = tuple(map(len, mesh))
            require(counts == (self.id_count, self.triangle_count), "a mesh of another size")
            require(fingerprint_of(*mesh) == self.fingerprint, "another mesh")
        self._read_vertices()
        self._read_positions(mesh)
        self._read_borders()
        if self.engine == OVERLAY:
            self._read_overlays()
        if self.codec == PACKED:
            return self._read_packed()
        if self.codec == MAPPED:
            return self._read_mapped()
        self._read_leaf_tables()
        if self.engine == GRAPH:
            self._read_border_tables()
        else:
            self._read_overlay_tables()

    def _read_hierarchy(self):
        fields = Fields(self.sections["HIER"].bytes())
        (self.levels,), (self.inner_count,) = fields.take("<u4", 1), fields.take("<u8", 1)
        self.parent, self.children = [None], []
        for patch, count in enumerate(fields.take("<u4", int(self.inner_count))):
            first = len(self.parent)
            self.children.append(range(first, first + int(count)))
            self.parent += [patch] * int(count)
        self.inner_count, self.patch_count = int(self.inner_count), len(self.parent)

    def _read_vertices(self):
        fields = Fields(self.sections["VERT"].bytes())
        self.vertex_count = int(fields.take("<u8", 1)[0])
        self.number_of_id = fields.planes(self.id_count)  # those that no id has are added vertices

    def _read_positions(self, mesh):
        fields = Fields(self.sections["POSI"].bytes())
        (self.position_step,), origin = fields.take("<f4", 1), fields.take("<f8", 3)
        (checksum,) = fields.take("<u8", 1)
        held = (len(fields.content) - fields.at) // 12
        stored = fields.planes(3 * held).astype(int)
        differences = numpy.where(stored % 2, -(stored + 1) // 2, stored // 2)
        of_held = differences.reshape(-1, 3).cumsum(axis=0)
        self.has_positions = held == self.vertex_count
        if self.has_positions:
            self.positions = of_held
        else:
            require(mesh, "positions are left out, and there is no mesh")
            self.positions = self._positions_of(mesh[0], origin, of_held)
        coordinates = self.positions.astype("<i4").tobytes()
        require(xxhash.xxh3_64_intdigest(coordinates) == checksum, "the checksum of the positions does not match")

    def kept_mesh(self):
        """The positions and triangles that the file keeps, or None."""
        if "MESH" not in self.sections:
            return None
        fields = Fields(self.sections["MESH"].bytes())
        (position_type,) = fields.take("<u4", 1)
        require(position_type in (0, 1), "another type of positions")
        triangles = fields.differences(3 * self.triangle_count, 1).reshape(-1, 3)
        size = 8 if position_type else 4
        points = fields.differences(self.id_count, 3, size).view(f"<f{size}")
        require(fields.at == len(fields.content), "bytes behind the mesh")
        require(fingerprint_of(points, triangles) == self.fingerprint, "another mesh is kept")
        return points, triangles

    def _positions_of(self, points, origin, of_added):
        """In steps: of the lowest id of each number, and of the added vertices, which no id has."""
        numbers, lowest = numpy.unique(self.number_of_id, return_index=True)
        numbers, lowest = numbers[numbers != NONE], lowest[numbers != NONE]
        added = numpy.setdiff1d(numpy.arange(self.vertex_count), numbers)
        require(len(added) == len(of_added), "positions of other vertices than the added ones")
        apart = numpy.asarray(points)[lowest].astype("f8") - origin
        steps = numpy.floor(apart / float(self.position_step) + 0.5)
        positions = numpy.empty((self.vertex_count, 3), int)
        positions[numbers] = numpy.clip(steps, 0, 2**23 - 1)
        positions[added] = of_added
        return positions

    def _read_borders(self):
        fields = Fields(self.sections["BORD"].bytes())
        counts = fields.take("<u4", self.patch_count).astype(int)
        sizes = numpy.insert(fields.take("<u4", self.patch_count - 1), 0, 0).astype(int)
        ends = numpy.cumsum(counts)
        # Of an inner patch, the numbers that it owns; of a leaf, its internal vertices.
        self.inside = [range(end - count, end) for end, count in zip(ends, counts)]
        self.border_vertex_count = self.inside[self.inner_count - 1].stop
        self.border_begin = numpy.insert(numpy.cumsum(sizes), 0, 0)
        numbers = fields.planes(int(sizes.sum())).astype(int)
        self.border = [numbers[a:b] for a, b in zip(self.border_begin, self.border_begin[1:])]
        self.entry = numpy.repeat(numpy.arange(self.patch_count), counts)
        self.leaves = range(self.inner_count, self.patch_count)

    def is_border(self, number):
        return number < self.border_vertex_count

    def overlay(self, patch):
        return numpy.concatenate([self.border[patch], numpy.arange(*self._range(patch))])

    def _range(self, patch):
        return self.inside[patch].start, self.inside[patch].stop

    def ways_up(self, patch):
        """The patch and all around it, the root last."""
        while patch is not None:
            yield patch
            patch = self.parent[patch]

    # ---- Tables

    def _folded(self, tag, sizes):
        shapes = [(n // 2, n - 1) if n % 2 == 0 else ((n - 1) // 2, n) for n in sizes]
        matrices = iter(self.sections[tag].matrices([s if n > 1 else (0, 0) for s, n in zip(shapes, sizes)]))
        return [unfold(next(matrices) if n > 1 else None, n) for n in sizes]

    def _read_leaf_tables(self):
        shapes = [(len(self.border[leaf]), len(self.inside[leaf])) for leaf in self.leaves]
        matrices = iter(self.sections["BVIV"].matrices(shapes))
        tables = [numpy.zeros(shape, "f4") if 0 in shape else next(matrices) for shape in shapes]
        self.border_internal = dict(zip(self.leaves, tables))
        internal = self._folded("IVIV", [len(self.inside[leaf]) for leaf in self.leaves])
        self.internal = dict(zip(self.leaves, internal))

    def _read_border_tables(self):
        sizes = [len(border) for border in self.border[1:]]
        self.border_table = dict(enumerate(self._folded("BVBV", sizes), 1))

    def _read_overlays(self):
        fields = Fields(self.sections["QUAN"].bytes())
        self.quantum, self.shift = fields.take("<f4", self.patch_count), fields.take("u1", self.patch_count).tolist()
        fields = Fields(self.sections["SEGM"].bytes())
        size = self.border_begin[-1]
        ends, lengths = fields.take("<u4", size), fields.take("<f4", size)
        begin = self.border_begin
        self.segment_end = [ends[a:b] for a, b in zip(begin, begin[1:])]
        self.segment_length = [lengths[a:b] for a, b in zip(begin, begin[1:])]
        self.bridges, last = [[] for _ in self.border], (0, 0)
        while fields.remaining():
            slot, end, length = *fields.take("<u4", 2).tolist(), fields.take("<f4", 1)[0]
            patch = numpy.searchsorted(begin, slot, "right") - 1
            require(slot - begin[patch] < end < begin[patch + 1] - begin[patch], "a bridge leaves its border")
            require((slot, end) > last and 0 < length < numpy.inf, "bridges are out of order, or have no length")
            self.bridges[patch].append((slot - begin[patch], end, length))
            last = slot, end
        self.measured = self._read_pairs("PAIR", 3)
        self.steep = self._read_pairs("EDGE", 0)

    def _read_pairs(self, tag, error_count):
        """Per vertex number: the distances of others."""
        distances = {}
        if tag not in self.sections:
            return distances
        fields = Fields(self.sections[tag].bytes())
        count, errors = int(fields.take("<u8", 1)[0]), fields.take("<f4", error_count)
        require(((0 <= errors) & (errors < numpy.inf)).all(), "errors that cannot be")
        first = fields.planes(count).cumsum(dtype="u4")
        second, distance = first + fields.planes(count), fields.planes(count).view("<f4")
        require(fields.at == len(fields.content), "a section of pairs is longer than these")
        for a, b, d in zip(first.tolist(), second.tolist(), distance):
            require(a < b < self.vertex_count and 0 < d < numpy.inf, "no pair")
            distances.setdefault(a, {})[b] = d
            distances.setdefault(b, {})[a] = d
        return distances

    def _read_packed(self):
        """The tables of a packed index; of triangles, both halves."""
        insides, borders = [len(inside) for inside in self.inside], [len(border) for border in self.border]
        inner, triangle = range(self.inner_count), [n * (n - 1) // 2 for n in insides]
        tables = self._packed("OVOV", sum(insides[p] * borders[p] + triangle[p] for p in inner))
        self.overlay_table = []
        for patch in inner:
            to_border = self._next(tables, patch, self.inside[patch], self.border[patch])
            own = self._next_triangle(tables, patch)
            self.overlay_table.append(self._joined(patch, to_border, own))
        tables.require_end()
        tables = self._packed("BVIV", sum(insides[p] * borders[p] for p in self.leaves))
        self.border_internal = {p: self._next(tables, p, self.border[p], self.inside[p]) for p in self.leaves}
        tables.require_end()
        tables = self._packed("IVIV", sum(triangle[p] for p in self.leaves))
        self.internal = {p: self._next_triangle(tables, p) for p in self.leaves}
        tables.require_end()

    # ---- Mapped

    def _read_mapped(self):
        require(self.sections["HOPS"].codec == RAW, "HOPS is not raw")
        codes = Fields(self.sections["HOPS"].bytes())
        places = [self.places(patch) for patch in range(self.patch_count)]
        insides, rings = [len(inside) for inside in self.inside], [len(on) for on, _ in places]
        inners = range(self.inner_count)
        self.large = self._large_overlays(rings, insides)
        borders = self._part(codes, [(len(self.border[p]), rings[p]) for p in inners])
        shapes = [(insides[p],) if p in self.large else (len(self.overlay(p)), insides[p]) for p in inners]
        owned = self._part(codes, shapes)
        inner = self._part(codes, [(insides[p], rings[p]) for p in range(self.patch_count)])
        triangles = self._part(codes, [(1, n * (n - 1) // 2) for n in (insides[p] for p in self.leaves)])
        middles = self._middle_offsets(codes, [(insides[p], rings[p]) for p in range(self.patch_count)])
        require(codes.at == len(codes.content), "HOPS is longer than its tables")
        self.overlay_table = []
        for patch in inners:
            to_ring, to_owned = numpy.concatenate([borders[patch], inner[patch]]), owned[patch]
            if patch in self.large:
                to_owned = numpy.concatenate([inner[patch][:, places[patch][1]].T, to_owned])
            self.overlay_table.append(self._joined_rows(patch, places[patch], to_ring, to_owned))
        self.border_internal = {p: inner[p][:, places[p][1]].T for p in self.leaves}
        self.internal = {p: self._triangle(entries[0], insides[p]) for p, entries in zip(self.leaves, triangles)}
        for patch in range(self.patch_count):
            self._check_middles(patch, places[patch][0], inner[patch], middles[patch])

    def places(self, patch):
        """The position in the border of each place, and the own place of each position."""
        ends, places, own, first = self.segment_end[patch], [], [], 0
        while first < len(ends):
            last = first
            while ends[last] == last + 1:
                last += 1
            chain = list(range(first, last + 1))
            closed = ends[last] == first
            before, after = (chain[-2:], chain[:2]) if closed else (chain[:1] * 2, chain[-1:] * 2)
            own += range(len(places) + 2, len(places) + 2 + len(chain))
            places += before + chain + after
            first = last + 1
        for begin, end, _ in self.bridges[patch]:
            places += begin, end
        return numpy.array(places, int), numpy.array(own, int)

    def _large_overlays(self, rings, insides):
        """The inner patches whose tables among owned vertices have each distance once."""
        inners, borders = range(self.inner_count), [len(border) for border in self.border]
        once = [self._half_size(insides[p]) for p in inners]
        twice = [(borders[p] + insides[p]) * insides[p] for p in inners]
        others = sum(borders[p] * rings[p] for p in inners)
        others += sum(1.5 * inside * ring for inside, ring in zip(insides, rings))
        others += sum(insides[p] * (insides[p] - 1) // 2 for p in self.leaves)
        able = [p for p in inners if once[p] < twice[p]]
        large = set()
        for size in sorted({rings[p] + insides[p] for p in able}, reverse=True):
            codes = others + sum(once[p] if p in large else twice[p] for p in inners)
            if 2 * codes <= 560 * self.vertex_count:
                break
            large |= {p for p in able if rings[p] + insides[p] == size}
        return large

    @staticmethod
    def _half_size(rows):
        return sum(row // 8 * 8 + 8 for row in range(rows))

    def _part(self, codes, shapes):
        """Matrices of these rows and columns, and half tables of these rows, as whole ones."""
        count = sum(self._half_size(*shape) if len(shape) == 1 else shape[0] * shape[1] for shape in shapes)
        entries = codes.take("<u2", (count + 32 + 31) // 32 * 32)
        entries = Fields(numpy.where(entries == 32767, numpy.inf, entries).astype("f4").tobytes())
        return [
            self._half_table(entries, *shape)
            if len(shape) == 1
            else entries.take("<f4", shape[0] * shape[1]).reshape(shape)
            for shape in shapes
        ]

    @staticmethod
    def _middle_offsets(codes, shapes):
        count = sum(rows * columns for rows, columns in shapes)
        bytes_ = codes.take("u1", 2 * (((count + 1) // 2 + 32 + 31) // 32 * 32))
        require(not bytes_[count:].any(), "bytes behind the offsets of middles")
        ends = numpy.cumsum([rows * columns for rows, columns in shapes])
        return [bytes_[end - shape[0] * shape[1] : end].reshape(shape) for end, shape in zip(ends, shapes)]

    @staticmethod
    def _half_table(entries, size):
        table = numpy.zeros((size, size), "f4")
        for row in range(size):
            columns = entries.take("<f4", row // 8 * 8 + 8)
            require(numpy.isinf(columns[size:]).all(), "a half table has entries of no vertex")
            table[row, : len(columns)] = columns[:size]
        lower = numpy.tril(table)
        whole = lower + numpy.tril(table, -1).T
        beside = numpy.add.outer(numpy.arange(size) // 8, -(numpy.arange(size) // 8)) == 0
        numpy.testing.assert_array_equal(numpy.where(beside, table, 0), numpy.where(beside, whole, 0))
        return whole

    def _joined_rows(self, patch, places, to_ring, owned):
        """The overlay table of a patch, in which each distance is there twice, from its two parts."""
        on, own = places
        numpy.testing.assert_array_equal(to_ring, to_ring[:, own][:, on])
        table = numpy.concatenate([to_ring[:, own], owned], axis=1)
        numpy.testing.assert_array_equal(table, table.T)
        require((numpy.diagonal(table) == 0).all(), "a vertex is not at distance 0 from itself")
        border = len(self.border[patch])
        if patch:
            numpy.testing.assert_array_equal(table[:border, :border], self._converted(patch))
        return table

    def _check_middles(self, patch, on, inner, middles):
        codes = numpy.where(numpy.isinf(inner), NO_PATH, inner)
        derived = self._middles(patch, on, inner)
        derived = numpy.where(numpy.isinf(derived), NO_PATH, derived)
        lengths = self._lengths_from_places(patch, on)
        mean = means(codes, numpy.roll(codes, -1, axis=1))
        expected = offsets(derived, mean, strides(lengths, self.quantum[patch]))
        # Where the sum is rounded otherwise, the root may be, too.
        require(not (numpy.abs(middles.astype("f4") - expected) > 1).any(), "a middle is elsewhere")

    def _lengths_from_places(self, patch, on):
        """Of the segments from each place to the next one, NaN where there is none."""
        bridges = self.bridges[patch]
        chains = len(on) - 2 * len(bridges)
        lengths = numpy.full(len(on), numpy.nan, "f4")
        for place, (i, j) in enumerate(zip(on[:chains], on[1:chains])):
            if self.segment_end[patch][i] == j:
                lengths[place] = self.segment_length[patch][i]
        lengths[chains::2] = [length for _, _, length in bridges]
        return lengths

    def _middles(self, patch, on, inner):
        middles, lengths = numpy.full(inner.shape, numpy.inf), self._lengths_from_places(patch, on)
        for place, length in enumerate(lengths / self.quantum[patch]):
            if not numpy.isnan(length):
                square = 0.5 * (inner[:, place] ** 2 + inner[:, place + 1] ** 2) - 0.25 * length**2
                middles[:, place] = numpy.where(square >= 0, numpy.trunc(numpy.sqrt(square) + 0.5), numpy.inf)
        if patch < self.inner_count:
            return middles
        longest = numpy.max(lengths[~numpy.isnan(lengths)], initial=0)
        return raised_middles(middles, self.internal[patch], longest / self.quantum[patch], numpy.inf)

    @staticmethod
    def _triangle(entries, size):
        table = numpy.zeros((size, size), "f4")
        table[numpy.tril_indices(size, -1)] = entries
        return table + table.T

    # ---- Packed

    def _packed(self, tag, entries):
        raw = numpy.frombuffer(self.sections[tag].bytes(), "u1")
        return PackedTables(raw, entries, self.positions, self.position_step)

    def _next(self, tables, patch, rows, cols):
        rows, cols = numpy.array(rows, int), numpy.array(cols, int)
        return tables.table(rows, cols, self.quantum[patch], self.shift[patch])

    def _next_triangle(self, tables, patch):
        inside = numpy.array(self.inside[patch], int)
        table = tables.table(inside, inside, self.quantum[patch], self.shift[patch], is_triangle=True)
        return table + table.T

    def _read_overlay_tables(self):
        shapes = []
        for patch in range(self.inner_count):
            owned = len(self.inside[patch])
            shapes.append((owned, len(self.border[patch])))
            shapes.append(((owned // 2, owned - 1) if owned % 2 == 0 else ((owned - 1) // 2, owned)))
            if owned < 2:
                shapes[-1] = (0, 0)
        matrices = iter(self.sections["OVOV"].matrices(shapes))
        tables = [None if 0 in shape else next(matrices) for shape in shapes]
        self.overlay_table = []
        for patch in range(self.inner_count):
            to_border, folded = tables[2 * patch : 2 * patch + 2]
            self.overlay_table.append(self._joined(patch, to_border, unfold(folded, len(self.inside[patch]))))

    def _joined(self, patch, to_border, own):
        """The whole overlay table of a patch, whose parent's is known."""
        border, owned = len(self.border[patch]), len(self.inside[patch])
        table = numpy.zeros((border + owned, border + owned), "f4")
        table[border:, border:] = own
        if to_border is not None:
            table[border:, :border], table[:border, border:] = to_border, to_border.T
        if patch:
            table[:border, :border] = self._converted(patch)
        return table

    def _converted(self, patch):
        """The codes of two vertices on the border of a patch, from the table of its parent."""
        parent = self.parent[patch]
        position = {number: i for i, number in enumerate(self.overlay(parent))}
        at = [position[number] for number in self.border[patch]]
        codes = self.overlay_table[parent][numpy.ix_(at, at)].astype(float)
        ours, theirs = float(self.quantum[patch]), float(self.quantum[parent])
        if ours == 0:
            return codes
        with numpy.errstate(invalid="ignore"):
            steps = numpy.clip(numpy.floor(codes * theirs / ours + 0.5), 1, 32766)
        return numpy.where((codes == 0) | numpy.isinf(codes), codes, steps)
