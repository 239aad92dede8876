"""MSAD of several sources with the overlay engine: one sweep for all of them, by format/SPEC.md."""

import numpy

INFINITE = numpy.float32(numpy.inf)
NEAREST_SOURCES, SEGMENTS = 32, 6


class SeveralSources:
    def __init__(self, engine, sources):
        self.engine, self.index, self.sources = engine, engine.index, sources
        self.distance = numpy.full(self.index.vertex_count, INFINITE)
        self.around = {source: set(self.index.ways_up(int(self.index.entry[source]))) for source in sources}
        # Per border vertex: the distances from sources, and the longest segment of its borders.
        self.known = [{} for _ in range(self.index.border_vertex_count)]
        self.longest = numpy.zeros(self.index.border_vertex_count, INFINITE.dtype)
        for border in engine.borders:
            if len(border.vertices):
                self.longest[border.vertices] = numpy.maximum(self.longest[border.vertices], border.longest)

    def msad(self):
        for source in self.sources:
            self.take(*self.engine.ways_from(source), source)
        inside = [sum(patch in around for around in self.around.values()) for patch in range(self.index.patch_count)]
        for patch in range(self.index.patch_count - 1, 0, -1):
            if inside[patch]:
                self.climb(patch)
        for patch in range(1, self.index.patch_count):
            if inside[patch] < len(self.sources) and len(self.index.inside[patch]):
                self.descend(patch)
        self.take_measured()
        return self.distance

    def measured(self, source):
        return self.index.measured.get(source, {})

    def take_measured(self):
        for number in {n for source in self.sources for n in self.measured(source) if self.index.is_border(n)}:
            self.distance[number] = min((self.measured(source).get(number, distance)
                                         for source, distance in self.kept(number).items()), default=INFINITE)
        for source in self.sources:
            for number, distance in self.measured(source).items():
                self.distance[number] = min(self.distance[number], distance)

    def take(self, numbers, distances, source):
        measured = self.measured(source)
        if measured:
            distances = numpy.array([distance if self.index.is_border(number) else measured.get(number, distance)
                                     for number, distance in zip(numbers.tolist(), distances)], INFINITE.dtype)
        self.distance[numbers] = numpy.minimum(self.distance[numbers], distances)
        for number, distance in zip(numbers, distances):
            if self.index.is_border(number) and distance < INFINITE:
                self.known[number][source] = min(distance, self.known[number].get(source, INFINITE))

    def kept(self, vertex):
        known = self.known[vertex]
        if len(known) <= NEAREST_SOURCES:
            return known
        nearest = sorted(known, key=lambda source: (known[source], source))
        farthest = known[nearest[0]] + SEGMENTS * self.longest[vertex]
        return {source: known[source] for rank, source in enumerate(nearest)
                if rank < NEAREST_SOURCES or known[source] <= farthest}

    def hops(self, patch, are_inside):
        """Each source that may be the nearest one on a border, from that side, with its own distances there."""
        border = self.engine.borders[patch]
        lists = [self.kept(vertex) for vertex in border.vertices]
        may_be_nearest = {source for known in lists for source, distance in known.items()
                          if distance <= min(known.values()) + border.longest}
        for source in sorted(may_be_nearest):
            if (patch in self.around[source]) == are_inside:
                yield source, numpy.array([known.get(source, INFINITE) for known in lists], INFINITE.dtype)

    def climb(self, patch):
        engine, parent = self.engine, self.index.parent[patch]
        on_border = [engine.position[parent][vertex] for vertex in engine.borders[patch].vertices]
        for source, distances in self.hops(patch, True):
            ways = engine.hop_up(patch, distances, engine.rows_up(patch), engine.quantum[parent])
            ways[on_border] = INFINITE
            self.take(engine.overlays[parent], ways, source)

    def descend(self, patch):
        numbers = numpy.array(self.index.inside[patch])
        for source, distances in self.hops(patch, False):
            self.take(numbers, self.engine.hop_down(patch, distances), source)
