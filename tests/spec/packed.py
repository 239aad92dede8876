"""The tables of a packed index: each entry is its prediction and a residual, as format/SPEC.md has it."""

import numpy

FAR_OFF, NO_PATH = -128, 0xFFFF


class PackedTables:
    """The tables of one section, one after the other."""

    def __init__(self, raw, entries, positions, position_step):
        self.near = raw[:entries].view("i1").tolist()
        self.far = raw[entries:].view("<u2").tolist()
        self.positions, self.position_step = positions, float(position_step)
        self.at = self.at_far = 0

    def lines(self, rows, cols, quantum):
        """The straight lines between the vertices, in sixteenths of a code."""
        scale = min(16 * self.position_step / float(quantum), 1e9) if quantum > 0 else 0.0
        apart = self.positions[rows][:, None, :] - self.positions[cols][None, :, :]
        square = (apart * apart).sum(axis=2).astype("f8")
        return numpy.minimum(numpy.sqrt(square) * scale + 0.5, 16 * 32767).astype(int)

    def table(self, rows, cols, quantum, shift, is_triangle=False):
        """A matrix of codes; of a triangle, the entries below the diagonal and zeros."""
        line = self.lines(rows, cols, quantum).tolist()
        codes = numpy.zeros((len(rows), len(cols)), "f4")
        above = None
        for i in range(len(rows)):
            beyond = []  # by how much the entries of the row are longer than the straight line
            for j in range(i if is_triangle else len(cols)):
                expected = self.expected(beyond, above, j)
                steps = self.next_entry((line[i][j] + expected + (8 << shift)) // (16 << shift))
                codes[i, j] = numpy.inf if steps is None else steps << shift
                beyond.append(0 if steps is None else (steps << shift) * 16 - line[i][j])
            above = beyond + [0] if is_triangle else beyond
        return codes

    @staticmethod
    def expected(beyond, above, j):
        if above is None:
            return beyond[j - 1] if j else 0
        return beyond[j - 1] + above[j] - above[j - 1] if j else above[0]

    def next_entry(self, predicted):
        residual = self.near[self.at]
        self.at += 1
        if residual != FAR_OFF:
            return predicted + residual
        steps = self.far[self.at_far]
        self.at_far += 1
        return None if steps == NO_PATH else steps

    def require_end(self):
        assert self.at == len(self.near) and self.at_far == len(self.far), "residuals are left over"
