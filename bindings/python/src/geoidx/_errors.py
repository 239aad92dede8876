"""Statuses of the library and the exceptions they become."""

from __future__ import annotations

import errno
import os
from enum import IntEnum
from typing import Any, Union

from ._native import library

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


class Status(IntEnum):
    """What a call into the library came to: 0 is success, errors are negative."""

    OK = 0
    INVALID_ARGUMENT = -1
    IO = -2
    NOT_AN_INDEX = -3
    TRUNCATED = -4
    CORRUPT = -5
    CHECKSUM = -6
    UNSUPPORTED_VERSION = -7
    MESH_MISMATCH = -8
    LIMIT = -9
    OUT_OF_MEMORY = -10
    CANCELLED = -11
    BAD_MESH = -12
    CALLBACK = -13
    INTERNAL = -14
    NO_PATH = -15


def status_of(number: int) -> int:
    """A Status, or the number itself where only a newer library knows it."""
    return Status(number) if number in Status.__members__.values() else number


def phrase(status: int) -> str:
    """The library's short English phrase for a status, also for numbers unknown here."""
    text: bytes = library.geoidx_status_string(status)
    return text.decode()


class Error(Exception):
    """A failure of the library. `status` says which, `detail` what, where and which value."""

    status: int = Status.INTERNAL

    def __init__(self, detail: str) -> None:
        super().__init__(detail)
        self.detail = detail

    def __str__(self) -> str:
        return f"{phrase(self.status)}: {self.detail}"


class InvalidArgumentError(Error, ValueError):
    """A vertex id, an option or the shape of an array is out of range, or a handle is closed."""

    status = Status.INVALID_ARGUMENT


def _number_of(detail: str) -> int | None:
    """The errno whose text is at the end of a detail, None where the operating system gave no reason."""
    reason = detail.rpartition(": ")[2]
    return next((number for number in errno.errorcode if os.strerror(number) == reason), None)


class FileError(Error, OSError):
    """The operating system refused to open, read, write or rename.

    `filename` is the path as it was given. `errno` and `strerror` are None where the system gave no reason.
    """

    status = Status.IO

    def __init__(self, detail: str, path: Path | None = None) -> None:
        super().__init__(detail)
        self.filename = None if path is None else os.fspath(path)
        number = _number_of(detail)
        if number is not None:
            self.errno = number
            self.strerror = os.strerror(number)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.detail, self.filename)


class MissingFileError(FileError, FileNotFoundError):
    """There is no such file or folder."""


def _file_error(detail: str, path: Path | None) -> FileError:
    missing = _number_of(detail) == errno.ENOENT
    return MissingFileError(detail, path) if missing else FileError(detail, path)


class FormatError(Error, ValueError):
    """The data is not an index that this library can read."""


class NotAnIndexError(FormatError):
    """The data does not begin like a geoidx file."""

    status = Status.NOT_AN_INDEX


class TruncatedError(FormatError):
    """The data is shorter than its header says."""

    status = Status.TRUNCATED


class CorruptError(FormatError):
    """The data contradicts the format or itself."""

    status = Status.CORRUPT


class ChecksumError(FormatError):
    """Stored bytes do not match their checksum."""

    status = Status.CHECKSUM


class UnsupportedVersionError(FormatError):
    """Written by a newer format, or with features unknown to this library."""

    status = Status.UNSUPPORTED_VERSION


class MeshMismatchError(Error, ValueError):
    """The index belongs to another mesh than the one given."""

    status = Status.MESH_MISMATCH


class LimitError(Error, OverflowError):
    """A count or a distance is over what the format or the library can hold."""

    status = Status.LIMIT


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory, or the allocator gave none."""

    status = Status.OUT_OF_MEMORY


class CancelledError(Error):
    """A progress callable returned False."""

    status = Status.CANCELLED


class BadMeshError(Error, ValueError):
    """The mesh cannot be used; the detail names the element."""

    status = Status.BAD_MESH


class CallbackError(Error, RuntimeError):
    """The caller's metric gave NaN or a negative number."""

    status = Status.CALLBACK


class NoPathError(Error):
    """No path on the surface joins the two points."""

    status = Status.NO_PATH


class InternalError(Error, RuntimeError):
    """A defect of the library."""

    status = Status.INTERNAL


_ERRORS: dict[int, type[Error]] = {
    error.status: error
    for error in (
        InvalidArgumentError,
        NotAnIndexError,
        TruncatedError,
        CorruptError,
        ChecksumError,
        UnsupportedVersionError,
        MeshMismatchError,
        LimitError,
        OutOfMemoryError,
        CancelledError,
        BadMeshError,
        CallbackError,
        NoPathError,
        InternalError,
    )
}


def error_of(status: int, detail: str, path: Path | None = None) -> Error:
    """The exception for a status; a plain Error for one that only a newer library knows."""
    if status == Status.IO:
        return _file_error(detail, path)
    error = _ERRORS.get(status, Error)(detail)
    error.status = status_of(status)
    return error


def last_error() -> str:
    """The detail of the calling thread's latest failure, "" before the first one."""
    text: bytes = library.geoidx_last_error()
    return text.decode(errors="replace")


def check(status: int, path: Path | None = None) -> None:
    """Raises the exception of a status that is not success; `path` is the file that the call was about."""
    if status != Status.OK:
        raise error_of(status, last_error(), path)
