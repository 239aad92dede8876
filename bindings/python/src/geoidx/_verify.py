"""What is wrong with an index."""

from __future__ import annotations

import os
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from . import _native
from ._arrays import address, whole_number
from ._callbacks import HeldSignals
from ._ending import DaemonCall
from ._errors import InvalidArgumentError, check, status_of
from ._files import bytes_of_buffer, bytes_of_file
from ._native import library


class IssueNumber(IntEnum):
    """Which rule of format/SPEC.md is broken; geoidx.h has each in a line. A number never changes its meaning."""

    MAGIC = 1
    HEADER_TRUNCATED = 2
    VERSION = 3
    FEATURE_FLAGS = 4
    FILE_TRUNCATED = 5
    FILE_TOO_LONG = 6
    SECTION_COUNT = 7
    SECTION_TABLE = 8
    SECTION_OUTSIDE = 9
    SECTION_PLACE = 10
    SECTION_TWICE = 11
    SECTION_FLAGS = 12
    SECTION_UNKNOWN = 13
    SECTION_CODEC = 14
    SECTION_SIZE = 15
    FILE_END = 16
    HEADER_CHECKSUM = 17
    PADDING = 18
    SECTION_CHECKSUM = 19
    DECODING = 100
    META = 101
    HIER = 102
    VERT = 103
    POSI = 104
    BORD = 105
    BVBV = 106
    BVIV = 107
    IVIV = 108
    QUAN = 109
    SEGM = 110
    OVOV = 111
    HOPS = 112
    MESH = 113
    PAIR = 114
    EDGE = 115
    WHOLE_INDEX = 200


@dataclass(frozen=True)
class Issue:
    """A problem of an index."""

    number: int
    """An IssueNumber, or the number itself where only a newer library knows it."""
    status: int
    """A Status, likewise."""
    offset: int
    """Where it is, in bytes from the start; of a section's content where the section's bytes begin."""
    message: str
    """One line of text."""


def _issue_of(struct: _native.Issue) -> Issue:
    number = IssueNumber(struct.number) if struct.number in IssueNumber.__members__.values() else struct.number
    return Issue(number, status_of(struct.status), struct.offset, struct.message.decode(errors="replace"))


def verify(source: str | os.PathLike[str] | os.PathLike[bytes] | Any, *, most: int | None = None) -> list[Issue]:
    """Checks each section's checksum and contents, and goes on after a problem where it can.

    source: a path (str or os.PathLike), or the bytes of an index in any contiguous buffer.
    most: how many issues to look for; None: all.

    Returns what is wrong, [] when nothing is. Raises FileError, which is an OSError, when a file cannot be read.
    """
    if isinstance(source, (str, os.PathLike)):
        source = bytes_of_file(source)
    data = bytes_of_buffer(source)
    limit = None if most is None else whole_number(most, "most")
    if limit == 0:
        raise InvalidArgumentError("most is 0: at least one issue is looked for")
    issues: list[Issue] = []

    def note(user: int, issue: Any) -> bool:
        issues.append(_issue_of(issue.contents))
        return (limit is None or len(issues) < limit) and not call.must_stop

    with DaemonCall() as call, HeldSignals() as signals:
        status = library.geoidx_verify(address(data), data.size, _native.IssueFn(note), None)
    signals.deliver()
    if not issues:
        check(status)
    return issues
