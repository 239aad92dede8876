"""Geodesic distances on triangle meshes, precomputed once, answered from one file.

    import geoidx
    index = geoidx.Index.build(vertices, faces)
    index.sssd(0, 2)        # the distance between two vertices
    index.msad([0, 7])      # of every vertex to the nearest of some
    index.save("square.geoidx")
"""

from ._callbacks import MetricFunction, Progress
from ._errors import (
    BadMeshError,
    CallbackError,
    CancelledError,
    ChecksumError,
    CorruptError,
    Error,
    FileError,
    FormatError,
    InternalError,
    InvalidArgumentError,
    LimitError,
    MeshMismatchError,
    MissingFileError,
    NoPathError,
    NotAnIndexError,
    OutOfMemoryError,
    Status,
    TruncatedError,
    UnsupportedVersionError,
)
from ._index import Index
from ._info import Info
from ._metrics import Callback, Edges, Exact, Metric, MetricKind, MetricLike, Weighted
from ._native import (
    HEADER_VERSION,
    NO_SOURCE,
    AllocateFn,
    Allocator,
    ReleaseFn,
    library,
    version_of,
    version_text,
)
from ._options import Codec, Engine
from ._query import Query
from ._sections import Coding, Section
from ._solver import Solver
from ._surface import SURFACE_POINT, Path, Step, Surface, surface_points
from ._verify import Issue, IssueNumber, verify

__version__ = version_text(HEADER_VERSION)
library_version = version_text(version_of(library))
"""The release of the native library in use."""

__all__ = [
    "NO_SOURCE",
    "SURFACE_POINT",
    "AllocateFn",
    "Allocator",
    "BadMeshError",
    "Callback",
    "CallbackError",
    "CancelledError",
    "ChecksumError",
    "Codec",
    "Coding",
    "CorruptError",
    "Edges",
    "Engine",
    "Error",
    "Exact",
    "FileError",
    "FormatError",
    "Index",
    "Info",
    "InternalError",
    "InvalidArgumentError",
    "Issue",
    "IssueNumber",
    "LimitError",
    "MeshMismatchError",
    "Metric",
    "MetricFunction",
    "MetricKind",
    "MetricLike",
    "MissingFileError",
    "NoPathError",
    "NotAnIndexError",
    "OutOfMemoryError",
    "Path",
    "Progress",
    "Query",
    "ReleaseFn",
    "Section",
    "Solver",
    "Status",
    "Step",
    "Surface",
    "TruncatedError",
    "UnsupportedVersionError",
    "Weighted",
    "library_version",
    "surface_points",
    "verify",
]
