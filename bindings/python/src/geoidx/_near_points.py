"""What is near to points of the surface."""

from __future__ import annotations

from ctypes import byref, c_uint32
from typing import SupportsIndex

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Floats, Ids, address, as_array, floats, output, real_number, whole_number
from ._errors import check
from ._fields import Distances
from ._handle import Closable, OneThread
from ._native import library
from ._surface import Surface, SurfacePoints, handle_of, one_point, point_list

_LIKELY_COUNT = 1024
"""For so many vertices `point_within` has room at first. Where there are more, it asks again."""


def offset_list(offsets: ArrayLike | None, count: int) -> Floats | None:
    """Distances that `count` sources begin with, or None."""
    if offsets is None:
        return None
    return floats(np.atleast_1d(as_array(offsets, "offsets")), "offsets", count)


class NearPoints(Closable):
    """The part of a query that answers what is near to points of the surface."""

    _vertex_count: int
    _one_thread: OneThread

    def point_nearest(
        self,
        surface: Surface,
        sources: SurfacePoints,
        *,
        offsets: ArrayLike | None = None,
        out: Distances | None = None,
    ) -> Ids:
        """(n,) which of (k,) points of the surface is the nearest to each vertex, with its offset: its position.

        NO_SOURCE where none is reached. Of several at one vertex it is the first.

        offsets: (k,), not negative: distances that sources begin with; 0, unless given.
        out: takes the distances, as `point_msad` gives them.
        """
        points = point_list(sources, "sources")
        begin = offset_list(offsets, points.size)
        distances = None if out is None else output(out, (self._vertex_count,), np.float32)
        positions = np.empty(self._vertex_count, np.uint32)
        with self._one_thread:
            check(
                library.geoidx_query_point_nearest_sources(
                    self._handle,
                    handle_of(surface),
                    address(points),
                    whole_number(points.size, "the number of sources"),
                    None if begin is None else address(begin),
                    address(positions),
                    None if distances is None else address(distances),
                    self._vertex_count,
                )
            )
        return positions

    def point_within(
        self, surface: Surface, sources: SurfacePoints, radius: float, *, offsets: ArrayLike | None = None
    ) -> tuple[Ids, Distances]:
        """The vertices no farther than that from the nearest of (k,) points, the nearest first, and their distances.

        offsets: (k,), not negative: distances that sources begin with; 0, unless given.
        """
        points = point_list(sources, "sources")
        begin = offset_list(offsets, points.size)
        largest = real_number(radius, "radius")
        capacity = min(_LIKELY_COUNT, self._vertex_count)
        with self._one_thread:
            vertices, distances, count = self._first_point_within(surface, points, begin, largest, capacity)
            if count > capacity:
                vertices, distances, count = self._first_point_within(surface, points, begin, largest, count)
        return vertices[:count], distances[:count]

    def _first_point_within(
        self,
        surface: Surface,
        points: SurfacePoints,
        begin: Floats | None,
        radius: float,
        capacity: int,
    ) -> tuple[Ids, Distances, int]:
        """Arrays of `capacity`, filled with the nearest vertices, and how many there are within the radius."""
        vertices, distances = np.empty(capacity, np.uint32), np.empty(capacity, np.float32)
        count = c_uint32()
        check(
            library.geoidx_query_point_within(
                self._handle,
                handle_of(surface),
                address(points),
                whole_number(points.size, "the number of sources"),
                None if begin is None else address(begin),
                radius,
                address(vertices),
                address(distances),
                capacity,
                byref(count),
            )
        )
        return vertices, distances, count.value

    def point_nearest_targets(
        self, surface: Surface, source: SurfacePoints, targets: SurfacePoints, count: SupportsIndex
    ) -> tuple[Ids, Distances]:
        """Positions of the nearest `count` of (k,) points of the surface, the nearest first, and their distances."""
        begin, points = one_point(source, "source"), point_list(targets, "targets")
        target_count = whole_number(points.size, "the number of targets")
        capacity = min(whole_number(count, "count"), target_count)
        positions, distances = np.empty(capacity, np.uint32), np.empty(capacity, np.float32)
        found = c_uint32()
        with self._one_thread:
            check(
                library.geoidx_query_point_nearest_targets(
                    self._handle,
                    handle_of(surface),
                    address(begin),
                    address(points),
                    target_count,
                    address(positions),
                    address(distances),
                    capacity,
                    byref(found),
                )
            )
        return positions[: found.value], distances[: found.value]
