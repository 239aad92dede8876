"""The end of the interpreter, which must not come while the library is inside a Python function.

Such a function cannot return to the library any more, and the process would be aborted. Only threads that are daemons
can be inside the library by then.
"""

from __future__ import annotations

import atexit
import os
import threading

LONGEST_WAIT = 10.0
"""Seconds that the end of the interpreter waits for calls to come back."""


class _Ending:
    """Counts calls, and waits for them when the interpreter ends."""

    def __init__(self) -> None:
        self._reset()
        atexit.register(self._begin)
        os.register_at_fork(after_in_child=self._reset)

    def _reset(self) -> None:
        self.has_begun = False
        self._changed = threading.Condition()
        self._calls: set[DaemonCall] = set()

    def _begin(self) -> None:
        with self._changed:
            self.has_begun = True
            self._changed.wait_for(lambda: not self._calls, LONGEST_WAIT)

    def enter(self, call: DaemonCall) -> None:
        with self._changed:
            self.refuse()
            self._calls.add(call)

    def leave(self, call: DaemonCall) -> None:
        with self._changed:
            self._calls.discard(call)
            self._changed.notify_all()

    def refuse(self) -> None:
        """Raises SystemExit, which ends a thread without a word, when the interpreter ends."""
        if self.has_begun:
            raise SystemExit


_ending = _Ending()


class DaemonCall:
    """`with` this, a call into the library that runs Python functions; it means something to daemon threads only.

    When the interpreter ends, the functions must let the library stop. Then, and in later calls, `with` raises
    SystemExit.
    """

    def __init__(self) -> None:
        self._counts = threading.current_thread().daemon

    @property
    def must_stop(self) -> bool:
        return self._counts and _ending.has_begun

    def __enter__(self) -> DaemonCall:
        if self._counts:
            _ending.enter(self)
        return self

    def __exit__(self, *failure: object) -> None:
        if self._counts:
            _ending.leave(self)
            _ending.refuse()
