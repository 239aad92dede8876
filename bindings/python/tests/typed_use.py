"""What a type checker must understand of the installed package; it is not run."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import geoidx


def progress(fraction: float, stage: str) -> bool:
    return fraction < 0.5


def taxicab(source: int, targets: NDArray[np.uint32]) -> NDArray[np.float64]:
    return np.zeros(len(targets))


def ask(vertices: NDArray[np.float32], faces: NDArray[np.int64]) -> None:
    with geoidx.Index.build(vertices, faces, metric=taxicab, patches=[4, 3], progress=progress) as index:
        distance: float = index.sssd(0, np.int64(1))
        distances: NDArray[np.float32] = index.sssd(faces[:, 0], faces[:, 1])
        distances = index.sssd(0, range(9))
        distances = index.sssd([[0], [1]], 0)
        field: NDArray[np.float32] = index.msad([0, 1], radius=2 * distance)
        index.ssad(3, out=field)
        distances = index.matrix(faces[0], [0, 1], out=index.matrix([0, 1, 2]))
        owners: NDArray[np.uint32] = index.nearest([0, 1], out=field)
        owners = owners[owners != geoidx.NO_SOURCE]
        ids, distances = index.within([0, 1], 2 * distance)
        order, distances = index.nearest_targets(0, ids, np.int64(3))
        with index.query(threads=2) as query:
            query.prepare(3)
            distance = query.prepared(2)
            distances = query.prepared(faces)
            distances = query.prepared(2, out=np.empty((), np.float32))
            surface = geoidx.Surface(vertices, faces, weld_tolerance=0.5)
            surface = index.surface() if index.info.has_mesh else surface
            corner: NDArray[np.void] = surface.vertex_point(np.int64(3))
            distance = query.point_sssd(surface, corner, corner)
            foot, height = surface.closest_point([1, 2, 3.5])
            way: geoidx.Path | None = query.path(surface, foot, foot, quality="exact")
            if way is not None:
                distances = query.point_msad(surface, way.points, offsets=[height])
            query.prepare_target(surface, foot)
            step: geoidx.Step | None = query.next_step(surface, foot)
            if step is not None:
                height = step.distance
                ends: NDArray[np.float64] = step.positions
                step = query.next_step(surface, step.points[1:])
                print(ends)
            distances = query.matrix(ids, order)
            owners = query.nearest(3)
            ids, distances = query.within(3, 1)
            order, distances = query.nearest_targets(3, faces[:, 0], 2)
            chosen: NDArray[np.uint32] = query.farthest_points(3, sources=[0])
            distances = query.prepared(chosen)
        diagonal: float = index.info.bounding_box_diagonal
        counts: tuple[int, ...] = index.info.patch_count
        index.save("index.geoidx", codec=geoidx.Codec.LOSSLESS)
        data: bytes = index.to_bytes(codec="packed")
        codec: geoidx.Codec = index.info.codec
        geoidx.Index.open("index.geoidx", max_vertices=len(vertices), max_memory=1 << 30).close()
        geoidx.Index.from_bytes(data, max_memory=1 << 30, borrow=True, labels=False).close()
        sections: tuple[geoidx.Section, ...] = index.sections
    solver = geoidx.Solver(vertices, faces, metric=geoidx.Weighted(np.ones(len(faces))))
    exact: NDArray[np.float64] = solver.distances(0)
    point: Any = geoidx.surface_points(0, [1, 0, 0])
    solver.point_distances(point, point)
    issues: list[geoidx.Issue] = geoidx.verify("index.geoidx", most=1)
    print(distances, diagonal, counts, data, codec, sections, exact, issues)


def status(error: geoidx.Error) -> int:
    return error.status
