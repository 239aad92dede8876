"""What a distance is."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any, ClassVar, Union

from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import address, doubles, flag, id_rows, whole_number
from ._callbacks import MetricFunction
from ._errors import InvalidArgumentError

Arrays = list[NDArray[Any]]


class MetricKind(IntEnum):
    """Which metric an index was built with."""

    EXACT = 0
    EDGES = 1
    CALLBACK = 2
    WEIGHTED = 3


@dataclass(frozen=True, eq=False)
class Metric:
    """What a distance is, with its parameters: Exact, Edges, Weighted or Callback."""

    kind: ClassVar[MetricKind]

    def fill(self, options: _native.BuildOptions) -> Arrays:
        """Sets the options of the metric and returns the arrays that they point into."""
        options.metric = self.kind
        return []


def _fill_edge_lengths(options: _native.BuildOptions, edge_lengths: ArrayLike | None) -> Arrays:
    if edge_lengths is None:
        return []
    lengths = doubles(edge_lengths, "edge_lengths", None, 3)
    options.edge_lengths = address(lengths)
    options.edge_length_count = lengths.size
    return [lengths]


@dataclass(frozen=True, eq=False)
class Exact(Metric):
    """Exact polyhedral geodesic distance.

    edge_lengths: (m, 3), float64 without a copy; the surface by lengths instead of positions, [t, k] that of the
        edge opposite to corner k of triangle t, the same in all triangles at the edge. A triangle without an area
        is a BadMeshError.
    """

    edge_lengths: ArrayLike | None = None
    kind = MetricKind.EXACT

    def fill(self, options: _native.BuildOptions) -> Arrays:
        return super().fill(options) + _fill_edge_lengths(options, self.edge_lengths)


@dataclass(frozen=True, eq=False)
class Edges(Metric):
    """Shortest path along edges.

    vertices: (k, 2) vertex ids of the edges whose cost is not their length.
    costs: (k,), finite and not negative; an edge given twice takes the smaller.
    """

    vertices: ArrayLike | None = None
    costs: ArrayLike | None = None
    kind = MetricKind.EDGES

    def fill(self, options: _native.BuildOptions) -> Arrays:
        super().fill(options)
        if self.vertices is None and self.costs is None:
            return []
        if self.vertices is None or self.costs is None:
            raise InvalidArgumentError("edge costs need both vertices and costs")
        vertices = id_rows(self.vertices, "vertices of edge costs", 2, InvalidArgumentError)
        costs = doubles(self.costs, "costs", len(vertices))
        options.edge_cost_count = whole_number(len(vertices), "the number of edge costs")
        options.edge_cost_vertices = address(vertices)
        options.edge_costs = address(costs)
        return [vertices, costs]


@dataclass(frozen=True, eq=False)
class Weighted(Metric):
    """A path's length in each triangle times the triangle's cost, approximated from above.

    face_costs: (m,), positive and finite, what a unit of length costs in each triangle.
    points_per_edge: 0 .. 1000 points on every edge, through which paths go straight; more are more exact.
    edge_lengths: as of Exact.
    """

    face_costs: ArrayLike
    points_per_edge: int = 12
    edge_lengths: ArrayLike | None = None
    kind = MetricKind.WEIGHTED

    def fill(self, options: _native.BuildOptions) -> Arrays:
        super().fill(options)
        costs = doubles(self.face_costs, "face_costs", None)
        options.face_costs = address(costs)
        options.face_cost_count = costs.size
        options.points_per_edge = whole_number(self.points_per_edge, "points_per_edge")
        return [costs] + _fill_edge_lengths(options, self.edge_lengths)


@dataclass(frozen=True, eq=False)
class Callback(Metric):
    """The caller's own metric.

    function: called with a source and a (k,) array of targets (vertex ids), returns (k,) distances: symmetric, not
        negative, obeying the triangle inequality, infinite where there is no path. Called from several threads
        (one at a time, as Python runs) unless `threads` is 1. What it raises stops the build and is raised there.
    unfoldable: small pieces of the surface can be laid out in the plane with their distances kept.
    """

    function: MetricFunction
    unfoldable: bool = False
    kind = MetricKind.CALLBACK

    def fill(self, options: _native.BuildOptions) -> Arrays:
        options.metric_flags = _native.METRIC_UNFOLDABLE if flag(self.unfoldable, "unfoldable") else 0
        return super().fill(options)


MetricLike = Union[Metric, MetricFunction, str]
"""A metric, a function of `Callback`, "exact" or "edges"."""

_BY_NAME: dict[str, Metric] = {"exact": Exact(), "edges": Edges()}


def as_metric(metric: MetricLike) -> Metric:
    if isinstance(metric, Metric):
        return metric
    if isinstance(metric, type) and issubclass(metric, Metric):
        raise TypeError(f"the metric is the class {metric.__name__}, not one of its instances: {metric.__name__}(...)")
    if callable(metric):
        return Callback(metric)
    if metric not in _BY_NAME:
        raise InvalidArgumentError(f"the metric {metric!r} is none of {sorted(_BY_NAME)}")
    return _BY_NAME[metric]
