from collections.abc import Iterator

from plots.evidence.headlines import spread, told
from plots.evidence.quotes import ONE_SET, Document, File

SCENES = ("torus:144046", "torus:2880000", "torus:16777216", "happy_buddha_1087716", "unc_cloth_ball")
KINDS = {"": False, ", cold caches": False, ", from host to host": True}
PARTS = {"trees": ("", "oibvh-single", "oibvh-single, hilbert30, sorted leaves"),
         "pairs": (ONE_SET, "block over oibvh-single", "block over oibvh-single (hilbert30, sorted leaves)")}


def quotes(doc: Document) -> None:
    file = File("h200/headlines")
    apart: dict[bool, list[float]] = {False: [], True: []}
    fewest = min(len(cell.samples) for cell in file.cells)

    def rows(suffix: str, *pipelines: str) -> Iterator[list[str]]:
        for scene in SCENES:
            for order, asked in zip(("`morton30`", "`hilbert30`"), pipelines, strict=True):
                those = {kind: (file.frames(scene + suffix, asked + kind), by_host) for kind, by_host in KINDS.items()}
                for cells, by_host in those.values():
                    apart[by_host].append(100 * spread(cells, by_host)[2])
                yield [scene, order, *(told(cells, by_host).replace(" %", "") for cells, by_host in those.values())]

    for name, (suffix, *pipelines) in PARTS.items():
        doc.table(name, "< scene | < order | hot | cold | host to host", rows(suffix, *pipelines))
    doc.says("at least {};", fewest)
    doc.says("differ by up to {} %, on the device's clock by up to {} %", max(apart[True]), max(apart[False]))
