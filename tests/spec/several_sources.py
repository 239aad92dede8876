"""MSAD of several sources with the overlay engine: one sweep for all of them, by format/SPEC.md."""

import numpy

INFINITE = numpy.float32(numpy.inf)
NO_SOURCE = -1


class SeveralSources:
    def __init__(self, engine, sources):
        self.engine, self.index, self.sources = engine, engine.index, sources
        self.distance = numpy.full(self.index.vertex_count, INFINITE)
        self.nearest = numpy.full(self.index.vertex_count, NO_SOURCE)
        self.around = {source: set(self.index.ways_up(int(self.index.entry[source]))) for source in sources}
        # Per patch, of each source near its border: its own distances there.
        self.known = [{} for _ in range(self.index.patch_count)]
        self.borders_of = [[] for _ in range(self.index.border_vertex_count)]
        for patch, border in enumerate(self.index.border):
            for position, number in enumerate(border):
                self.borders_of[number].append((patch, position))

    def msad(self):
        ways = [(source, *self.engine.ways_from(source)) for source in self.sources]
        for source, numbers, distances in ways:
            self.lower(numbers, distances, numpy.full(len(numbers), source))
        for source, numbers, distances in ways:
            self.note(numbers, distances, numpy.full(len(numbers), source), self.distance[numbers])
        inside = [sum(patch in around for around in self.around.values()) for patch in range(self.index.patch_count)]
        for patch in range(self.index.patch_count - 1, 0, -1):
            if inside[patch]:
                self.climb(patch)
        for patch in range(1, self.index.patch_count):
            if inside[patch] < len(self.sources) and len(self.index.inside[patch]):
                self.descend(patch)
        return self.distance

    def lower(self, numbers, distances, sources):
        lower = distances < self.distance[numbers]
        self.distance[numbers[lower]] = distances[lower]
        self.nearest[numbers[lower]] = sources[lower]

    def note(self, numbers, distances, sources, least):
        """Keeps the distances of single sources to border vertices next to them."""
        for number, distance, source, other in zip(numbers, distances, sources, least):
            if not self.index.is_border(number) or not distance < INFINITE:
                continue
            for patch, position in self.borders_of[number]:
                segment = self.engine.borders[patch].longest
                if distance <= min(5 * segment, other + 2 * segment):
                    own = self.known[patch].setdefault(source, {})
                    own[position] = min(distance, own.get(position, INFINITE))

    def read_border(self, patch):
        border = self.engine.borders[patch]
        source = self.distance[border.vertices]
        nearest = numpy.where(source < INFINITE, self.nearest[border.vertices], NO_SOURCE)
        several = len(set(nearest[source < INFINITE])) > 1
        return border.with_gaps(nearest) if several else border, source, nearest, several

    def climb(self, patch):
        engine, parent = self.engine, self.index.parent[patch]
        border, source, nearest, several = self.read_border(patch)
        if len(source) == 0 or not source.min() < INFINITE:
            return
        rows = engine.rows_up(patch)
        ways, best = engine.cross(border, source, rows, engine.quantum[parent])
        ways[[engine.position[parent][v] for v in border.vertices]] = INFINITE
        target = (engine.overlays[parent], rows, engine.quantum[parent])
        self.finish(patch, True, target, ways, numpy.where(ways < INFINITE, nearest[best], NO_SOURCE), several)

    def descend(self, patch):
        engine = self.engine
        border, source, nearest, several = self.read_border(patch)
        if len(source) == 0 or not source.min() < INFINITE:
            return
        rows = engine.rows_down(patch)
        if several and patch < self.index.inner_count:
            ways, best = engine.cross(border, source, rows, engine.quantum[patch])
            sources = nearest[best]
        else:
            ways = engine.hop_down(patch, source, border)
            sources = numpy.full(len(rows), max(nearest))
        target = (numpy.array(self.index.inside[patch]), rows, engine.quantum[patch])
        self.finish(patch, False, target, ways, sources, several)

    def finish(self, patch, from_inside, target, ways, sources, several):
        if several:
            self.cross_from_each(patch, from_inside, target, ways, sources)
        else:
            self.note(target[0], ways, sources, ways)
        self.lower(target[0], ways, sources)

    def cross_from_each(self, patch, from_inside, target, ways, sources):
        """Straight over the border from each source next to it, wherever it is not the nearest one, too."""
        numbers, codes, quantum = target
        border = self.engine.borders[patch]
        for source, known in sorted(self.known[patch].items()):
            is_nearest = any(self.nearest[border.vertices[position]] == source for position in known)
            if (patch in self.around[source]) != from_inside or not is_nearest:
                continue
            own = numpy.full(len(border.vertices), INFINITE)
            own[list(known)] = list(known.values())
            reach = border.reach(own)
            if own.min() > reach:
                continue
            found = self.engine.over_all(border, own, self.engine.decoded(codes, quantum))
            found[ways > reach] = INFINITE
            self.note(numbers, found, numpy.full(len(found), source), ways)
            lower = found < ways
            ways[lower], sources[lower] = found[lower], source
