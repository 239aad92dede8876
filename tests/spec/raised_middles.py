"""Middles that are derived too short, by the part "Distances of the overlay engine" of format/SPEC.md."""

import numpy

MOST_VERTICES = 256


def raised_middles(codes, apart, longest, no_path):
    """Codes of a leaf's middles, a row for each internal vertex; `apart` has the codes of all pairs of these."""
    raised, there = codes.copy(), codes != no_path
    if len(codes) > MOST_VERTICES:
        return raised
    for y, row in enumerate(apart):
        near = (row != no_path) & (row <= longest)
        allowed = codes[y][None, :] - (row + row // 25)[near, None]
        higher = there[near] & there[y][None, :] & (allowed > raised[near])
        raised[near] = numpy.where(higher, allowed, raised[near])
    return raised
