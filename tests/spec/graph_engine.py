"""Answers of the graph engine, by the part "Distances of the graph engine" of format/SPEC.md, in double precision."""

import numpy


def lower(distance, numbers, others, table):
    """Lowers the distances of `numbers` over those of `others`; says whether any was."""
    if len(numbers) == 0 or len(others) == 0:
        return False
    ways = (distance[others][None, :] + table).min(axis=1)
    is_lower = ways < distance[numbers]
    distance[numbers] = numpy.minimum(distance[numbers], ways)
    return bool(is_lower.any())


class GraphEngine:
    def __init__(self, index):
        self.index = index

    def _around(self, number):
        return list(self.index.ways_up(self._entry_patch(number)))

    def _entry_patch(self, number):
        entry = int(self.index.entry[number])
        return entry if self.index.is_border(number) else self.index.parent[entry]

    def _leave(self, source, distance):
        index, leaf = self.index, int(self.index.entry[source])
        own = source - index.inside[leaf].start
        distance[source] = 0
        for numbers, ways in (
            (index.border[leaf], index.border_internal[leaf][:, own]),
            (numpy.array(index.inside[leaf]), index.internal[leaf][:, own]),
        ):
            distance[numbers] = numpy.minimum(distance[numbers], ways)

    def _cross(self, patches, distance, others=()):
        """To the lengths of shortest paths over the border tables of all children of these patches, and of others."""
        children = [child for patch in patches for child in self.index.children[patch]]
        borders = [(self.index.border[patch], self.index.border_table[patch]) for patch in [*children, *others]]
        while any([lower(distance, border, border, table) for border, table in borders]):
            pass

    def msad(self, sources):
        index = self.index
        distance = numpy.full(index.vertex_count, numpy.inf)
        distance[list(sources)] = 0
        marked = set()
        for source in sources:
            if not index.is_border(source):
                self._leave(source, distance)
            marked.update(self._around(source))
        for patch in sorted(marked, reverse=True):
            self._cross([patch], distance)
        for patch in range(1, index.inner_count):
            self._cross([patch], distance)
        for leaf in index.leaves:
            lower(distance, numpy.array(index.inside[leaf], int), index.border[leaf], index.border_internal[leaf].T)
        return distance

    def _in_one_table(self, a, b):
        index = self.index
        for patch in range(1, index.patch_count):
            at = [numpy.flatnonzero(index.border[patch] == number) for number in (a, b)]
            if at[0].size and at[1].size:
                return index.border_table[patch][at[0][0], at[1][0]]
        if index.is_border(a):
            a, b = b, a
        leaf = int(index.entry[a])
        if index.is_border(a):
            return None
        first = index.inside[leaf].start
        if b in index.inside[leaf]:
            return index.internal[leaf][a - first, b - first]
        at = numpy.flatnonzero(index.border[leaf] == b)
        return index.border_internal[leaf][at[0], a - first] if at.size else None

    def sssd(self, a, b):
        if a == b:
            return 0.0
        direct = self._in_one_table(a, b)
        if direct is not None:
            return float(direct)
        ways = [self._around(number) for number in (a, b)]
        common = max(set(ways[0]) & set(ways[1]))
        allowed = {patch for way in ways for patch in way if patch >= common}
        distance = numpy.full(self.index.vertex_count, numpy.inf)
        distance[a] = 0
        if not self.index.is_border(a):
            self._leave(a, distance)
        self._cross(sorted(allowed), distance, [common] if common else [])
        if self.index.is_border(b):
            return float(distance[b])
        leaf = int(self.index.entry[b])
        ways = self.index.border_internal[leaf][:, b - self.index.inside[leaf].start]
        return float((distance[self.index.border[leaf]] + ways).min(initial=numpy.inf))
