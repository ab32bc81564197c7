from plots.evidence.quotes import ONE_SET, Document, File, ends, query_us, tree_us, us
from plots.read.cells import Cell

SCENES = ("bend:torus:144046", "bend:torus:1087474", "bend:torus:2880000", "bend:happy_buddha_1087716", "unc_cloth_ball" + ONE_SET,
          "bend:hairball:400000", "bend:grid:1000000", "bend:soup:500000")
FIRST = "block over oibvh-single (hilbert30, sorted leaves)"
ROWS = {"`group` over `oibvh-multi`, `hilbert30`": "group over oibvh-multi (hilbert30, sorted leaves)",
        "`group` over `apetrei-fused`": "group over apetrei-fused", "culbvh": "culbvh", "cuBQL, radix": "cubql-radix",
        "cuBQL, rebin radix": "cubql-rebin-radix", "Warp, LBVH": "warp-lbvh", "NexusBVH, H-PLOC, 32 bits": "nexus-hploc-32",
        "NexusBVH, H-PLOC, 64 bits": "nexus-hploc-64", "libuipc, stackless": "uipc-stackless", "libuipc, linear": "uipc-linear",
        "libuipc, info stackless": "uipc-info-stackless", "ArborX": "arborx", "lottery7, H-PLOC": "lottery7-hploc", "GPU_IPC": "mlbvh",
        "Scalable-CCD, sweep": "scalable-ccd-sap", "Scalable-CCD, queue": "scalable-ccd-stq"}
REFITS = ("culbvh", "cuBQL, radix", "cuBQL, rebin radix", "Warp, LBVH", "libuipc, linear")
TITLES = " | ".join(scene.removeprefix("bend:").removesuffix(ONE_SET) for scene in SCENES)


def both(cell: Cell) -> tuple[float, float]:
    """Returns the microseconds from triangles and from the tree to pairs."""
    return tree_us(cell) + query_us(cell), query_us(cell)


def best_ratios(file: File, ours: str = FIRST) -> list[float]:
    """Returns how many times as long as ours the fastest method from outside takes in each scene."""
    theirs = [[cell for cell in (file.cell(scene, asked) for asked in ROWS.values()) if cell.outside] for scene in SCENES]
    return [min(both(cell)[0] for cell in cells) / both(file.cell(scene, ours))[0] for scene, cells in zip(SCENES, theirs, strict=True)]


def refit_ratios(file: File) -> dict[str, list[float]]:
    """Returns how many times as long as ours, which rebuilds, each library takes that refits, from moved vertices to pairs, by scene."""
    return {name: [both(file.cell(scene, f"{ROWS[name]}-refit"))[0] / both(file.cell(scene, FIRST))[0] for scene in SCENES] for name in REFITS}


def best_refits(file: File) -> tuple[float, float]:
    """Returns the least and the largest of the fastest library's in each scene, with builds allowed too."""
    return ends(map(min, zip(*refit_ratios(file).values(), best_ratios(file), strict=True)))


def quotes(doc: Document) -> None:
    file = File("h200/rivals")
    ours = [both(file.cell(scene, FIRST)) for scene in SCENES]

    def entry(scene: str, asked: str, first: tuple[float, float]) -> str:
        return ", ".join(f"{one / other:.1f}" for one, other in zip(both(file.cell(scene, asked)), first, strict=True))

    doc.table("pairs", f"< | {TITLES}", [
        ["ours, ms", *(", ".join(f"{one * 1e-3:.3f}" for one in those) for those in ours)],
        *([label, *(entry(scene, asked, first) for scene, first in zip(SCENES, ours, strict=True))] for label, asked in ROWS.items())])
    doc.says("from outside takes {} to {} times as long as ours", *ends(best_ratios(file)))
    doc.says("the same algorithm as theirs, the fastest takes {} to {} times as long.", *ends(best_ratios(file, "group over apetrei-fused")))
    doc.says("Where they refit and ours rebuilds, the fastest takes {} to {} times as long", *best_refits(file))
    walls = [cell.wall_ns * 1e-6 for cell in (file.cell(SCENES[0], asked) for asked in ROWS.values()) if cell.outside]
    doc.says("takes {} ms with ours, a head start included, and {} to {} with theirs", file.cell(SCENES[0], FIRST).wall_ns * 1e-6, *ends(walls))
    doc.table("refits", f"< | {TITLES}", [
        *([name, *(f"{tree_us(file.cell(scene, f'{ROWS[name]}-refit')) * 1e-3:.3f}, {ratio:.1f}"
                   for scene, ratio in zip(SCENES, those, strict=True))] for name, those in refit_ratios(file).items()),
        ["`oibvh-single`", *(f"{us(file.cell(scene.removesuffix(ONE_SET), 'oibvh-single, hilbert30, sorted leaves, refit')) * 1e-3:.3f}"
                             for scene in SCENES)]])
