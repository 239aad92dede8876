"""NumPy arrays as the library takes them: without a copy where dtype and layout allow it."""

from __future__ import annotations

import operator
from ctypes import c_double
from typing import Any, Sequence, SupportsFloat, SupportsIndex, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._errors import Error, InvalidArgumentError

UINT32_MAX = 0xFFFFFFFF
UINT64_MAX = 0xFFFFFFFFFFFFFFFF

Ids = NDArray[np.uint32]
Doubles = NDArray[np.float64]
Floats = NDArray[np.float32]

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


def flag(value: bool, name: str) -> bool:
    """Refuses what is neither True nor False: a text like "no" would count as True."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value!r}, neither True nor False")
    return bool(value)


def real_number(value: SupportsFloat, name: str) -> float:
    try:
        return c_double(value).value  # type: ignore[arg-type]
    except OverflowError:
        raise InvalidArgumentError(f"{name} is too large for a float") from None


def vertex(value: SupportsIndex) -> int:
    if isinstance(value, (bool, np.bool_)):
        raise TypeError("a vertex cannot be of bool")
    return whole_number(value, "a vertex")


def as_array(values: Any, name: str) -> NDArray[Any]:
    if np.ma.is_masked(values):  # type: ignore[no-untyped-call]
        raise InvalidArgumentError(f"{name} has masked values: the library knows no masks")
    try:
        return np.asarray(values)
    except ValueError as error:  # rows of different lengths
        raise InvalidArgumentError(f"{name} cannot be an array: {error}") from None


def broadcast(*arrays: NDArray[Any]) -> Sequence[NDArray[Any]]:
    try:
        return np.broadcast_arrays(*arrays)
    except ValueError:
        shapes = " and ".join(str(array.shape) for array in arrays)
        raise InvalidArgumentError(f"the shapes {shapes} cannot be broadcast together") from None


def _check_kind(array: NDArray[Any], kinds: str, name: str) -> None:
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name} cannot be of {array.dtype}")


def _check_shape(array: NDArray[Any], name: str, *shape: int | None) -> None:
    fits = array.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, array.shape))
    if not fits:
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise InvalidArgumentError(f"{name} has the shape {array.shape}, not ({wanted})")


def _check_range(array: NDArray[Any], name: str, error: type[Error], what: str) -> None:
    for value in (int(array.min()), int(array.max())):
        if not 0 <= value <= UINT32_MAX:
            raise error(f"{name} hold {value}, which is out of range for {what}")


def _whole_objects(values: Any) -> NDArray[Any] | None:
    """Whole numbers of a sequence as ints, or None if others are among them."""
    objects: NDArray[Any] = np.array(values, object)
    if not all(isinstance(value, (int, np.integer)) and not isinstance(value, bool) for value in objects.flat):
        return None
    for i, value in enumerate(objects.flat):
        objects.flat[i] = int(value)
    return objects


def ids(
    values: ArrayLike, name: str, error: type[Error] = InvalidArgumentError, what: str = "a vertex id"
) -> Ids:
    """Ids of any shape, uint32 and C-contiguous. uint32 and int32 in that layout are not copied. `what` is what
    messages call one of them."""
    array = as_array(values, name)
    if array.size == 0:
        return np.empty(array.shape, np.uint32)
    if array.dtype == np.float64 and not isinstance(values, np.ndarray):
        whole = _whole_objects(values)  # NumPy makes floats of a np.uint64 beside an int
        if whole is not None:
            _check_range(whole, name, error, what)
            return whole.astype(np.uint32)
    if array.dtype == object and all(type(value) is int for value in array.flat):
        _check_range(array, name, error, what)  # some are out of range for 64 bits
    _check_kind(array, "iu", name)
    if array.dtype != np.uint32:
        _check_range(array, name, error, what)
    if array.dtype == np.int32:
        array = array.view(np.uint32)
    return np.require(array, np.uint32, ["C", "ALIGNED"])


def id_list(values: ArrayLike, name: str, what: str = "a vertex id") -> Ids:
    """One id or a sequence of them, as a sequence."""
    array = np.atleast_1d(ids(values, name, what=what))
    _check_shape(array, name, None)
    return array


def id_rows(values: ArrayLike, name: str, columns: int, error: type[Error]) -> Ids:
    array = ids(values, name, error)
    _check_shape(array, name, None, columns)
    return array


def doubles(values: ArrayLike, name: str, *shape: int | None) -> Doubles:
    """Numbers of the shape (None: any length), float64 and C-contiguous; not copied where they are."""
    array = as_array(values, name)
    _check_kind(array, "fiu", name)
    _check_shape(array, name, *shape)
    return np.require(array, np.float64, ["C", "ALIGNED"])


def floats(values: ArrayLike, name: str, *shape: int | None) -> Floats:
    """Numbers of the shape, float32 and C-contiguous; not copied where they are."""
    array = as_array(values, name)
    _check_kind(array, "fiu", name)
    _check_shape(array, name, *shape)
    with np.errstate(over="ignore"):  # the library refuses what is infinite then
        return np.require(array, np.float32, ["C", "ALIGNED"])


def _rows_are_packed(array: NDArray[Any]) -> bool:
    row, column = array.strides
    return column == array.itemsize and 3 * array.itemsize <= row <= UINT32_MAX


def positions(values: ArrayLike, name: str = "vertices") -> NDArray[Any]:
    """(n, 3) float32 or float64 whose rows are packed, any distance apart; others are copied into such."""
    array = as_array(values, name)
    _check_kind(array, "fiu", name)
    _check_shape(array, name, None, 3)
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
