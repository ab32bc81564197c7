from collections.abc import Iterator, Sequence

from cells import Cell, grouped
from headlines import spread, told
from quotes import ONE_SET, Document, File

KINDS = ("hot", "cold", "host")
SCENES = ("torus:144046", "torus:2880000", "torus:16777216", "happy_buddha_1087716", "unc_cloth_ball")
TREES = {"`morton30`": "oibvh-single", "`hilbert30`, sorted leaves": "oibvh-single, hilbert30, sorted leaves"}
PAIRS = {"`morton30`": "block over oibvh-single",
         "`hilbert30`, sorted leaves": "block over oibvh-single (hilbert30, sorted leaves)"}


def kinds(cells: Sequence[Cell]) -> Iterator[str]:
    of = grouped(cells, lambda cell: cell.caches)
    return (told(of[kind], kind == "host") for kind in KINDS)


def cells_of(file: File, scene: str, asked: str) -> list[Cell]:
    words = {"hot": "", "cold": ", cold caches", "host": ", from host to host"}
    return [cell for kind in KINDS for cell in file.frames(scene, asked + words[kind])]


def quotes(doc: Document) -> None:
    file = File("h200/headlines")
    every: list[list[Cell]] = []
    for heading, asked, suffix in (("## Triangles to tree", TREES, ""), ("## Triangles to written pairs", PAIRS, ONE_SET)):
        doc.under(heading)
        for scene in SCENES:
            for label, name in asked.items():
                every.append(cells_of(file, scene + suffix, name))
                doc.row(f"{scene} | {label}", *kinds(every[-1]))
    copied = cells_of(file, SCENES[1] + ONE_SET, PAIRS["`hilbert30`, sorted leaves"])[-1]
    doc.says("{} of the {} ms of torus:2880000 are `read_back`, of {} MB", copied.median_ns("read_back") * 1e-6, copied.wall_ns * 1e-6,
             copied.counters["pairs_count"] * 8e-6)
    copied = cells_of(file, SCENES[1], TREES["`hilbert30`, sorted leaves"])[-1]
    doc.under("## Triangles to tree")
    doc.says("{} of the {} ms of torus:2880000 are `upload`", copied.median_ns("upload") * 1e-6, copied.wall_ns * 1e-6)
    doc.under("# Headlines", until="## Triangles to tree")
    doc.says("at least {} samples", min(len(cell.samples) for row in every for cell in row))
    apart = {kind: max(spread([cell for cell in row if cell.caches == kind], kind == "host")[2] for row in every) for kind in KINDS}
    doc.says("differ by at most {} % with hot caches, {} % with cold ones and {} % from host to host", *(100 * apart[kind] for kind in KINDS))
    for kind, row in (("trees", every[:len(every) // 2]), ("pairs", every[len(every) // 2:])):
        slower = [cold.median_ns() / hot.median_ns() for hot, cold, _ in row]
        doc.says(f"{kind} {{}} to {{}} times as long", min(slower), max(slower))
