"""Distances without an index."""

from __future__ import annotations

from ctypes import byref, c_void_p
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import Doubles, address, id_list, ids, output, real_number, whole_number
from ._errors import check
from ._handle import Closable, Handle, OneThread
from ._mesh import MeshView
from ._metrics import MetricLike
from ._native import library
from ._options import BuildOptions
from ._surface import SurfacePoints, point_list

class Solver(Closable):
    """A mesh and a metric, ready to compute distances under the metric itself, in float64.

    vertices, faces, metric, weld_tolerance: as of `Index.build`. One thread's scratch: a call while another is under
    way is a RuntimeError.

    tolerance: of the metric "exact", by about which share of themselves distances may be off, 0 to 1e-4, so that they
        take less time: at 1e-5 fields of scans take 0.6 to 0.9 of it, those of long triangles a half to a tenth. 0:
        exact.
    """

    def __init__(
        self,
        vertices: ArrayLike,
        faces: ArrayLike,
        *,
        metric: MetricLike = "exact",
        weld_tolerance: float = 0.0,
        tolerance: float = 0.0,
    ) -> None:
        mesh = MeshView(vertices, faces)
        options = BuildOptions(metric, weld_tolerance)
        options.struct.solver_tolerance = real_number(tolerance, "tolerance")
        out = c_void_p()
        self._callbacks = options.callbacks
        self._one_thread = OneThread("solver")
        with self._callbacks.calling():
            status = library.geoidx_solver_create(byref(mesh.struct), byref(options.struct), byref(out))
            super().__init__(Handle(out, library.geoidx_solver_close, kept=options))
        check(status)
        self._vertex_count = len(mesh.vertices)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a solver cannot be copied or pickled: each thread makes its own")

    @property
    def vertex_count(self) -> int:
        """n, the number of vertices in the array given."""
        self._handle
        return self._vertex_count

    def distances(
        self, sources: ArrayLike, targets: ArrayLike | None = None, *, out: Doubles | None = None
    ) -> Doubles:
        """From the nearest of the sources to each target, in the shape of targets; without targets (n,), to all.

        sources: a vertex or (k,) of them, at least one.
        out: float64 of the shape of targets, C-contiguous, to be written to and returned.
        """
        source_ids = id_list(sources, "sources")
        target_ids = None if targets is None else ids(targets, "targets")
        shape = (self.vertex_count,) if target_ids is None else target_ids.shape
        distances = output(out, shape, np.float64)
        target_address = None if target_ids is None else address(target_ids)
        self._solve(library.geoidx_solver_distances, source_ids, target_address, distances)
        return distances

    def point_distances(
        self, sources: SurfacePoints, targets: SurfacePoints, *, out: Doubles | None = None
    ) -> Doubles:
        """(k,): from the nearest of the sources to each of k targets, all of them `surface_points`.

        For the metrics Exact and Weighted; InvalidArgumentError for others, and for points of degenerate triangles.
        """
        source_points = point_list(sources, "sources")
        target_points = point_list(targets, "targets")
        distances = output(out, target_points.shape, np.float64)
        call = library.geoidx_solver_point_distances
        self._solve(call, source_points, address(target_points), distances)
        return distances

    def _solve(self, call: Any, sources: NDArray[Any], targets: int | None, distances: Doubles) -> None:
        source_count = whole_number(sources.size, "the number of sources")
        target_count = whole_number(distances.size, "the number of targets")
        with self._one_thread, self._callbacks.calling():
            status = call(
                self._handle, address(sources), source_count, targets, target_count, address(distances)
            )
        check(status)
