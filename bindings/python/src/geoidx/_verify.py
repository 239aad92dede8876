"""What is wrong with an index."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

from . import _native
from ._arrays import address
from ._callbacks import HeldSignals
from ._ending import DaemonCall
from ._errors import check, status_of
from ._files import bytes_of_buffer, bytes_of_file
from ._native import library


@dataclass(frozen=True)
class Issue:
    """A problem of an index: its Status, the byte offset it concerns, and one line of text."""

    status: int
    offset: int
    message: str


def verify(source: str | os.PathLike[str] | os.PathLike[bytes] | Any, *, most: int | None = None) -> list[Issue]:
    """Checks each section's checksum and contents, and goes on after a problem where it can.

    source: a path (str or os.PathLike), or the bytes of an index in any contiguous buffer.
    most: how many issues to look for; None: all.

    Returns what is wrong, [] when nothing is. Raises FileError, which is an OSError, when a file cannot be read.
    """
    if isinstance(source, (str, os.PathLike)):
        source = bytes_of_file(source)
    data = bytes_of_buffer(source)
    issues: list[Issue] = []

    def note(user: int, status: int, offset: int, message: bytes) -> bool:
        issues.append(Issue(status_of(status), offset, message.decode(errors="replace")))
        return len(issues) != most and not call.must_stop

    with DaemonCall() as call, HeldSignals() as signals:
        status = library.geoidx_verify(address(data), data.size, _native.IssueFn(note), None)
    signals.deliver()
    if not issues:
        check(status)
    return issues
