"""Python functions that the library calls: their exceptions stop the native call and are raised after it."""

from __future__ import annotations

import signal
import threading
from contextlib import contextmanager
from ctypes import c_uint32, memmove
from types import FrameType
from typing import Any, Callable, Iterator, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import Ids, address, doubles
from ._ending import DaemonCall
from ._errors import Status

Progress = Callable[[float, str], Optional[bool]]
MetricFunction = Callable[[int, Ids], ArrayLike]


def _on_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


class HeldSignals:
    """While this is entered, signals wait for `deliver`.

    Python handles signals at the first instruction of a callback, where no `try` can catch what a handler
    raises, and ctypes would drop it: a KeyboardInterrupt would be lost.
    """

    def __init__(self) -> None:
        self._handlers: dict[int, Callable[[int, FrameType | None], Any]] = {}
        self._arrived: list[tuple[int, FrameType | None]] = []

    def _note(self, number: int, frame: FrameType | None) -> None:
        self._arrived.append((number, frame))

    def __enter__(self) -> HeldSignals:
        for number in signal.valid_signals() if _on_main_thread() else ():
            handler = signal.getsignal(number)
            if callable(handler):
                self._handlers[number] = handler
                signal.signal(number, self._note)
        return self

    def __exit__(self, *failure: object) -> None:
        for number, handler in self._handlers.items():
            signal.signal(number, handler)

    def deliver(self) -> None:
        while self._arrived and _on_main_thread():
            number, frame = self._arrived.pop(0)
            self._handlers[number](number, frame)


class Callbacks:
    """The callbacks of one native object. The first exception that one of them raises is kept."""

    def __init__(self, progress: Progress | None = None, metric: MetricFunction | None = None) -> None:
        self._progress = progress
        self._metric = metric
        self._call = DaemonCall()
        self._signals = HeldSignals()
        self._raised: BaseException | None = None

    def fill(self, options: _native.BuildOptions) -> None:
        options.progress = _native.ProgressFn(self._report)
        if self._metric:
            options.metric_callback = _native.MetricFn(self._measure)

    @contextmanager
    def calling(self) -> Iterator[None]:
        """Around a native call: raises after it what a callback has raised."""
        self._call = DaemonCall()
        self._signals = HeldSignals()
        with self._call, self._signals:
            yield
        raised, self._raised = self._raised, None
        try:
            if raised is not None:
                raise raised
            self._signals.deliver()
        finally:
            del raised

    def _report(self, user: int, fraction: float, stage: bytes) -> bool:
        return self._succeeds(self._go_on, fraction, stage.decode())

    def _go_on(self, fraction: float, stage: str) -> bool:
        answer = self._progress(fraction, stage) if self._progress else None
        return answer is None or bool(answer)

    def _measure(self, user: int, source: int, targets: int, count: int, distances: int) -> int:
        done = self._succeeds(self._write_distances, source, targets, count, distances)
        return Status.OK if done else Status.CALLBACK

    def _write_distances(self, source: int, targets: int, count: int, distances: int) -> bool:
        assert self._metric
        ids = np.array((c_uint32 * count).from_address(targets))
        result = doubles(self._metric(source, ids), "distances of the metric", count)
        memmove(distances, address(result), result.nbytes)
        return True

    def _succeeds(self, body: Callable[..., bool], *arguments: Any) -> bool:
        if self._call.must_stop:
            return False
        try:
            self._signals.deliver()
            result = body(*arguments)
            self._signals.deliver()
            return result
        except BaseException as error:
            if self._raised is None:
                self._raised = error
            return False
