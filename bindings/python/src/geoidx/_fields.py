"""Calls that an index and a query have in common: a distance, and fields of distances."""

from __future__ import annotations

from ctypes import byref, c_float
from typing import Any, Callable, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import address, id_list, ids, output, vertex, whole_number
from ._errors import InvalidArgumentError, check
from ._handle import Handle

Distances = NDArray[np.float32]
Call = Callable[..., int]


def sssd(call: Call, handle: Handle, source: SupportsIndex, target: SupportsIndex) -> float:
    distance = c_float()
    check(call(handle, vertex(source), vertex(target), byref(distance)))
    return distance.value


def msad(
    call: Call, handle: Handle, sources: ArrayLike, vertex_count: int, out: Distances | None, *radius: float
) -> Distances:
    """`call` fills a field of the nearest of the sources; a radius goes between sources and field."""
    source_ids = id_list(sources, "sources")
    field = output(out, (vertex_count,), np.float32)
    count = whole_number(source_ids.size, "the number of sources")
    check(call(handle, address(source_ids), count, *radius, address(field), vertex_count))
    return field


def ssad(call: Call, handle: Handle, sources: ArrayLike, vertex_count: int, out: Distances | None) -> Distances:
    """`call` fills a field for each of the sources, which are one or a sequence."""
    source_ids = ids(sources, "sources")
    if source_ids.ndim > 1:
        raise InvalidArgumentError(f"sources has the shape {source_ids.shape}, not () or (k,)")
    fields = output(out, source_ids.shape + (vertex_count,), np.float32)
    if source_ids.size:
        count = whole_number(source_ids.size, "the number of sources")
        check(call(handle, address(source_ids), count, address(fields), fields.size))
    return fields


def pairwise(call: Call, handle: Handle, pairs: NDArray[Any], distances: Distances) -> None:
    """`call` fills C-contiguous distances of as many pairs."""
    check(call(handle, address(pairs), distances.size, address(distances)))
