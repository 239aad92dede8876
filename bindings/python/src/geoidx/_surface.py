"""Points of the surface, and the mesh that they lie on."""

from __future__ import annotations

from ctypes import byref, c_double, c_void_p, sizeof
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Doubles, Vertex, address, as_array, broadcast, doubles, id_list
from ._arrays import vertex as as_vertex
from ._errors import InvalidArgumentError, check
from ._handle import Closable, Handle
from ._mesh import MeshView
from ._metrics import MetricLike
from ._native import library
from ._options import BuildOptions

SURFACE_POINT = np.dtype(_native.SurfacePoint)
"""A point of the surface: `triangle`, and the `weights` of its three corners."""

SurfacePoints = NDArray[np.void]

COSTS = ("edge_cost_vertices", "edge_costs", "edge_cost_count", "face_costs", "face_cost_count", "points_per_edge")
"""Options of a build that a surface has, too."""


def surface_points(triangles: ArrayLike, weights: ArrayLike) -> SurfacePoints:
    """(k,) points of the surface, of the dtype SURFACE_POINT.

    triangles: (k,) or one position in the array of faces.
    weights: (k, 3) or (3,), of the triangle's corners: not negative, 1 in sum.
    """
    given = as_array(weights, "weights")
    rows = given.reshape(0, 3) if given.shape == (0,) else np.atleast_2d(given)
    corners = doubles(rows, "weights", None, 3)
    of_each = broadcast(id_list(triangles, "triangles", "a triangle"), corners[:, 0])[0]
    points: NDArray[Any] = np.zeros(len(of_each), SURFACE_POINT)
    points["triangle"] = of_each
    points["weights"] = corners
    return points


def point_list(values: SurfacePoints, name: str) -> NDArray[Any]:
    points: NDArray[Any] = np.atleast_1d(as_array(values, name))
    if points.dtype != SURFACE_POINT:
        raise TypeError(f"{name} cannot be of {points.dtype}: see surface_points")
    if points.ndim != 1:
        raise InvalidArgumentError(f"{name} has the shape {points.shape}, not (n)")
    return np.require(points, requirements=["C", "ALIGNED"])


def one_point(value: SurfacePoints, name: str) -> NDArray[Any]:
    points = point_list(value, name)
    if points.size != 1:
        raise InvalidArgumentError(f"{name} is {points.size} points, not one")
    return points


@dataclass(frozen=True)
class Path:
    """A path over the surface: its length, and its points from the source to the target."""

    length: float
    points: SurfacePoints
    """(k,) `surface_points`; each piece lies on the triangle of its first point."""
    positions: Doubles
    """(k, 3), in space."""


@dataclass(frozen=True)
class Step:
    """The next step of a walk to a target: a straight piece on one triangle, whose ends are equal at the target."""

    points: SurfacePoints
    """(2,) `surface_points` on the same triangle: where the step begins, and where it leaves the triangle or ends."""
    positions: Doubles
    """(2, 3), in space: the direction leads from one to the other."""
    distance: float
    """How long the way to the target is from where the step begins; 0 at the target."""


def _options_for(of_index: BuildOptions) -> _native.SurfaceOptions:
    """What a surface takes of the options of an index, whose arrays must live as long as these are used."""
    options = _native.SurfaceOptions()
    library.geoidx_surface_options_init_sized(byref(options), sizeof(options))
    options.weld_tolerance = of_index.struct.weld_tolerance
    for name in COSTS:
        setattr(options, name, getattr(of_index.struct, name))
    return options


class Surface(Closable):
    """A mesh with its adjacency, for points of the surface: immutable, shared by threads.

    vertices, faces, weld_tolerance: as of `Index.build`.
    metric: that of the index, whose costs paths by `Edges` with costs and by `Weighted` need; others need none.
    """

    def __init__(
        self, vertices: ArrayLike, faces: ArrayLike, *, weld_tolerance: float = 0.0, metric: MetricLike = "exact"
    ) -> None:
        mesh = MeshView(vertices, faces)
        of_index = BuildOptions(metric, weld_tolerance)
        options = _options_for(of_index)
        out = c_void_p()
        status = library.geoidx_surface_create(byref(mesh.struct), byref(options), byref(out))
        super().__init__(Handle(out, library.geoidx_surface_close))
        check(status)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a surface cannot be copied or pickled")

    @property
    def handle(self) -> Handle:
        """For the library's functions."""
        return self._handle

    def vertex_point(self, vertex: Vertex) -> SurfacePoints:
        """A vertex as (1,) `surface_points`: a corner of one of its triangles."""
        point: NDArray[Any] = np.zeros(1, SURFACE_POINT)
        check(library.geoidx_vertex_point(self._handle, as_vertex(vertex), address(point)))
        return point

    def closest_point(self, position: ArrayLike) -> tuple[SurfacePoints, float]:
        """The point of the surface that is nearest to (x, y, z), as (1,) `surface_points`, and how far it is."""
        place = doubles(np.atleast_2d(as_array(position, "position")), "position", 1, 3)
        point: NDArray[Any] = np.zeros(1, SURFACE_POINT)
        distance = c_double()
        check(library.geoidx_closest_point(self._handle, address(place), address(point), byref(distance)))
        return point, distance.value


def handle_of(surface: Surface) -> Handle:
    if not isinstance(surface, Surface):
        raise TypeError(f"surface is a {type(surface).__name__}, not a geoidx.Surface")
    return surface.handle


def surface_of(index: Handle, metric: MetricLike) -> Surface:
    """Of the mesh that an index keeps."""
    of_index = BuildOptions(metric, 0.0)
    options = _options_for(of_index)
    out = c_void_p()
    status = library.geoidx_surface_of_index(index, byref(options), byref(out))
    surface = Surface.__new__(Surface)
    Closable.__init__(surface, Handle(out, library.geoidx_surface_close))
    check(status)
    return surface
