"""Answers of the overlay engine, by the part "Distances of the overlay engine" of format/SPEC.md.

All is single precision, as the document has it: f below.
"""

import numpy

from middle_offsets import means, offsets, strides
from raised_middles import raised_middles
from several_sources import SeveralSources

f = numpy.float32
INFINITE = f(numpy.inf)
LARGEST, NO_PATH = 32766, 32767
MOST_LABEL_PLACES, MOST_LABELS = 400, 2
STEPS_OF_LONGEST, MOST_OF_COARSEST, FEW_STEPS = f(124), f(3), f(1000)
SHORT_CHAIN = 48


class Border:
    """The border of a patch and its segments: one from each position, of which NaN lengths are gaps, then bridges."""

    def __init__(self, index, patch):
        self.vertices = index.border[patch]
        size = len(self.vertices)
        has = index.segment_end[patch] != 0xFFFFFFFF
        bridges = index.bridges[patch]
        second = numpy.where(has, index.segment_end[patch], 0).astype(int)
        length = numpy.where(has, index.segment_length[patch], f("nan"))
        self.first = numpy.array([*range(size), *(begin for begin, _, _ in bridges)], int)
        self.second = numpy.array([*second, *(end for _, end, _ in bridges)], int)
        self.length = numpy.array([*length, *(length for _, _, length in bridges)], f)
        self.longest = numpy.max(self.length[~numpy.isnan(self.length)], initial=f(0))
        self.near_segments = min(max(f(10000) / f(index.vertex_count), f(5)), f(20))
        before = numpy.full(size, -1)
        before[second[has]] = numpy.flatnonzero(has)
        after = numpy.where(has, second, -1)
        step = lambda table, at: numpy.where(at >= 0, table[at], -1)
        # Two segments of its chain on each side of each position, by where they begin, or -1.
        self.near = numpy.stack([step(before, before), before, numpy.where(has, numpy.arange(size), -1),
                                 numpy.where(step(after, after) >= 0, after, -1)], axis=1) if size else None

    def reach(self, source):
        """Up to which distance all segments count: of those that begin where the source is known."""
        lengths = self.length[source[self.first] < INFINITE]
        return self.near_segments * numpy.max(lengths[~numpy.isnan(lengths)], initial=f(0))


def root(square, length):
    """Of a square that rounded distances may have made a little too small."""
    least = f(-1 / 32) * (length * length)
    return numpy.where(square < least, f("nan"), numpy.sqrt(numpy.where(square < 0, f(0), square)))


def place(first, second, length):
    """Where a point lies that is so far from the ends of a segment: along it, and off it."""
    along = (first - second) * (first + second) * (f(0.5) / length) + f(0.5) * length
    return along, root((first - along) * (first + along), length)


def straight(border, source, target, segments=None):
    """The straightened ways over segments, all or the given ones, from distances of both sides."""
    at = numpy.arange(len(border.length)) if segments is None else segments
    length = numpy.where(at >= 0, border.length[at], f("nan"))
    rows = None if target.ndim == 1 else numpy.arange(len(target))[:, None]
    of = lambda ends: target[ends] if rows is None else target[rows, ends]
    foot, height = place(source[border.first[at]], source[border.second[at]], length)
    to_foot, to_height = place(of(border.first[at]), of(border.second[at]), length)
    off, along = height + to_height, foot - to_foot
    crossing = foot * to_height + to_foot * height
    passes = (crossing > 0) & (length * off - crossing > 0)
    return numpy.where(passes, numpy.sqrt(along * along + off * off), INFINITE)


def steps_of(distance, nearest, quantum):
    """Rounded distances; what is not reached is more than any sum."""
    scale = f(1) / quantum if quantum > 0 else f(0)
    steps = numpy.minimum((distance - nearest) * scale + f(0.5), f(LARGEST))
    return numpy.where(distance < INFINITE, numpy.trunc(steps), 2 * NO_PATH)


def decoded(codes, quantum):
    return numpy.where(codes < NO_PATH, codes * quantum, INFINITE).astype(f)


def middles(first, second, length):
    return root(f(0.5) * (first * first + second * second) - f(0.25) * (length * length), length)


class OverlayEngine:
    """Overlay tables have a row for each overlay position of a patch, codes as float32, NO_PATH without a path."""

    def __init__(self, index):
        self.index = index
        self.quantum = index.quantum.astype(f)
        self.borders = [Border(index, patch) for patch in range(index.patch_count)]
        clean = lambda table: numpy.where(numpy.isinf(table), f(NO_PATH), table)
        self.tables = [clean(table) for table in index.overlay_table]
        self.leaf_rows = {leaf: clean(index.border_internal[leaf].T) for leaf in index.leaves}
        self.internal = {leaf: clean(index.internal[leaf]) for leaf in index.leaves}
        self.overlays = [index.overlay(patch) for patch in range(index.inner_count)]
        self.position = [{number: i for i, number in enumerate(overlay)} for overlay in self.overlays]
        self.labelled = self.labelled_patches()
        self.labels, self.label_quantum = {}, {}

    decoded = staticmethod(decoded)

    # ---- Hops

    def rows_up(self, patch):
        """From the parent's overlay to the border of a patch."""
        parent = self.index.parent[patch]
        return self.tables[parent][:, [self.position[parent][v] for v in self.borders[patch].vertices]]

    def rows_down(self, patch):
        """From what lies one hop inside of a patch to its border."""
        if patch >= self.index.inner_count:
            return self.leaf_rows[patch]
        border = len(self.borders[patch].vertices)
        return self.tables[patch][border:, :border]

    def over_positions(self, source, rows, quantum):
        """Where sums of codes tell nothing: by distances, over positions only."""
        sums = source[None, :] + decoded(rows, quantum)
        return sums.argmin(axis=1), sums.min(axis=1)

    def cross(self, border, source, rows, quantum):
        """Over the position with the least sum of codes, and the segments next to it: the ways, the positions."""
        if len(source) == 0 or not source.min() < INFINITE:
            return numpy.full(len(rows), INFINITE), numpy.zeros(len(rows), int)
        sums = steps_of(source, source.min(), quantum)[None, :] + rows
        best, known = sums.argmin(axis=1), sums.min(axis=1) < NO_PATH
        if not known.all():
            best[~known] = self.over_positions(source, rows[~known], quantum)[0]
        target = decoded(rows, quantum)
        over = source[best] + target[numpy.arange(len(rows)), best]
        ways = straight(border, source, target, border.near[best]).min(axis=1)
        return self.cross_near(border, source, target, numpy.minimum(over, ways)), best

    def hop_up(self, patch, source, rows, quantum):
        return self.cross(self.borders[patch], source, rows, quantum)[0]

    def hop_to_border(self, patch, source, vertices):
        """From a border to another one in the parent's overlay; vertices that are on both keep their distances."""
        parent = self.index.parent[patch]
        rows = self.rows_up(patch)[[self.position[parent][v] for v in vertices]]
        ways = self.hop_up(patch, source, rows, self.quantum[parent])
        kept = dict(zip(self.borders[patch].vertices.tolist(), source))
        return numpy.array([kept.get(v, way) for v, way in zip(vertices.tolist(), ways)], f)

    def hop_down(self, patch, source):
        """Over positions and the middles of segments."""
        border, rows, quantum = self.borders[patch], self.rows_down(patch), self.quantum[patch]
        if len(source) == 0 or not source.min() < INFINITE:
            return numpy.full(len(rows), INFINITE)
        middle = middles(source[border.first], source[border.second], border.length)
        middle = numpy.where(numpy.isnan(middle), INFINITE, middle)
        nearest = min(source.min(), middle.min())
        over = steps_of(source, nearest, quantum)[None, :] + rows
        across = steps_of(middle, nearest, quantum)[None, :] + self.middle_rows(patch)
        least = numpy.minimum(over.min(axis=1), across.min(axis=1))
        out = nearest + least.astype(f) * quantum
        if not (least < NO_PATH).all():
            lost = least >= NO_PATH
            out[lost] = self.over_positions(source, rows[lost], quantum)[1]
        return self.cross_near(border, source, decoded(rows, quantum), out)

    def middle_rows(self, patch):
        border, rows = self.borders[patch], self.rows_down(patch)
        first, second = rows[:, border.first], rows[:, border.second]
        middle = middles(first, second, border.length / self.quantum[patch])
        reached = (numpy.maximum(first, second) < NO_PATH) & (middle >= 0)
        codes = numpy.where(reached, numpy.trunc(middle + f(0.5)), f(NO_PATH))
        if patch in self.internal:
            longest = border.longest / self.quantum[patch]
            codes = raised_middles(codes, self.internal[patch], longest, NO_PATH)
        stride = strides(border.length, self.quantum[patch])
        mean = means(first, second)
        return numpy.where(stride > 0, mean - offsets(codes, mean, stride) * stride, f(NO_PATH))

    def cross_near(self, border, source, target, ways):
        """Those that are near take the least way over any position or segment."""
        reach = border.reach(source)
        near = ways <= reach
        if source.min() <= reach and near.any():
            least = self.over_all(border, source, target[near])
            ways[near] = numpy.where(least < INFINITE, least, ways[near])
        return ways

    def over_all(self, border, source, target):
        over = (source[None, :] + target).min(axis=1)
        return numpy.minimum(over, straight(border, source, target).min(axis=1))

    # ---- MSAD

    def ways_from(self, source):
        """Numbers, and their distances by the table of the source."""
        index, entry = self.index, int(self.index.entry[source])
        if index.is_border(source):
            numbers, codes = self.overlays[entry], self.tables[entry][self.position[entry][source]]
        else:
            own = source - index.inside[entry].start
            numbers = numpy.concatenate([index.border[entry], numpy.array(index.inside[entry])])
            codes = numpy.concatenate([self.leaf_rows[entry][own], self.internal[entry][own]])
        return numbers, numpy.where(numbers == source, f(0), decoded(codes, self.quantum[entry]))

    def climb(self, patch, distance):
        parent = self.index.parent[patch]
        numbers, inside = self.overlays[parent], self.borders[patch].vertices
        ways = self.hop_up(patch, distance[inside], self.rows_up(patch), self.quantum[parent])
        ways[[self.position[parent][v] for v in inside]] = INFINITE
        distance[numbers] = numpy.minimum(distance[numbers], ways)

    def ssad(self, source):
        index = self.index
        distance = numpy.full(index.vertex_count, INFINITE)
        numbers, ways = self.ways_from(source)
        distance[numbers] = ways
        around = list(index.ways_up(int(index.entry[source])))
        for patch in around[:-1]:
            self.climb(patch, distance)
        for patch in range(1, index.patch_count):
            if patch not in around and len(index.inside[patch]):
                distance[list(index.inside[patch])] = self.hop_down(patch, distance[self.borders[patch].vertices])
        return distance

    def msad(self, sources):
        if len(sources) > 1:
            return self.lowered(SeveralSources(self, sources).msad())
        distance = self.ssad(sources[0])
        for other, measured in self.index.measured.get(sources[0], {}).items():
            distance[other] = measured
        return self.lowered(distance)

    def lowered(self, distance):
        """The field with no steep edge left."""
        ends = list(self.index.steep)
        while ends:
            end = ends.pop()
            for other, most in self.index.steep[end].items():
                if distance[end] + most < distance[other]:
                    distance[other] = distance[end] + most
                    ends.append(other)
        return distance

    # ---- SSSD

    def table_distance(self, patch, a, b):
        position = self.position[patch]
        return decoded(self.tables[patch][position[a], position[b]], self.quantum[patch])

    def from_inside(self, number, patch):
        """Distances of a vertex to the border of a patch around it."""
        index, entry = self.index, int(self.index.entry[number])
        if patch == entry:
            return decoded(self.rows_down(patch)[number - index.inside[patch].start], self.quantum[patch])
        if patch in self.labelled:
            return self.label(number, patch)
        for before in index.ways_up(entry):
            if index.parent[before] == patch:
                break
        return self.hop_to_border(before, self.from_inside(number, before), self.borders[patch].vertices)

    def patches_in(self, patch):
        """Those deeper inside of a patch, parents first."""
        patches = list(self.children_of(patch))
        for child in patches:
            patches += self.children_of(child)
        return patches

    def children_of(self, patch):
        return self.index.children[patch] if patch < self.index.inner_count else []

    def labelled_patches(self):
        """Of the patches around a vertex, but for leaves, the outermost ones whose borders are neither empty nor long."""
        labelled, around = set(), {0: 0}
        for patch in range(1, self.index.inner_count):
            around[patch] = around[self.index.parent[patch]]
            if around[patch] < MOST_LABELS and 0 < len(self.index.places(patch)[0]) <= MOST_LABEL_PLACES:
                labelled.add(patch)
                around[patch] += 1
        return labelled

    def label(self, number, patch):
        """Down from each vertex of the border, rounded so that the longest distance of all has the largest code."""
        if patch not in self.labels:
            self.labels[patch] = self.label_table(patch)
        return self.labels[patch][number]

    def label_table(self, patch):
        index, deeper = self.index, self.patches_in(patch)
        table = numpy.full((len(self.borders[patch].vertices), index.vertex_count), INFINITE)
        for i, distance in enumerate(table):
            distance[self.overlays[patch]] = decoded(self.tables[patch][i], self.quantum[patch])
            for child in deeper:
                distance[list(index.inside[child])] = self.hop_down(child, distance[self.borders[child].vertices])
        numbers = [number for child in deeper for number in index.inside[child]]
        distances = table[:, numbers].T
        longest = numpy.max(distances[distances < INFINITE], initial=f(0))
        quantum = self.label_quantum[patch] = max(longest / f(LARGEST), self.least_quantum(patch))
        return dict(zip(numbers, self.in_steps(distances, quantum)))

    def least_quantum(self, patch):
        """With which the steps along all segments but a few long ones fit into a byte."""
        lengths = numpy.sort(self.borders[patch].length)  # NaN comes last
        count = numpy.count_nonzero(~numpy.isnan(lengths))
        least = lengths[count - 1 - count // 16] / STEPS_OF_LONGEST if count > 0 else f(0)
        return least if least <= MOST_OF_COARSEST * numpy.max(self.quantum) else f(0)

    @staticmethod
    def in_steps(distances, quantum):
        scale = min(f(1) / quantum, numpy.finfo(f).max) if quantum > 0 else f(0)
        codes = numpy.trunc(numpy.minimum(distances * scale + f(0.5), f(LARGEST)))
        codes = numpy.where(distances > 0, numpy.maximum(codes, f(1)), f(0))
        return numpy.where(distances < INFINITE, codes * quantum, INFINITE).astype(f)

    def sssd(self, a, b):
        if a == b:
            return f(0)
        index = self.index
        if b in index.measured.get(a, {}):
            return index.measured[a][b]
        low, high = sorted((a, b))
        around = [list(index.ways_up(int(index.entry[number]))) for number in (low, high)]
        top = max(set(around[0]) & set(around[1]))
        distance = self.over_one_border(low, high, around, top)
        crossed = [patch for way in around for patch in way[:way.index(top)]]
        if any(distance < self.misplaces_ends_up_to(patch) for patch in crossed):
            return min(distance, self.ssad(low)[high])
        return distance

    def misplaces_ends_up_to(self, patch):
        """Four of the longest segment of a border with many short chains; of other borders, no distance."""
        border, places = self.borders[patch], len(self.index.places(patch)[0])
        bridges = len(border.length) - len(border.vertices)
        chains = (places - len(border.vertices) - 2 * bridges) // 4  # each chain repeats four
        return f(4) * border.longest if chains > 1 and places < SHORT_CHAIN * chains else f(0)

    def over_one_border(self, low, high, around, top):
        index = self.index
        if top >= index.inner_count:
            first = index.inside[top].start
            return decoded(self.internal[top][low - first, high - first], self.quantum[top])
        child = [None if way[0] == top else way[way.index(top) - 1] for way in around]
        if child[0] is None and child[1] is None:
            return self.table_distance(top, low, high)
        if child[1] is None:
            low, high, child = high, low, child[::-1]
        if child[0] is None:
            known = self.entry_on_border(low, high)
            if known < INFINITE:
                return known
        distance = self.meet(top, low, child[0], high, child[1])
        quanta = [self.quantum_from_inside(number, patch) for number, patch in zip((low, high), child)]
        if distance >= FEW_STEPS * max(quanta):
            return distance
        labelled, self.labelled = self.labelled, set()
        distance = self.meet(top, low, child[0], high, child[1])
        self.labelled = labelled
        return distance

    def quantum_from_inside(self, number, patch):
        """Of the label that from_inside() takes, or 0."""
        entry = int(self.index.entry[number])
        way = list(self.index.ways_up(entry))
        inside = way[1:way.index(patch) + 1] if patch is not None else []
        labelled = [p for p in inside if p in self.labelled]
        return self.label_quantum[labelled[-1]] if labelled else f(0)

    def entry_on_border(self, low, high):
        """Where `low` is on the border of the innermost patch of `high`, the entry of both."""
        patch = int(self.index.entry[high])
        at = numpy.flatnonzero(self.borders[patch].vertices == low)
        return self.from_inside(high, patch)[at[0]] if at.size else INFINITE

    def meet(self, top, low, low_child, high, patch):
        """Over the border of a child of `top`, the one around `high`; `low` may be in no child."""
        border, target = self.borders[patch], self.from_inside(high, patch)
        if low_child is None:
            source = decoded(self.rows_up(patch)[self.position[top][low]], self.quantum[top])
        else:
            source = self.hop_to_border(low_child, self.from_inside(low, low_child), border.vertices)
        sums = source + target
        return min(sums.min(initial=INFINITE), straight(border, source, target).min(initial=INFINITE))
