"""Distances of middles, a byte each, by the part "Distances of the overlay engine" of format/SPEC.md."""

import numpy

f = numpy.float32
NO_PATH = 32767
MOST_OFFSET, LONGEST_STRIDE = 255, 127


def strides(length, quantum):
    """In steps, of segments with these lengths; NaN: there is none."""
    scale = numpy.minimum(f(1) / f(quantum), numpy.finfo(f).max) if quantum > 0 else f(0)
    steps = length.astype(f) * scale * f(0.5 / MOST_OFFSET) + f(1)
    steps = numpy.where(steps < LONGEST_STRIDE, steps, f(LONGEST_STRIDE))
    return numpy.where(length > 0, numpy.trunc(steps), f(0)).astype(f)


def means(first, second):
    """Of the codes of both ends of segments, rounded up."""
    return numpy.trunc(f(0.5) * (first + second) + f(0.5)).astype(f)


def offsets(middle, mean, stride):
    """Of codes of middles, NO_PATH where there is none."""
    middle, mean = middle.astype(f), mean.astype(f)
    inverse = numpy.where(stride > 0, f(1) / numpy.maximum(stride, f(1)), f(0)).astype(f)
    most = numpy.minimum(numpy.trunc(mean * inverse), f(MOST_OFFSET))
    return numpy.maximum(numpy.minimum(numpy.trunc((mean - middle) * inverse + f(0.5)), most), f(0))
