"""A mesh of the caller's arrays, for the length of a call."""

from __future__ import annotations

from ctypes import byref, sizeof

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import address, id_rows, positions
from ._errors import BadMeshError
from ._native import library


class MeshView:
    """The struct and the arrays it points into."""

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        self.vertices = positions(vertices)
        self.faces = id_rows(faces, "faces", 3, BadMeshError)
        self.struct = _native.Mesh()
        library.geoidx_mesh_init_sized(byref(self.struct), sizeof(self.struct))
        self._point_to_vertices()
        self.struct.triangles = address(self.faces)
        self.struct.triangle_count = len(self.faces)

    def _point_to_vertices(self) -> None:
        is_float = self.vertices.dtype == np.float32
        self.struct.position_type = _native.POSITION_FLOAT if is_float else _native.POSITION_DOUBLE
        self.struct.positions = address(self.vertices)
        self.struct.vertex_count = len(self.vertices)
        self.struct.position_stride = self.vertices.strides[0]
