"""The parts of a file."""

from __future__ import annotations

from ctypes import byref, c_uint32
from dataclasses import dataclass
from enum import IntEnum

from . import _native
from ._errors import check
from ._handle import Handle
from ._named import named
from ._native import library


class Coding(IntEnum):
    """How the bytes of a section are stored: as they are, by zstd, as a PNG for each matrix, or as gray PNG images."""

    RAW = 0
    ZSTD = 1
    PNG = 2
    IMAGES = 3


@dataclass(frozen=True)
class Section:
    """A section of the file that an index was opened from; format/SPEC.md says what is in it."""

    tag: str
    """Its name, four characters. Bytes that are not ASCII, which only later versions may have, are escaped."""
    coding: Coding | int
    """A number without a name where geoidx does not know how the section is stored."""
    offset: int
    """Bytes from the start of the file."""
    stored_size: int
    """Bytes in the file."""
    raw_size: int
    """Bytes when decoded."""


def section_of(struct: _native.Section) -> Section:
    return Section(
        struct.tag.decode("ascii", "backslashreplace"),
        named(Coding, struct.coding),
        struct.offset,
        struct.stored_size,
        struct.raw_size,
    )


def read_sections(handle: Handle) -> tuple[Section, ...]:
    count = c_uint32()
    check(library.geoidx_get_sections(handle, None, 0, byref(count)))
    structs = (_native.Section * count.value)()
    check(library.geoidx_get_sections(handle, structs, count, byref(count)))
    return tuple(section_of(struct) for struct in structs)
