"""Paths and bytes as the library takes them."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InvalidArgumentError, Path, Status, error_of


def native_path(path: Path) -> bytes:
    try:
        name = os.fsencode(path)
    except UnicodeEncodeError as error:
        raise InvalidArgumentError(f"the path {path!r} cannot be encoded: {error.reason}") from None
    if b"\0" in name:
        raise InvalidArgumentError("the path holds a zero byte")
    return name


def bytes_of_file(path: Path) -> bytes:
    try:
        with open(native_path(path), "rb") as file:
            return file.read()
    except OSError as error:
        detail = f"cannot read '{os.fsdecode(path)}': {error.strerror}"
    raise error_of(Status.IO, detail, path)


def bytes_of_buffer(data: Any) -> NDArray[np.uint8]:
    """The bytes of a contiguous buffer, not copied."""
    try:
        return np.frombuffer(data, np.uint8)
    except (ValueError, BufferError) as error:
        raise InvalidArgumentError(f"the bytes of {type(data).__name__} cannot be read: {error}") from None
