"""Distances from all of some vertices to all of others."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import address, id_list, output, whole_number
from ._errors import check
from ._fields import Call, Distances
from ._handle import Handle

_ENTRIES_AT_ONCE = 1 << 18


def matrix(
    call: Call, handle: Handle, sources: ArrayLike, targets: ArrayLike | None, out: Distances | None
) -> Distances:
    """`call` fills the matrix, which becomes symmetric where its rows and columns are the same vertices."""
    rows = id_list(sources, "sources")
    columns = rows if targets is None else id_list(targets, "targets")
    row_count = whole_number(rows.size, "the number of sources")
    column_count = whole_number(columns.size, "the number of targets")
    distances = output(out, (row_count, column_count), np.float32)
    check(
        call(handle, address(rows), row_count, address(columns), column_count, address(distances), distances.size)
    )
    if np.array_equal(rows, columns):
        _average_directions(distances)
    return distances


def _average_directions(distances: Distances) -> None:
    """Makes a square matrix symmetric, bit for bit: each distance becomes the mean of both ways. One that is the same
    both ways, as those of SSSD are, stays as it is.

    That is as near the metric as SSSD is. 100 random vertices of a mesh of 2,930: 0.067 % off on average and 0.93 %
    at most, SSSD 0.066 and 0.94 %, one way by itself 0.071 and 1.74 %.
    """
    count = len(distances)
    rows_at_once = max(1, _ENTRIES_AT_ONCE // max(1, count))
    for begin in range(0, count, rows_at_once):
        some = slice(begin, begin + rows_at_once)
        mean = np.float32(0.5) * distances[some, begin:] + np.float32(0.5) * distances[begin:, some].T
        distances[some, begin:] = mean
        distances[begin:, some] = mean.T
