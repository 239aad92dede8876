#!/usr/bin/env python3
"""Draws overlay.svg, the figure of overlay.md: a path through the levels of the hierarchy.

Usage: python3 docs/draw_overlay.py > docs/overlay.svg
"""

import math

WIDTH, HEIGHT = 1060, 800
GREY, BLUE, RED, ORANGE, GREEN, INK = "#b9bec8", "#7c9cc9", "#b3261e", "#d77a00", "#1c7c3c", "#20242c"

# Corners of the leaves: three patches of level 1, two by two leaves in each.
COLUMNS = [60, 205, 360, 535, 700, 855, 1000]
ROWS = [70, 215, 350]
STEPS = 5  # edges along one side of a leaf

parts = []


def add(text):
    parts.append(text)


def wobble(i, j):
    """A fixed shift of a border vertex, so that borders are as jagged as those of a mesh."""
    return 7 * math.sin(12.9898 * i + 78.233 * j), 7 * math.sin(39.346 * i + 11.135 * j)


def corner(column, row):
    x, y = COLUMNS[column], ROWS[row]
    dx, dy = wobble(column + 1, row + 5)
    return x + dx, y + dy


def side(first, second):
    """The vertices of a border between two corners."""
    (x0, y0), (x1, y1) = corner(*first), corner(*second)
    points = [(x0, y0)]
    for k in range(1, STEPS):
        dx, dy = wobble(10 * first[0] + k, 10 * first[1] + 3 * second[0] + k)
        points.append((x0 + (x1 - x0) * k / STEPS + dx, y0 + (y1 - y0) * k / STEPS + dy))
    return points + [(x1, y1)]


def along(*corners):
    points = []
    for first, second in zip(corners, corners[1:]):
        points += side(first, second)[1 if points else 0:]
    return points


def polyline(points, color, width, dots=0.0, dash=""):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    add(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"'
        f' stroke-linejoin="round"{dash}/>')
    if dots:
        for x, y in points:
            add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{dots}" fill="{color}"/>')


def text(x, y, words, size=15, color=INK, anchor="start", weight="normal"):
    add(f'<text x="{x}" y="{y}" font-size="{size}" fill="{color}" text-anchor="{anchor}"'
        f' font-weight="{weight}">{words}</text>')


def number(x, y, n):
    add(f'<circle cx="{x}" cy="{y}" r="12" fill="#ffffff" stroke="{GREEN}" stroke-width="2"/>')
    text(x, y + 5, n, 14, GREEN, "middle", "bold")


def meeting(points, line):
    """The point where a path crosses a border."""
    for a, b in zip(points, points[1:]):
        for c, d in zip(line, line[1:]):
            det = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
            if det == 0:
                continue
            s = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / det
            t = ((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) / det
            if 0 <= s <= 1 and 0 <= t <= 1:
                return a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])
    raise ValueError("the path does not cross that border")


def surface():
    outline = along((0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (5, 0), (6, 0), (6, 1), (6, 2), (5, 2), (4, 2),
                    (3, 2), (2, 2), (1, 2), (0, 2), (0, 1), (0, 0))
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in outline)
    add(f'<polygon points="{path}" fill="#f6f7f9" stroke="{GREY}" stroke-width="1.5"/>')
    # Leaf borders, then those of level 1, then the four that the path passes.
    for column in (1, 3, 5):
        polyline(along((column, 0), (column, 1), (column, 2)), BLUE, 1.2, 1.8)
    polyline(along(*((column, 1) for column in range(7))), BLUE, 1.2, 1.8)
    of_a = along((0, 1), (1, 1), (1, 2))
    of_b = along((5, 0), (5, 1), (6, 1))
    of_p, of_q = along((2, 0), (2, 1), (2, 2)), along((4, 0), (4, 1), (4, 2))
    for line in (of_a, of_b):
        polyline(line, ORANGE, 2.4, 3)
    for line in (of_p, of_q):
        polyline(line, RED, 3.2, 3.4)

    s, t = (118, 300), (945, 125)
    path = [s, (300, 268), (520, 222), (760, 160), t]
    polyline(path, GREEN, 2.6)
    crossings = [meeting(path, line) for line in (of_a, of_p, of_q, of_b)]
    for x, y in crossings:
        add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.6" fill="#ffffff" stroke="{GREEN}" stroke-width="2.2"/>')
    for (x, y), name, shift in ((s, "s", -16), (t, "t", 16)):
        add(f'<circle cx="{x}" cy="{y}" r="5" fill="{GREEN}"/>')
        text(x + shift, y + 5, name, 18, GREEN, "middle", "bold")
    for n, (x, y) in enumerate([(163, 292), (291, 270), (467, 233), (786, 155), (905, 132)], 1):
        number(x, y, n)

    text(75, 44, "patch P (level 1)", 15, RED)
    text(452, 44, "patch R (level 1)", 15, RED)
    text(780, 44, "patch Q (level 1)", 15, RED)
    text(88, 335, "leaf A", 15, ORANGE)
    text(925, 170, "leaf B", 15, ORANGE)
    for x, y, words, color in ((213, 375, "B(A)", ORANGE), (362, 375, "B(P)", RED), (700, 375, "B(Q)", RED),
                               (965, 236, "B(B)", ORANGE)):
        text(x, y, words, 15, color, "middle", "bold")


def arrow(x0, y0, x1, y1, bend=0):
    middle_x, middle_y = (x0 + x1) / 2, (y0 + y1) / 2 - bend
    add(f'<path d="M {x0} {y0} Q {middle_x} {middle_y} {x1} {y1}" fill="none" stroke="{GREEN}"'
        ' stroke-width="2.4" marker-end="url(#head)"/>')


def box(x, y, words, color):
    add(f'<rect x="{x - 36}" y="{y - 17}" width="72" height="34" rx="7" fill="#ffffff" stroke="{color}"'
        ' stroke-width="2"/>')
    text(x, y + 6, words, 16, color, "middle", "bold")


def label(x, y, heading, lines, anchor):
    text(x, y, heading, 15, GREEN, anchor, "bold")
    for k, words in enumerate(lines, 1):
        text(x, y + 19 * k, words, 14, INK, anchor)


def ladder():
    levels = ((455, "level 0: the whole mesh"), (550, "level 1: borders of P and Q"),
              (660, "level 2: borders of leaves"), (765, "inside of leaves"))
    for y, words in levels:
        add(f'<line x1="40" y1="{y}" x2="1020" y2="{y}" stroke="#e3e6eb" stroke-width="1.5"/>')
        text(40, y - 7, words, 13, "#6b7280")
    arrow(372, 745, 402, 682)
    arrow(412, 641, 428, 572)
    arrow(474, 540, 586, 540, 96)
    arrow(632, 569, 648, 636)
    arrow(658, 679, 688, 743)
    box(364, 765, "s", GREEN)
    box(408, 660, "B(A)", ORANGE)
    box(434, 550, "B(P)", RED)
    box(626, 550, "B(Q)", RED)
    box(652, 660, "B(B)", ORANGE)
    box(696, 765, "t", GREEN)
    number(366, 710, 1)
    number(396, 607, 2)
    number(530, 492, 3)
    number(664, 607, 4)
    number(694, 710, 5)
    label(344, 705, "start: read a row", ["border-internal table of leaf A"], "end")
    label(374, 592, "hop up", ["rows B(A)", "of the overlay table of P"], "end")
    label(552, 478, "hop across", ["rows B(P) of the root's overlay table"], "start")
    label(686, 592, "hop down, with middles", ["inner table of Q: owned x border", "of the overlay table of Q"],
          "start")
    label(716, 705, "hop down, with middles", ["border-internal table of leaf B"], "start")


def main():
    add(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}"'
        f' height="{HEIGHT}" font-family="DejaVu Sans, Verdana, sans-serif">')
    add("<title>A path from s to t through the levels of the hierarchy</title>")
    add(f'<defs><marker id="head" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="6" markerHeight="6"'
        f' orient="auto"><path d="M 0 0 L 10 5 L 0 10 z" fill="{GREEN}"/></marker></defs>')
    add(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>')
    surface()
    ladder()
    add("</svg>")
    print("\n".join(parts))


if __name__ == "__main__":
    main()
