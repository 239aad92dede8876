"""Meshes whose distances have a closed form, and some that have none."""

import itertools
import math

import numpy as np

SQUARE = (
    np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float64),
    np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
)


def plane(columns, rows):
    """A flat rectangle of columns x rows vertices, one unit apart: distances are straight."""
    y, x = np.mgrid[:rows, :columns]
    vertices = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1).astype(np.float64)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + columns + 1], axis=1)
    upper = np.stack([corner, corner + columns + 1, corner + columns], axis=1)
    return vertices, np.concatenate([lower, upper]).astype(np.uint32)


def straight(vertices, a, b):
    return np.linalg.norm(vertices[a] - vertices[b], axis=-1)


def hills(columns, rows):
    """A plane lifted into hills: no closed form."""
    vertices, faces = plane(columns, rows)
    vertices[:, 2] = 1.5 * np.sin(0.7 * vertices[:, 0]) * np.cos(0.45 * vertices[:, 1])
    return vertices, faces


def cube():
    """The unit cube; vertex 4 x + 2 y + z is at (x, y, z). Faces 2 k and 2 k + 1 are a side."""
    vertices = np.array(list(itertools.product([0, 1], repeat=3)), np.float64)
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]
    return vertices, np.array(faces, np.uint32)


def cone(corners, height):
    """A pyramid with its apex at vertex `corners`, over a regular polygon on the unit circle, without a base."""
    angles = 2 * math.pi * np.arange(corners) / corners
    rim = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    vertices = np.concatenate([rim, [[0, 0, height]]])
    first = np.arange(corners)
    return vertices, np.stack([first, (first + 1) % corners, 0 * first + corners], axis=1).astype(np.uint32)


def rim_distance(corners, height, steps):
    """Between rim vertices of a cone: straight in the unfolded side, or by the apex where that is no detour."""
    slant = math.hypot(1, height)
    unfolded = 2 * math.asin(math.sin(math.pi / corners) / slant) * min(steps, corners - steps)
    return 2 * slant * math.sin(min(unfolded, math.pi) / 2)
