"""Numbers of the library that have names."""

from __future__ import annotations

from enum import IntEnum
from typing import TypeVar

Named = TypeVar("Named", bound=IntEnum)


def named(kind: type[Named], number: int) -> Named | int:
    """The member of this number, or the number itself where a later version of the format gave it a meaning."""
    try:
        return kind(number)
    except ValueError:
        return number
