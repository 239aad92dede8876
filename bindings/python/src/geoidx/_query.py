"""One thread's queries."""

from __future__ import annotations

import math
from ctypes import byref, c_double, c_float, c_uint32, c_uint64, c_void_p
from typing import Any, NoReturn, SupportsIndex, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _fields
from ._arrays import (
    Ids,
    Vertex,
    Vertices,
    address,
    id_list,
    ids,
    output,
    real_number,
    vertex,
    whole_number,
)
from ._errors import Status, check
from ._fields import Distances
from ._handle import Handle, OneThread
from ._matrix import matrix
from ._native import PathPoint, library
from ._near_points import NearPoints, offset_list
from ._surface import Path, Step, Surface, SurfacePoints, handle_of, one_point, point_list

PATH_QUALITIES = ("straight", "exact")

_LIKELY_COUNT = 1024
"""For so many vertices `within` has room at first. Where there are more, it asks again."""


class Query(NearPoints):
    """One thread's scratch for queries on one index: they do not lock and, after the first ones, do not allocate.

    Paths allocate, and so do distances of near points, which are lengths of paths. Made by `Index.query`. A call while
    another thread's is under way is a RuntimeError. Keeps what it needs of the index, which may be closed before it.
    """

    def __init__(self, index: Handle, vertex_count: int) -> None:
        if not isinstance(index, Handle):
            raise TypeError("a query is made by Index.query")
        out = c_void_p()
        status = library.geoidx_query_create(index, byref(out))
        super().__init__(Handle(out, library.geoidx_query_close, needed=index))
        check(status)
        self._vertex_count = vertex_count
        self._threads = 1
        self._one_thread = OneThread("query")

    def __reduce__(self) -> NoReturn:
        raise TypeError("a query cannot be copied or pickled: each thread makes its own")

    @property
    def threads(self) -> int:
        """How many threads `msad`, `nearest`, `point_msad`, `point_nearest` and `farthest_points` use, 1 .. 1024.

        0: one per processor. 1 at first. By the graph engine one.
        """
        self._handle
        return self._threads

    @threads.setter
    def threads(self, count: SupportsIndex) -> None:
        number = whole_number(count, "threads")
        with self._one_thread:
            check(library.geoidx_query_set_threads(self._handle, number))
        self._threads = number

    def sssd(self, source: SupportsIndex, target: SupportsIndex) -> float:
        """The distance between two vertices; `Index.sssd` takes arrays of them."""
        with self._one_thread:
            return _fields.sssd(library.geoidx_query_sssd, self._handle, source, target)

    def matrix(
        self, sources: ArrayLike, targets: ArrayLike | None = None, *, out: Distances | None = None
    ) -> Distances:
        """As `Index.matrix`."""
        with self._one_thread:
            return matrix(library.geoidx_query_matrix, self._handle, sources, targets, out)

    def msad(self, sources: ArrayLike, *, radius: float = math.inf, out: Distances | None = None) -> Distances:
        """As `Index.msad`."""
        with self._one_thread:
            if radius == math.inf:
                call = library.geoidx_query_msad
                return _fields.msad(call, self._handle, sources, self._vertex_count, out)
            call = library.geoidx_query_msad_within
            return _fields.msad(call, self._handle, sources, self._vertex_count, out, real_number(radius, "radius"))

    def ssad(self, sources: ArrayLike, *, out: Distances | None = None) -> Distances:
        """As `Index.ssad`."""
        with self._one_thread:
            call = library.geoidx_query_ssad_batch
            return _fields.ssad(call, self._handle, sources, self._vertex_count, out)

    def nearest(self, sources: ArrayLike, *, out: Distances | None = None) -> Ids:
        """As `Index.nearest`."""
        source_ids = id_list(sources, "sources")
        source_count = whole_number(source_ids.size, "the number of sources")
        distances = None if out is None else output(out, (self._vertex_count,), np.float32)
        positions = np.empty(self._vertex_count, np.uint32)
        with self._one_thread:
            check(
                library.geoidx_query_nearest_sources(
                    self._handle,
                    address(source_ids),
                    source_count,
                    address(positions),
                    None if distances is None else address(distances),
                    self._vertex_count,
                )
            )
        return positions

    def within(self, sources: ArrayLike, radius: float) -> tuple[Ids, Distances]:
        """As `Index.within`."""
        source_ids = id_list(sources, "sources")
        largest = real_number(radius, "radius")
        with self._one_thread:
            capacity = min(_LIKELY_COUNT, self._vertex_count)
            vertices, distances, count = self._first_within(source_ids, largest, capacity)
            if count > capacity:
                vertices, distances, count = self._first_within(source_ids, largest, count)
        return vertices[:count], distances[:count]

    def _first_within(self, sources: Ids, radius: float, capacity: int) -> tuple[Ids, Distances, int]:
        """Arrays of `capacity`, filled with the nearest vertices, and how many there are within the radius."""
        vertices, distances = np.empty(capacity, np.uint32), np.empty(capacity, np.float32)
        count = c_uint32()
        check(
            library.geoidx_query_within(
                self._handle,
                address(sources),
                whole_number(sources.size, "the number of sources"),
                radius,
                address(vertices),
                address(distances),
                capacity,
                byref(count),
            )
        )
        return vertices, distances, count.value

    def nearest_targets(
        self, source: SupportsIndex, targets: ArrayLike, count: SupportsIndex
    ) -> tuple[Ids, Distances]:
        """As `Index.nearest_targets`."""
        target_ids = id_list(targets, "targets")
        target_count = whole_number(target_ids.size, "the number of targets")
        capacity = min(whole_number(count, "count"), target_count)
        positions, distances = np.empty(capacity, np.uint32), np.empty(capacity, np.float32)
        found = c_uint32()
        with self._one_thread:
            check(
                library.geoidx_query_nearest_targets(
                    self._handle,
                    vertex(source),
                    address(target_ids),
                    target_count,
                    address(positions),
                    address(distances),
                    capacity,
                    byref(found),
                )
            )
        return positions[: found.value], distances[: found.value]

    def farthest_points(self, count: SupportsIndex, *, sources: ArrayLike = 0) -> Ids:
        """As `Index.farthest_points`."""
        wanted = min(whole_number(count, "count"), self._vertex_count)
        first = id_list(sources, "sources")
        points = np.empty(wanted, np.uint32)
        found = c_uint32()
        with self._one_thread:
            check(
                library.geoidx_query_farthest_points(
                    self._handle, address(first), first.size, wanted, address(points), None, byref(found)
                )
            )
        return points[: found.value]

    def prepare(self, source: SupportsIndex) -> None:
        """Keeps what depends on the source, for `prepared`, until the next call."""
        with self._one_thread:
            check(library.geoidx_query_prepare(self._handle, vertex(source)))

    @overload
    def prepared(self, targets: Vertex) -> float: ...
    @overload
    def prepared(self, targets: Vertices, *, out: Distances | None = None) -> Distances: ...
    @overload
    def prepared(self, targets: ArrayLike, *, out: Distances) -> Distances: ...
    @overload
    def prepared(self, targets: ArrayLike, *, out: Distances | None = None) -> Distances | float: ...

    def prepared(self, targets: ArrayLike, *, out: Distances | None = None) -> Distances | float:
        """From the prepared source to each target, in the shape of targets: a float for one vertex.

        By the overlay engine they differ a little (about 0.01 % on average) from those of `msad` and `sssd`.
        InvalidArgumentError without a prepared source.
        """
        target_ids = ids(targets, "targets")
        distances = output(out, target_ids.shape, np.float32)
        with self._one_thread:
            check(
                library.geoidx_query_prepared(
                    self._handle, address(target_ids), target_ids.size, address(distances)
                )
            )
        return distances if target_ids.ndim or out is not None else float(distances)

    def point_sssd(self, surface: Surface, source: SurfacePoints, target: SurfacePoints) -> float:
        """The distance between two points of the surface."""
        ends = one_point(source, "source"), one_point(target, "target")
        distance = c_float()
        with self._one_thread:
            check(
                library.geoidx_query_point_sssd(
                    self._handle, handle_of(surface), address(ends[0]), address(ends[1]), byref(distance)
                )
            )
        return distance.value

    def point_msad(
        self,
        surface: Surface,
        sources: SurfacePoints,
        *,
        offsets: ArrayLike | None = None,
        out: Distances | None = None,
    ) -> Distances:
        """(n,) distances of every vertex: the least of offset + distance of each of (k,) points of the surface.

        offsets: (k,), not negative: distances that sources begin with; 0, unless given.
        """
        points = point_list(sources, "sources")
        begin = offset_list(offsets, points.size)
        distances = output(out, (self._vertex_count,), np.float32)
        with self._one_thread:
            check(
                library.geoidx_query_point_msad(
                    self._handle,
                    handle_of(surface),
                    address(points),
                    whole_number(points.size, "the number of sources"),
                    None if begin is None else address(begin),
                    address(distances),
                    self._vertex_count,
                )
            )
        return distances

    def path(
        self, surface: Surface, source: SurfacePoints, target: SurfacePoints, *, quality: str = "straight"
    ) -> Path | None:
        """The path between two points of the surface; None if they lie in different components.

        quality: "straight", locally shortest, or "exact".
        """
        if quality not in PATH_QUALITIES:
            raise ValueError(f"quality is {quality!r}, not one of {', '.join(PATH_QUALITIES)}")
        ends = one_point(source, "source"), one_point(target, "target")
        length, count = c_double(), c_uint64()
        with self._one_thread:
            status = library.geoidx_query_path(
                self._handle,
                handle_of(surface),
                address(ends[0]),
                address(ends[1]),
                PATH_QUALITIES.index(quality),
                byref(length),
            )
            if status == Status.NO_PATH:
                return None
            check(status)
            check(library.geoidx_query_path_points(self._handle, None, 0, byref(count)))
            points: NDArray[Any] = np.zeros(count.value, np.dtype(PathPoint))
            check(library.geoidx_query_path_points(self._handle, address(points), count, byref(count)))
        return Path(length.value, points["point"].copy(), points["position"].copy())

    def prepare_target(self, surface: Surface, target: SurfacePoints) -> None:
        """Keeps the target of `next_step` until the next call."""
        point = one_point(target, "target")
        with self._one_thread:
            check(library.geoidx_query_prepare_target(self._handle, handle_of(surface), address(point)))

    def next_step(self, surface: Surface, point: SurfacePoints) -> Step | None:
        """The next step to the prepared target from any point; None if they lie in different components.

        Steps that begin where the one before ended, at its `points[1:]`, lead to the target as a straight `path` does;
        there the distance is 0. By the metric Edges they lead from corner to corner.

        The first step takes as long as a path, whose triangles are kept. From any point of these a step takes a few
        microseconds in the library; from a point beside them a new path is found.

        surface: as for the target.
        InvalidArgumentError without a prepared target.
        """
        begin = one_point(point, "point")
        ends: NDArray[Any] = np.zeros(2, np.dtype(PathPoint))
        distance = c_double()
        with self._one_thread:
            status = library.geoidx_query_next_step(
                self._handle, handle_of(surface), address(begin), address(ends), byref(distance)
            )
        if status == Status.NO_PATH:
            return None
        check(status)
        return Step(ends["point"].copy(), ends["position"].copy(), distance.value)
