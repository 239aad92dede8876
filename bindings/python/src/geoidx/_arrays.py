"""NumPy arrays as the library takes them: without a copy where dtype and layout allow it."""

from __future__ import annotations

import operator
from typing import Any, Sequence, SupportsIndex, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._errors import Error, InvalidArgumentError

UINT32_MAX = 0xFFFFFFFF
UINT64_MAX = 0xFFFFFFFFFFFFFFFF

Ids = NDArray[np.uint32]
Doubles = NDArray[np.float64]

Vertex = Union[int, "np.integer[Any]"]
Vertices = Union[NDArray[Any], Sequence[Any]]


def address(array: NDArray[Any]) -> int:
    return array.ctypes.data


def whole_number(value: SupportsIndex, name: str, largest: int = UINT32_MAX) -> int:
    """`value` as an int of 0 .. largest: ctypes itself would wrap others around."""
    number = operator.index(value)
    if not 0 <= number <= largest:
        raise InvalidArgumentError(f"{name} is {number}, out of 0 .. {largest}")
    return number


def vertex(value: SupportsIndex) -> int:
    return whole_number(value, "a vertex")


def _check_kind(array: NDArray[Any], kinds: str, name: str) -> None:
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name} cannot be of {array.dtype}")


def _check_shape(array: NDArray[Any], name: str, *shape: int | None) -> None:
    fits = array.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, array.shape))
    if not fits:
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise InvalidArgumentError(f"{name} has the shape {array.shape}, not ({wanted})")


def _check_range(array: NDArray[Any], name: str, error: type[Error]) -> None:
    for value in (int(array.min()), int(array.max())):
        if not 0 <= value <= UINT32_MAX:
            raise error(f"{name} hold {value}, which is out of range for a vertex id")


def ids(values: ArrayLike, name: str, error: type[Error] = InvalidArgumentError) -> Ids:
    """Vertex ids of any shape, uint32 and C-contiguous. uint32 and int32 in that layout are not copied."""
    array = np.asarray(values)
    if array.size == 0:
        return np.empty(array.shape, np.uint32)
    _check_kind(array, "iu", name)
    if array.dtype != np.uint32:
        _check_range(array, name, error)
    if array.dtype == np.int32:
        array = array.view(np.uint32)
    return np.require(array, np.uint32, ["C", "ALIGNED"])


def id_list(values: ArrayLike, name: str) -> Ids:
    """One vertex id or a sequence of them, as a sequence."""
    array = np.atleast_1d(ids(values, name))
    _check_shape(array, name, None)
    return array


def id_rows(values: ArrayLike, name: str, columns: int, error: type[Error]) -> Ids:
    array = ids(values, name, error)
    _check_shape(array, name, None, columns)
    return array


def doubles(values: ArrayLike, name: str, *shape: int | None) -> Doubles:
    """Numbers of the shape (None: any length), float64 and C-contiguous; not copied where they are."""
    array = np.asarray(values)
    _check_kind(array, "fiu", name)
    _check_shape(array, name, *shape)
    return np.require(array, np.float64, ["C", "ALIGNED"])


def _rows_are_packed(array: NDArray[Any]) -> bool:
    row, column = array.strides
    return column == array.itemsize and 3 * array.itemsize <= row <= UINT32_MAX


def positions(values: ArrayLike) -> NDArray[Any]:
    """(n, 3) float32 or float64 whose rows are packed, any distance apart; others are copied into such."""
    array = np.asarray(values)
    _check_kind(array, "fiu", "vertices")
    _check_shape(array, "vertices", None, 3)
    dtype = np.dtype(np.float32 if array.dtype.newbyteorder("=") == np.float32 else np.float64)
    if array.dtype == dtype and _rows_are_packed(array):
        return array
    return np.ascontiguousarray(array, dtype)


def output(out: NDArray[Any] | None, shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """`out` if it can be written to as it is, or a new array if it is None."""
    if out is None:
        return np.empty(shape, dtype)
    if not isinstance(out, np.ndarray) or out.dtype != dtype:
        raise TypeError(f"out is not an array of {np.dtype(dtype)}")
    if out.shape != shape:
        raise InvalidArgumentError(f"out has the shape {out.shape}, not {shape}")
    if not out.flags.carray:
        raise InvalidArgumentError("out is not contiguous, aligned and writable")
    return out
