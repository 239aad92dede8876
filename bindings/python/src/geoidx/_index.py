"""An index: built from a mesh or opened, saved, asked."""

from __future__ import annotations

import math
from ctypes import byref, c_uint64, c_void_p, sizeof
from typing import Any, Callable, Sequence, SupportsIndex, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _fields, _native
from ._arrays import UINT64_MAX, Ids, Vertex, Vertices, address, broadcast, flag, ids, real_number, whole_number
from ._callbacks import Progress
from ._errors import Path, check
from ._fields import Distances
from ._files import bytes_of_buffer, native_path
from ._handle import Closable, Handle
from ._info import Info, info_of
from ._matrix import matrix
from ._mesh import MeshView
from ._metrics import MetricLike
from ._native import Allocator, library
from ._options import BuildOptions, Codec, Engine, OpenOptions, SaveOptions, as_engine
from ._query import Query
from ._sections import Section, read_sections
from ._surface import Surface, surface_of


def _is_vertex(value: object) -> bool:
    return isinstance(value, (int, np.integer))


def _mesh_of(expected_mesh: tuple[ArrayLike, ArrayLike]) -> MeshView:
    if not isinstance(expected_mesh, (tuple, list)) or len(expected_mesh) != 2:
        raise TypeError("expected_mesh is not (vertices, faces)")
    return MeshView(*expected_mesh)


def _open_options(
    expected_mesh: tuple[ArrayLike, ArrayLike] | None,
    allocator: Allocator | None,
    pairs: bool,
    labels: bool,
    threads: int,
    max_vertices: int,
    max_memory: int,
) -> OpenOptions:
    mesh = None if expected_mesh is None else _mesh_of(expected_mesh)
    return OpenOptions(mesh, allocator, pairs, labels, threads, max_vertices, max_memory)


def _read_info(handle: Handle) -> Info:
    struct = _native.Info(struct_size=sizeof(_native.Info))
    check(library.geoidx_get_info(handle, byref(struct)))
    return info_of(struct)


class Index(Closable):
    """An index: a mesh's distances, precomputed. Made by `build`, `open` or `from_bytes`.

    Immutable: any number of threads may ask one index at once, and calls let other Python threads run. Vertex ids
    are positions in the array given to `build`; negative ones are refused. Distances are float32 in the mesh's own
    unit, infinite where there is no path. Pickles as its bytes.
    """

    def __init__(self, handle: Handle) -> None:
        if not isinstance(handle, Handle):
            raise TypeError("an index is made by Index.open, Index.build or Index.from_bytes")
        super().__init__(handle)
        self._info = _read_info(handle)

    @classmethod
    def build(
        cls,
        vertices: ArrayLike,
        faces: ArrayLike,
        *,
        metric: MetricLike = "exact",
        engine: Engine | str = Engine.OVERLAY,
        levels: int = 0,
        patches: Sequence[int] = (),
        delta: float = 0.0,
        weld_tolerance: float = 0.0,
        exact_vertices: int = 400,
        rounding: float = 1 / 64,
        target_error: float = 0.0005,
        lloyd_iterations: int = 4,
        seed: int = 0,
        threads: int = 0,
        refuse_edges_of_many: bool = False,
        store_mesh: bool = False,
        progress: Progress | None = None,
        allocator: Allocator | None = None,
    ) -> Index:
        """Builds the index of a triangle mesh. Mesh, options and seed decide every bit, whatever the threads.

        vertices: (n, 3). float32 and float64 are not copied when x, y, z lie side by side, also as a part of larger
            records.
        faces: (m, 3) vertex ids of any integer type. C-contiguous uint32 and int32 are not copied.
        metric: "exact", "edges", a function as of `Callback`, or an Exact, Edges, Weighted or Callback.
        engine: "overlay", or "graph" for the paper's graph search.
        levels: below the whole mesh, at most 8; 0: as many as `patches` names, or automatic.
        patches: of level 1, then into how many each patch of a level is split; 0: in proportion to the triangles.
        delta: pruning threshold, % of the bounding-box diagonal.
        weld_tolerance: vertices at most this far apart are one; 0: equal positions only.
        exact_vertices: overlay tables of patches of up to so many vertices hold the metric's own distances.
        rounding: overlay tables hold distances in multiples of this share, 0 .. 1, of the way from a vertex to the
            next, for each patch by itself, but never of more than 1/8192 of the longest way on the surface around it,
            and only to 16 bits in an index of fewer than 65,536 table entries. 0: to 16 bits only. Twice the share
            saves one bit of each entry in a packed file.
        target_error: of the overlay engine with the exact metric and delta 0, the mean error, 0 .. 1, that the index
            is to have at most, where triangles are large also of fields from points within them, whose p99.9 is to be
            at most twenty times as much; the index does not state these. Where it is larger,
            edges between patches are cut in halves, up to five times, as long as the error becomes smaller and table
            entries stay below two and a half times their number without, or 131,072. 0: no edge is cut.
        lloyd_iterations: relaxations of the patches' seeds.
        threads: 0: one per processor.
        refuse_edges_of_many: an edge with more than two triangles is a BadMeshError.
        store_mesh: keeps the mesh in the index, so that its file alone is enough for `surface`: some 20 bytes a vertex
            of float32, 30 of float64.
        progress: called on this thread with a fraction of 0 .. 1 and the name of a stage. Returning False cancels
            the build (CancelledError); what it raises stops the build and is raised here, as is KeyboardInterrupt.

        Raises BadMeshError for NaN, infinite positions and faces out of range, InvalidArgumentError for options and
        shapes, TypeError for dtypes.
        """
        mesh = MeshView(vertices, faces)
        options = BuildOptions(metric, weld_tolerance, progress)
        struct = options.struct
        struct.engine = as_engine(engine)
        struct.level_count = whole_number(levels, "levels")
        options.set_patches(patches)
        struct.delta = real_number(delta, "delta")
        struct.exact_vertices = whole_number(exact_vertices, "exact_vertices")
        struct.rounding = real_number(rounding, "rounding")
        struct.target_error = real_number(target_error, "target_error")
        struct.lloyd_iterations = whole_number(lloyd_iterations, "lloyd_iterations")
        struct.seed = whole_number(seed, "seed", UINT64_MAX)
        struct.threads = whole_number(threads, "threads")
        struct.refuse_edges_of_many = flag(refuse_edges_of_many, "refuse_edges_of_many")
        struct.store_mesh = flag(store_mesh, "store_mesh")
        if allocator:
            struct.allocator = allocator
        out = c_void_p()
        with options.callbacks.calling():
            status = library.geoidx_build(byref(mesh.struct), byref(struct), byref(out))
            handle = Handle(out, library.geoidx_close, kept=allocator)
        check(status)
        return cls(handle)

    @classmethod
    def open(
        cls,
        path: Path,
        *,
        expected_mesh: tuple[ArrayLike, ArrayLike] | None = None,
        allocator: Allocator | None = None,
        pairs: bool = False,
        labels: bool = True,
        threads: int = 0,
        max_vertices: int = 0,
        max_memory: int = 0,
    ) -> Index:
        """Opens a file: str, bytes or os.PathLike of either. Everything in it is checked before it is believed.

        expected_mesh: the vertices and faces that the index must have been built from, else MeshMismatchError: the
            same faces, and vertices that are equal as float32, whichever of the two was given as float64. A file that
            was saved without positions needs it (else InvalidArgumentError), and the vertices in the precision that
            the index was built with.
        pairs: makes ready what distances between two vertices need. Otherwise the first one that is asked for makes a
            part of it, and takes the memory for all, and later ones make the rest as they need it, which takes 1 to
            15 ms each time for 40,000 vertices; where only fields are asked for, it is never made and takes no memory.
        labels: makes labels a part of what distances between two vertices need: the distances of each vertex to one
            or two borders that lie farther out. Without labels all of this takes a third of the memory and a tenth of
            the time to be made, and each distance between two vertices takes two to five times as long. It differs by
            0.01 % on average, and by 1 to 3 % at most, on rough terrain by up to 5 %. Fields do not need labels and
            stay the same bits. An index that was just built has labels.
        threads: that decode tables. 0: one per processor.
        max_vertices: the most vertices that the index may have, else LimitError. 0: any number.
        max_memory: the most bytes that the decoded sections of the file may take, and the most that the index with its
            queries may, else LimitError, also of a query while the index is open. 0: in proportion to the file.

        A mapped file is not read, but mapped: as long as the index is open, nobody may write into it or cut it short.
        Saving over it replaces it, which does no harm.

        Raises FileError, which is an OSError (MissingFileError, a FileNotFoundError, where there is no such file),
        and FormatError, which is a ValueError. A path that no file can have is an InvalidArgumentError.
        """
        name = native_path(path)
        options = _open_options(expected_mesh, allocator, pairs, labels, threads, max_vertices, max_memory)
        return cls._opened(options, lambda *rest: library.geoidx_open(name, *rest), path)

    @classmethod
    def from_bytes(
        cls,
        data: Any,
        *,
        expected_mesh: tuple[ArrayLike, ArrayLike] | None = None,
        allocator: Allocator | None = None,
        pairs: bool = False,
        labels: bool = True,
        threads: int = 0,
        max_vertices: int = 0,
        max_memory: int = 0,
        borrow: bool = False,
    ) -> Index:
        """Opens an index in memory: bytes, or any other contiguous buffer. The other options are those of `open`.

        borrow: keeps `data`, which must be bytes, as long as the index and its queries, so that the tables of a mapped
            file are not copied. Otherwise these are, and `data` is not needed after the call.

        Raises FormatError, InvalidArgumentError for buffers that are not contiguous, or closed, and TypeError for
        what cannot be borrowed.
        """
        # Only bytes never change; a subclass may have a buffer of its own.
        is_borrowed = flag(borrow, "borrow")
        if is_borrowed and type(data) is not bytes:
            raise TypeError(f"only bytes can be borrowed, not {type(data).__name__}")
        view = bytes_of_buffer(data)
        options = _open_options(expected_mesh, allocator, pairs, labels, threads, max_vertices, max_memory)
        if is_borrowed:
            options.borrow(view)
        return cls._opened(options, lambda *rest: library.geoidx_open_memory(address(view), view.size, *rest))

    @classmethod
    def _opened(cls, options: OpenOptions, call: Callable[..., int], path: Path | None = None) -> Index:
        out = c_void_p()
        status = call(byref(options.struct), byref(out))
        handle = Handle(out, library.geoidx_close, kept=(options.allocator, options.borrowed))
        check(status, path)
        return cls(handle)

    def save(
        self,
        path: Path,
        *,
        codec: Codec | str | None = None,
        positions: bool | None = None,
        mesh: bool = True,
    ) -> None:
        """Writes the index to a file, replacing what is there at once or, on failure (FileError), not at all.

        codec: "packed", the smallest file, "lossless", with a PNG of float32 for each table, or "mapped", more than
            ten times as large as packed, but opened at once; None: `info.codec`. An index of the graph engine is
            always lossless. Answers are the same bits.
        positions: False leaves out those of the vertices, some 3.5 bytes each; the file then opens with expected_mesh
            only. None: `info.has_positions`.
        mesh: False leaves out the mesh that the index keeps.
        """
        options = self._save_options(codec, positions, mesh)
        check(library.geoidx_save(self._handle, native_path(path), options.struct), path)

    def to_bytes(
        self, *, codec: Codec | str | None = None, positions: bool | None = None, mesh: bool = True
    ) -> bytes:
        """The bytes of the file, as `save` writes it."""
        options = self._save_options(codec, positions, mesh)
        buffer = np.empty(self._likely_size(), np.uint8)
        needed = self._encode(options, buffer)
        if needed > buffer.size:
            buffer = np.empty(needed, np.uint8)
            self._encode(options, buffer)
        return buffer[:needed].tobytes()

    def _save_options(self, codec: Codec | str | None, positions: bool | None, mesh: bool) -> SaveOptions:
        return SaveOptions(
            self.info.codec if codec is None else codec,
            self.info.has_positions if positions is None else flag(positions, "positions"),
            flag(mesh, "mesh"),
        )

    def _likely_size(self) -> int:
        """More bytes than most files have. Asking for their number encodes them, too."""
        return 8 * self.info.table_entries + 64 * self.vertex_count + (1 << 16)

    def _encode(self, options: SaveOptions, buffer: NDArray[np.uint8]) -> int:
        """The number of the file's bytes, which are in the buffer unless there are more than it holds."""
        needed = c_uint64()
        status = library.geoidx_save_memory(
            self._handle, options.struct, address(buffer), buffer.size, byref(needed)
        )
        if needed.value <= buffer.size:
            check(status)
        return needed.value

    def __reduce__(self) -> tuple[Callable[[bytes], Index], tuple[bytes]]:
        return type(self).from_bytes, (self.to_bytes(positions=True),)

    def __repr__(self) -> str:
        return f"<geoidx.Index of {self._info.vertex_count} vertices{', closed' if self.closed else ''}>"

    @property
    def info(self) -> Info:
        """What the index is."""
        self._handle
        return self._info

    @property
    def sections(self) -> tuple[Section, ...]:
        """The sections of the file that the index was opened from, in its order; of an index that was built, none."""
        return read_sections(self._handle)

    def surface(self, *, metric: MetricLike = "exact") -> Surface:
        """The surface of the mesh that the index keeps (`store_mesh` of `build`), which outlives the index.

        metric: that of the index, whose costs paths by `Edges` with costs and by `Weighted` need; others need none.

        It is the same as the `Surface` of the vertices and faces that the index was built from. Raises
        InvalidArgumentError if the index keeps none, see `info.has_mesh`, and CorruptError if the mesh in the file is
        not the one that the index was built from.
        """
        return surface_of(self._handle, metric)

    @property
    def vertex_count(self) -> int:
        """n, the number of vertices in the array given to `build`."""
        return self.info.vertex_count

    @overload
    def sssd(self, a: Vertex, b: Vertex) -> float: ...
    @overload
    def sssd(self, a: Vertices, b: ArrayLike) -> Distances: ...
    @overload
    def sssd(self, a: ArrayLike, b: Vertices) -> Distances: ...
    @overload
    def sssd(self, a: ArrayLike, b: ArrayLike) -> Distances | float: ...

    def sssd(self, a: ArrayLike, b: ArrayLike) -> Distances | float:
        """Single source, single destination: a float for two vertices, else an array, a and b broadcast together.

        Symmetric bit for bit. Many pairs in one call take less time each.
        """
        if _is_vertex(a) and _is_vertex(b):
            return _fields.sssd(library.geoidx_sssd, self._handle, a, b)  # type: ignore[arg-type]
        pairs = np.stack(broadcast(ids(a, "a"), ids(b, "b")), axis=-1)
        distances = np.empty(pairs.shape[:-1], np.float32)
        _fields.pairwise(library.geoidx_sssd_batch, self._handle, pairs, distances)
        return distances if distances.ndim else float(distances)

    def matrix(
        self, sources: ArrayLike, targets: ArrayLike | None = None, *, out: Distances | None = None
    ) -> Distances:
        """(len(sources), len(targets)) distances from each source to each target; targets: sources, unless given.

        Takes the faster of two ways: for few vertices, pairs, with the same bits as `sssd` gives; for many, fields,
        with those of `ssad` from the sources or from the targets. Both are as near the metric on average; they differ
        by some hundredths of a percent, for single pairs by 1 % and more. By the graph engine they agree to float
        precision. Who needs the answers of one way asks for `sssd(sources[:, None], targets)` or
        `ssad(sources)[:, targets]`.

        Where sources and targets are equal, the matrix is symmetric bit for bit, with zeros on the diagonal: of
        fields, the mean of both ways is taken. In every matrix a vertex is 0 from itself.

        sources, targets: a vertex or (k,) of them.
        out: float32 of that shape, C-contiguous, to be written to and returned.
        """
        return matrix(library.geoidx_matrix, self._handle, sources, targets, out)

    def msad(self, sources: ArrayLike, *, radius: float = math.inf, out: Distances | None = None) -> Distances:
        """Multiple sources, all destinations: (n,) distances to the nearest of the sources.

        sources: a vertex or (k,) of them, at least one.
        radius: vertices farther than this are at infinity, and looking for them ends there.
        out: (n,) float32, C-contiguous, to be written to and returned.
        """
        if radius == math.inf:
            return _fields.msad(library.geoidx_msad, self._handle, sources, self.vertex_count, out)
        with self.query() as query:
            return query.msad(sources, radius=radius, out=out)

    def ssad(self, sources: ArrayLike, *, out: Distances | None = None) -> Distances:
        """Single source, all destinations, of each source by itself: (k, n) for (k,) sources, (n,) for a vertex.

        out: float32 of that shape, C-contiguous, to be written to and returned.
        """
        return _fields.ssad(library.geoidx_ssad_batch, self._handle, sources, self.vertex_count, out)

    def nearest(self, sources: ArrayLike, *, out: Distances | None = None) -> Ids:
        """Which source is the nearest to each vertex: (n,) positions in sources, NO_SOURCE where none is reached.

        Of several sources that are as near, it is one whose choice depends on the index alone; of a vertex that is
        repeated, the first.

        sources: a vertex or (k,) of them, at least one.
        out: (n,) float32, C-contiguous, to be written to: the distances, the same bits as those of `msad`.
        """
        with self.query() as query:
            return query.nearest(sources, out=out)

    def within(self, sources: ArrayLike, radius: float) -> tuple[Ids, Distances]:
        """The vertices that are no farther than radius from the nearest of the sources, and how far they are.

        Two arrays of the same length, the nearest first, of those that are as near the one with the least id. By the
        overlay engine the search takes time in proportion to what lies within the radius. `Query.within` keeps its
        scratch of 12 bytes a vertex for the next call, and is faster where many are asked for.

        sources: a vertex or (k,) of them, at least one.
        """
        with self.query() as query:
            return query.within(sources, radius)

    def nearest_targets(
        self, source: SupportsIndex, targets: ArrayLike, count: SupportsIndex
    ) -> tuple[Ids, Distances]:
        """The targets that are nearest to the source, as positions in targets, and how far they are.

        Two arrays of the same length, the nearest first, of those that are as near the one that comes first. There
        are fewer than count only if no other target can be reached.

        targets: a vertex or (k,) of them.
        """
        with self.query() as query:
            return query.nearest_targets(source, targets, count)

    def farthest_points(self, count: SupportsIndex, *, sources: ArrayLike = 0) -> Ids:
        """Farthest-point sampling: (count,) vertices, each the farthest from the sources and from those before it.

        sources: a vertex or (k,) of them, at least one; they are not among the points. Components that no source lies
        in come first. There are fewer points only if all others are at distance 0 of these.
        """
        with self.query() as query:
            return query.farthest_points(count, sources=sources)

    def query(self, *, threads: int = 1) -> Query:
        """Scratch for the queries of one thread; `threads` as in `Query.threads`, 0: one per processor."""
        query = Query(self._handle, self.vertex_count)
        if threads != 1:
            query.threads = threads
        return query
