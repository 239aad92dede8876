"""Distances between all pairs of two lists of vertices, in the way that takes the least time."""

from __future__ import annotations

from typing import Callable

import numpy as np

from ._arrays import Ids
from ._errors import InvalidArgumentError
from ._fields import Distances
from ._options import Engine

Pairs = Callable[[Ids, Distances], None]
"""Fills C-contiguous distances of as many pairs of vertices by SSSD."""

Fields = Callable[[Ids], Distances]
"""The distances from each of some sources to every vertex, by MSAD of the source alone."""

_PAIRS_AT_ONCE = 1 << 18
_SQUARE_PARTS = 8
_FIELDS_AT_ONCE = 16
"""As many as the library takes through its tables together: scratch is 64 bytes a vertex, as it is there."""


def _pairs_worth_a_field(engine: int, vertex_count: int) -> float:
    """How many pairs take as long as the distances from one vertex to all.

    Thread time of batches of random pairs over that of 16 to 300 sources together (release build, x86-64, the fastest
    of 2 to 7 runs on a machine with other work):

        overlay     507 vertices  10      graph     507 vertices  2.4
                  2,930           16              1,148           2.1
                 35,947           75              2,930           1.9
                 49,971           85              3,644           0.3

    A source alone takes up to two or three times as long. The overlay's figure is set between the two. The graph's
    pairs get slower as its fields do, so that a constant serves.

    Prepared queries are never chosen. They are clearly ahead for fewer than 16 rows only (1 x 256 on 35,947 vertices:
    0.3 ms, where a field takes 0.8 ms and pairs take 1.2 ms), and would be a third kind of answer.
    """
    return 2.0 if engine == Engine.GRAPH else 12 + vertex_count / 400


def _check_vertices(vertices: Ids, vertex_count: int) -> None:
    if vertices.size and int(vertices.max()) >= vertex_count:
        raise InvalidArgumentError(
            f"vertex {int(vertices.max())} is out of range: the mesh has {vertex_count} vertices"
        )


class Matrix:
    """Fills matrices of one index. `pairs` and `fields` are its queries."""

    def __init__(self, engine: int, vertex_count: int, pairs: Pairs, fields: Fields) -> None:
        self._vertex_count = vertex_count
        self._pairs_worth_a_field = _pairs_worth_a_field(engine, vertex_count)
        self._pairs = pairs
        self._fields = fields

    def fill(self, rows: Ids, columns: Ids, distances: Distances) -> None:
        """Writes the distances from rows to columns, or nothing when a vertex is out of range."""
        for vertices in (rows, columns):
            _check_vertices(vertices, self._vertex_count)
        if np.array_equal(rows, columns):
            self._fill_square(rows, distances)
        elif rows.size <= columns.size:
            self._fill_wide(rows, columns, distances)
        else:
            self._fill_tall(rows, columns, distances)

    def _fields_are_faster(self, pair_count: int, field_count: int) -> bool:
        return field_count * self._pairs_worth_a_field < pair_count

    def _fill_square(self, vertices: Ids, distances: Distances) -> None:
        count = vertices.size
        if self._fields_are_faster(count * (count + 1) // 2, count):
            self._fill_by_fields(vertices, vertices, distances)
            _average_directions(distances)
        else:
            self._fill_upper_pairs(vertices, distances)

    def _fill_wide(self, rows: Ids, columns: Ids, distances: Distances) -> None:
        if self._fields_are_faster(distances.size, rows.size):
            self._fill_by_fields(rows, columns, distances)
        else:
            self._fill_by_pairs(rows, columns, distances)

    def _fill_tall(self, rows: Ids, columns: Ids, distances: Distances) -> None:
        if self._fields_are_faster(distances.size, columns.size):
            self._fill_by_fields(columns, rows, distances.T)
        else:
            self._fill_by_pairs(rows, columns, distances)

    def _fill_by_fields(self, sources: Ids, targets: Ids, distances: Distances) -> None:
        for begin in range(0, sources.size, _FIELDS_AT_ONCE):
            some = slice(begin, begin + _FIELDS_AT_ONCE)
            distances[some] = self._fields(sources[some])[:, targets]

    def _fill_by_pairs(self, rows: Ids, columns: Ids, distances: Distances) -> None:
        rows_at_once = max(1, _PAIRS_AT_ONCE // max(1, columns.size))
        for begin in range(0, rows.size, rows_at_once):
            some = slice(begin, begin + rows_at_once)
            self._fill_pairs(rows[some], columns, distances[some])

    def _fill_upper_pairs(self, vertices: Ids, distances: Distances) -> None:
        """SSSD is symmetric: a strip of rows is measured from the diagonal on, and mirrored."""
        count = vertices.size
        rows_at_once = max(1, min(_PAIRS_AT_ONCE // max(1, count), -(-count // _SQUARE_PARTS)))
        for begin in range(0, count, rows_at_once):
            some = slice(begin, begin + rows_at_once)
            strip = np.empty((vertices[some].size, count - begin), np.float32)
            self._fill_pairs(vertices[some], vertices[begin:], strip)
            distances[some, begin:] = strip
            distances[begin:, some] = strip.T

    def _fill_pairs(self, rows: Ids, columns: Ids, distances: Distances) -> None:
        pairs = np.empty(distances.shape + (2,), np.uint32)
        pairs[..., 0] = rows[:, None]
        pairs[..., 1] = columns
        self._pairs(pairs, distances)


def _average_directions(distances: Distances) -> None:
    """Makes a square matrix symmetric, bit for bit: each distance becomes the mean of both ways.

    That is as near the metric as SSSD is. 100 random vertices of a mesh of 2,930: 0.067 % off on average and 0.93 %
    at most, SSSD 0.066 and 0.94 %, one way by itself 0.071 and 1.74 %.
    """
    count = len(distances)
    rows_at_once = max(1, _PAIRS_AT_ONCE // max(1, count))
    for begin in range(0, count, rows_at_once):
        some = slice(begin, begin + rows_at_once)
        mean = np.float32(0.5) * distances[some, begin:] + np.float32(0.5) * distances[begin:, some].T
        distances[some, begin:] = mean
        distances[begin:, some] = mean.T
