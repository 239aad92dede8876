"""Native handles: closed once, when nothing uses them any more."""

from __future__ import annotations

import threading
import weakref
from ctypes import c_void_p
from types import TracebackType
from typing import Any, Callable, TypeVar

from ._errors import InvalidArgumentError

Self = TypeVar("Self", bound="Closable")


class Handle:
    """Owns a native handle. It is closed with the last reference to this object, of which a call that is under
    way holds one, too. What is `kept` lives until it has been closed."""

    def __init__(self, pointer: c_void_p, close: Callable[[c_void_p], None], *kept: Any) -> None:
        self._as_parameter_ = pointer
        weakref.finalize(self, _close, pointer, close, kept).atexit = False


def _close(pointer: c_void_p, close: Callable[[c_void_p], None], kept: Any) -> None:
    close(pointer)


class Closable:
    """An object with a native handle: a context manager that is closed at its end."""

    def __init__(self, handle: Handle) -> None:
        self._open_handle: Handle | None = handle

    @property
    def _handle(self) -> Handle:
        if self._open_handle is None:
            raise InvalidArgumentError(f"the {type(self).__name__.lower()} is closed")
        return self._open_handle

    @property
    def closed(self) -> bool:
        return self._open_handle is None

    def close(self) -> None:
        """Gives the memory back, as soon as calls of other threads are done. Closing twice is fine; every
        other use of a closed object raises InvalidArgumentError, which is a ValueError."""
        self._open_handle = None

    def __enter__(self: Self) -> Self:
        self._handle
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class OneThread:
    """`with` this, a call into scratch that one thread at a time may use."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._lock = threading.Lock()

    def __enter__(self) -> None:
        if not self._lock.acquire(blocking=False):
            raise RuntimeError(f"the {self._name} is in use; each thread needs one of its own")

    def __exit__(self, *failure: object) -> None:
        self._lock.release()
