"""Native handles: closed once, when nothing uses them any more."""

from __future__ import annotations

import threading
import weakref
from ctypes import c_void_p
from types import TracebackType
from typing import Callable, TypeVar

from ._errors import InvalidArgumentError

Self = TypeVar("Self", bound="Closable")
Close = Callable[[c_void_p], None]


class _Closer:
    """Closes a native handle with the last reference to this object, and lets go of `needed` after that."""

    def __init__(self, pointer: c_void_p, close: Close, needed: _Closer | None) -> None:
        weakref.finalize(self, _close, pointer, close, needed).atexit = False


def _close(pointer: c_void_p, close: Close, needed: _Closer | None) -> None:
    close(pointer)


def _let_go(closer: _Closer) -> None:
    """The finalizer's reference ends with this call."""


class Handle:
    """Owns a native handle. It is closed with the last reference to this object, of which a call that is under
    way holds one, too.

    kept: lives until the handle has been closed. It may refer to this object: the cycle is collected, since
        finalizers, which run before anything in it is torn down, refer to native handles only.
    needed: a handle that is closed after this one.
    """

    def __init__(
        self, pointer: c_void_p, close: Close, *, kept: object = None, needed: Handle | None = None
    ) -> None:
        self._as_parameter_ = pointer
        self._kept = kept, needed
        closer = _Closer(pointer, close, needed._closer() if needed else None)
        self._closer: weakref.ref[_Closer] = weakref.ref(closer)
        weakref.finalize(self, _let_go, closer).atexit = False


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
