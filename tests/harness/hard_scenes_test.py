#!/usr/bin/env python3
"""Tests pairs of scenes that make builders or colliders of others wrong or endless, against a comparison of every two boxes in NumPy."""
import pathlib
import sys
from collections.abc import Iterable

import numpy
from program import ALL_CASES, expect, main, valid

CORNER = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
BUILDERS = ["karras", "apetrei-fused", "hploc", "oibvh-multi", "oibvh-wide4"]
COLLIDERS = ["leaf", "bvtt", "group", "block", "grid", "front-leaf", "embree", "fcl"]
ORDERS = ["hilbert30"]
if ALL_CASES:
    BUILDERS += ["perfect", "lbvh-levels", "oibvh-single", "apetrei", "oibvh-single-printed", "oibvh-wide8", "oibvh-host", "median-split",
                 "sah-binned"]
    ORDERS += ["morton30", "hilbert63", "morton63", "kd"]


def choose(count: int) -> int:
    return count * (count - 1) // 2


def copies(count: int, at: tuple[float, float, float] = (0, 0, 0), size: float = 1) -> list[numpy.ndarray]:
    return [numpy.array(at) + size * CORNER] * count


def scenes() -> dict[str, tuple[list[numpy.ndarray], int | None]]:
    """Returns the triangles of each scene, and its number of pairs where that is known without counting."""
    draw = numpy.random.default_rng(7)
    sizes = [2.0 ** -(k % 40) * (1 + k / 1000) for k in range(129)]
    clusters = [numpy.array(at) + 1e-4 * (k % 17 + 1) * CORNER for at in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 1)) for k in range(50)]
    draw.shuffle(clusters)
    flat = [numpy.pad(draw.random((1, 2)) + 0.05 * draw.random((3, 2)), ((0, 0), (0, 1))) for _ in range(400)]
    return {
        "one": (copies(1), 0),
        "two": (copies(2), 1),
        "three": ([CORNER, CORNER + 0.5, CORNER + 5], 0),
        "touching": ([CORNER + (k, 0, 0) for k in range(100)], 99),
        "copies": (copies(150), choose(150)),
        "copies of several sizes": (copies(90) + copies(60, (9, 9, 9), 1e-3), choose(90) + choose(60)),
        "one centre, apart": ([(CORNER - 0.5) * size for size in sizes], 0),
        "one centre, nested": ([(CORNER - (0.5, 0.5, 0)) * size for size in sizes], choose(129)),
        "deep": ([2.0 ** -(k // 3) * (CORNER / 8 + numpy.eye(3)[k % 3]) for k in range(126)], 0),
        "clusters": (clusters, 4 * choose(50)),
        "in a plane": (flat, None),
        "in a plane across": ([triangle[:, [2, 0, 1]] for triangle in flat], None),
        "on a line": ([numpy.array([[x, 0, 0], [x + 0.01, 0, 0], [x + 0.02, 0, 0]]) for x in draw.random(250)], None),
        "points": ([numpy.tile(draw.integers(0, 4, 3), (3, 1)) for _ in range(200)], None),
        "far": ([(1e7, -1e7, 1e7) + draw.integers(0, 15, 3) + CORNER * draw.integers(1, 4) for _ in range(200)], None),
        "denormal": ([(draw.integers(0, 60, 3) + CORNER * draw.integers(1, 30)) * 1.4e-45 for _ in range(200)], None),
        "huge": ([CORNER * 3e38, *(3 * draw.random(3) + CORNER for _ in range(120))], 0),
        "outlier": ([(1e9, 1e9, 1e9) + CORNER, *(9 * draw.random(3) + CORNER for _ in range(250))], 0),
        "below zero": ([-draw.random(3) + CORNER * (1, -1, -0.0) for _ in range(200)], 0),
    }


def written(name: str, triangles: Iterable[numpy.ndarray]) -> numpy.ndarray:
    """Writes an OBJ file and returns the triangles as they are read again."""
    single = numpy.array(list(triangles)).astype(numpy.float32)
    lines = ["v " + " ".join(repr(float(x)) for x in point) for point in single.reshape(-1, 3)]
    lines += [f"f {k} {k + 1} {k + 2}" for k in range(1, 3 * len(single), 3)]
    pathlib.Path(name).write_text("\n".join(lines) + "\n")
    return single


def pairs_of(triangles: numpy.ndarray) -> set[tuple[int, int]]:
    low, high = triangles.min(1), triangles.max(1)
    found = numpy.all((low[:, None] <= high[None]) & (low[None] <= high[:, None]), axis=2)
    return {(int(a), int(b)) for a, b in zip(*numpy.nonzero(found)) if a < b}


def test_every_pipeline_finds_the_pairs_of_every_two_boxes():
    lists = [set(line.split()[0] for line in expect(0, "list", what).splitlines()) for what in ("builders", "colliders")]
    assert lists[0].issuperset(BUILDERS) and lists[1].issuperset(COLLIDERS)
    for name, (triangles, count) in scenes().items():
        file = name.replace(" ", "-") + ".obj"
        wanted = pairs_of(written(file, triangles))
        assert count in (None, len(wanted)), (name, len(wanted))
        one = ("--scene", file, "--samples", "1", "--force")
        expect(0, "collide", "--builder", ",".join(BUILDERS), "--collider", ",".join(COLLIDERS), "--order", ",".join(ORDERS), *one,
               "--json", "r.json")
        cells = valid("r.json")["cells"]
        measured = [cell for cell in cells if cell["status"] == "measured"]
        assert len(measured) >= 3 * len(BUILDERS) * len(ORDERS), (name, len(measured))
        for cell in measured:
            assert cell["check"]["verdict"] == "agrees" and cell["counters"]["pairs_count"] == len(wanted), (name, cell)
        failed = {cell["collider"]["name"]: cell["reason"] for cell in cells if cell["status"] == "failed"}
        assert failed.keys() <= ({"embree"} if name == "huge" else set()), failed
        if count is not None and not ALL_CASES:
            continue
        expect(0, "collide", "--builder", BUILDERS[-1], "--collider", "leaf", *one, "--pairs", "p.csv")
        lines = pathlib.Path("p.csv").read_text().splitlines()[1:]
        listed = [tuple(sorted(map(int, line.split(",")[-2:]))) for line in lines]
        assert len(listed) == len(wanted) and set(listed) == wanted, name


def test_triangles_that_move_in_their_plane_have_all_their_impacts():
    """All points stay in one plane, so the volume that they span, whose zeros are the times of contact, is always zero."""
    draw = numpy.random.default_rng(3)
    first = numpy.pad(draw.random((8, 3, 2)), ((0, 0), (0, 0), (0, 1)))
    second = first + numpy.pad(draw.random((8, 1, 2)) - 0.5, ((0, 0), (0, 0), (0, 1)))
    for folder, turned in (("flat", [0, 1, 2]), ("upright", [2, 0, 1])):
        pathlib.Path(folder).mkdir()
        for number, frame in enumerate((first, second)):
            written(f"{folder}/f{number}.obj", frame[:, :, turned])
        expect(0, "collide", "--swept", "--narrow", "ccd-1e-4", "--pairs-of", "within", "--adjacent", "drop", "--builder", "oibvh-single",
               "--collider", "leaf", "--scene", folder, "--samples", "1", "--json", "r.json", "--force")
        for cell in valid("r.json")["cells"]:
            assert cell["check"]["verdict"] == "counted" and cell["counters"]["missed_count"] == 0, cell
            assert cell["counters"]["contacts_count"] > 0, cell


sys.exit(main(globals()))
