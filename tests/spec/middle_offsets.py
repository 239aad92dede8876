"""Distances of middles, a byte each, by the part "Distances of the overlay engine" of format/SPEC.md."""

import numpy

f = numpy.float32
LARGEST, NO_PATH = 32766, 32767
MOST_OFFSET, LONGEST_STRIDE = 127, 255


def strides(length, quantum):
    """In steps, of segments with these lengths; NaN: there is none."""
    scale = f(1) / f(quantum) if quantum > 0 else f(0)
    steps = length.astype(f) * scale * f(0.5 / MOST_OFFSET) + f(1)
    steps = numpy.where(steps < LONGEST_STRIDE, steps, f(LONGEST_STRIDE))
    return numpy.where(length > 0, numpy.trunc(steps), f(0)).astype(f)


def offsets(middle, first, stride):
    """Of codes of middles, from those of the first ends of their segments; NO_PATH where there is none."""
    middle, first = middle.astype(f), first.astype(f)
    inverse = numpy.where(stride > 0, f(1) / numpy.maximum(stride, f(1)), f(0)).astype(f)
    least = numpy.maximum(-numpy.trunc(first * inverse), f(-MOST_OFFSET))
    most = numpy.minimum(numpy.trunc((f(LARGEST) - first) * inverse), f(MOST_OFFSET))
    steps = numpy.maximum(numpy.minimum((middle - first) * inverse, most), least)
    return numpy.where(first < NO_PATH, numpy.floor(steps + f(0.5)), f(0))
