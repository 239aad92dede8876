"""What an index is."""

from __future__ import annotations

from dataclasses import dataclass

from . import _native
from ._metrics import MetricKind
from ._named import named
from ._options import Codec, Engine


@dataclass(frozen=True)
class Info:
    """What an index is. Counts are numbers of things, lengths in the mesh's own unit.

    Errors are of MSAD against the metric itself, |d - exact| / exact over all targets of `error_sources` seeded
    random sources, measured when the index was built.
    """

    metric: MetricKind | int
    """What the distances are by; a plain int where a later version of geoidx built the index by a metric that this one
    does not know. Queries answer all the same."""
    metric_unfoldable: bool
    """Paths may cross borders between two vertices."""
    metric_fingerprint: int
    """Of what decides the metric besides the mesh (costs, lengths); 0: nothing."""
    engine: Engine
    vertex_count: int
    """Of the caller's array."""
    triangle_count: int
    """Of the caller's array."""
    welded_vertex_count: int
    """Distinct vertices after welding that a triangle uses."""
    mesh_fingerprint: int
    table_entries: int
    """Distances in all tables."""
    border_vertex_count: int
    """Vertices on a border of the last level after pruning, with added ones."""
    bounding_box_diagonal: float
    delta: float
    """Pruning threshold, % of the bounding-box diagonal."""
    seed: int
    format_major: int
    format_minor: int
    patch_count: tuple[int, ...]
    """Of each level below the whole mesh."""
    error_sources: int
    error_mean: float
    error_signed_mean: float
    error_p99: float
    error_p999: float
    error_max: float
    """The largest that is expected from one source, by MSAD or SSSD; no less than was found."""
    error_mean_at_vertices: float
    """The mean error if paths crossed borders at vertices only."""
    codec: Codec
    """Of the file that the index was opened from; of one that was built, what it is saved as unless told otherwise."""
    has_positions: bool
    """Whether the file that the index was opened from has the positions of vertices; True of one that was built."""
    smallest_step: float
    """What the distances of the table with the smallest steps are multiples of; 0 for the graph engine."""
    largest_step: float
    """The same of the table with the largest steps. Half a step is the most that rounding changes an entry by."""
    added_vertex_count: int
    """Vertices of the tables that have no id and are in no answer, see `target_error` of `Index.build`."""
    error_near_mean: float
    """Of distances up to 10 average edges of the mesh: the mean of MSAD from random sources; 0 where there are none."""
    error_near_max: float
    """The largest error that is expected, by MSAD or SSSD; no less than was found."""
    error_middle_mean: float
    """The same of longer distances up to 100 average edges."""
    error_middle_max: float
    error_far_mean: float
    """The same of longer distances."""
    error_far_max: float
    error_several_mean: float
    """Of MSAD from several sources."""
    error_several_max: float
    has_mesh: bool
    """Whether the index keeps the mesh, see `store_mesh` of `Index.build`."""

    @property
    def level_count(self) -> int:
        """Levels below the whole mesh."""
        return len(self.patch_count)


def info_of(struct: _native.Info) -> Info:
    same = {name: getattr(struct, name) for name in Info.__dataclass_fields__ if hasattr(struct, name)}
    same.update(
        metric=named(MetricKind, struct.metric),
        metric_unfoldable=bool(struct.metric_flags & _native.METRIC_UNFOLDABLE),
        engine=Engine(struct.engine),
        codec=Codec(struct.codec),
        has_mesh=bool(struct.has_mesh),
        has_positions=not struct.file_flags & _native.SAVE_NO_POSITIONS,
        patch_count=tuple(struct.patch_count[: struct.level_count]),
    )
    return Info(**same)
