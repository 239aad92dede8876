"""Options as the library takes them, with the arrays and functions that they point to."""

from __future__ import annotations

from ctypes import byref, pointer, sizeof
from enum import IntEnum
from typing import Sequence, TypeVar

from . import _native
from ._arrays import UINT64_MAX, flag, real_number, whole_number
from ._callbacks import Callbacks, Progress
from ._errors import InvalidArgumentError
from ._mesh import MeshView
from ._metrics import Callback, MetricLike, as_metric
from ._native import Allocator, library


class Engine(IntEnum):
    """How an index answers: by graph search (as the paper does) or by overlay tables."""

    GRAPH = 0
    OVERLAY = 1


class Codec(IntEnum):
    """The form that a file keeps distances in. Answers are the same bits in each.

    PACKED: the smallest file: what is left of distances when they are predicted from the positions of their vertices
        and from each other, as gray PNG images.
    LOSSLESS: a PNG of float32 for each table. Indices of the graph engine are always saved like this.
    MAPPED: the tables as queries read them, uncompressed: more than ten times as large as packed, but nothing is left
        to do when the file is opened. `Index.open` maps it instead of reading it.
    """

    PACKED = 0
    LOSSLESS = 1
    MAPPED = 2


class BuildOptions:
    """The options of a metric; an index has more."""

    def __init__(self, metric: MetricLike, weld_tolerance: float, progress: Progress | None = None) -> None:
        self.struct = _native.BuildOptions()
        library.geoidx_build_options_init_sized(byref(self.struct), sizeof(self.struct))
        self.struct.weld_tolerance = real_number(weld_tolerance, "weld_tolerance")
        metric = as_metric(metric)
        self._arrays = metric.fill(self.struct)
        self.callbacks = Callbacks(progress, metric.function if isinstance(metric, Callback) else None)
        self.callbacks.fill(self.struct)

    def set_patches(self, patches: Sequence[int]) -> None:
        if len(patches) > _native.MAX_LEVELS:
            raise InvalidArgumentError(f"patches of {len(patches)} levels, more than {_native.MAX_LEVELS}")
        for level, count in enumerate(patches):
            self.struct.patches[level] = whole_number(count, f"patches[{level}]")


class OpenOptions:
    """The options of opening an index."""

    def __init__(
        self,
        expected_mesh: MeshView | None,
        allocator: Allocator | None,
        pairs: bool,
        labels: bool,
        threads: int,
        max_vertices: int,
        max_memory: int,
    ) -> None:
        self.struct = _native.OpenOptions()
        library.geoidx_open_options_init_sized(byref(self.struct), sizeof(self.struct))
        if flag(pairs, "pairs"):
            self.struct.flags |= _native.OPEN_PAIRS
        if not flag(labels, "labels"):
            self.struct.flags |= _native.OPEN_NO_LABELS
        self.struct.threads = whole_number(threads, "threads")
        self.struct.max_vertices = whole_number(max_vertices, "max_vertices", UINT64_MAX)
        self.struct.max_memory = whole_number(max_memory, "max_memory", UINT64_MAX)
        if expected_mesh:
            self._mesh = expected_mesh
            self.struct.expected_mesh = pointer(expected_mesh.struct)
        self.allocator = allocator
        if allocator:
            self.struct.allocator = allocator
        self.borrowed: object = None

    def borrow(self, data: object) -> None:
        """The index reads the tables of a mapped file in `data`, which must be kept as long as the native handle."""
        self.struct.flags |= _native.OPEN_BORROW
        self.borrowed = data


class SaveOptions:
    """The options of saving an index."""

    def __init__(self, codec: Codec | str, positions: bool, mesh: bool) -> None:
        self.struct = _native.SaveOptions()
        library.geoidx_save_options_init_sized(byref(self.struct), sizeof(self.struct))
        self.struct.codec = as_codec(codec)
        if not positions:
            self.struct.flags |= _native.SAVE_NO_POSITIONS
        if not mesh:
            self.struct.flags |= _native.SAVE_NO_MESH


_Member = TypeVar("_Member", Engine, Codec)


def _as_member(enum: type[_Member], what: str, given: _Member | str) -> _Member:
    names: dict[object, _Member] = {name.lower(): member for name, member in enum.__members__.items()}
    if isinstance(given, enum):
        return given
    if given not in names:
        raise InvalidArgumentError(f"the {what} {given!r} is none of {list(names)}")
    return names[given]


def as_engine(engine: Engine | str) -> Engine:
    return _as_member(Engine, "engine", engine)


def as_codec(codec: Codec | str) -> Codec:
    return _as_member(Codec, "codec", codec)
