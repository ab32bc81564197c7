from quotes import Document, File, us

HILBERT = "over oibvh-single (hilbert30, sorted leaves)"
SCENES = ("unc_cloth_ball", "ipc_armadillo_rollers", "unc_nbody", "unc_cloth_funnel")


def step(file: File, scene: str, asked: str) -> tuple[float, int]:
    """Returns the milliseconds of both queries of a step, and the pairs that they find."""
    both = file.frames(scene, asked)
    assert len(both) == 2
    return sum(map(us, both)) * 1e-3, sum(cell.counters["pairs_count"] for cell in both)


def impacts(doc: Document) -> None:
    file = File("h200/accuracy-impacts")
    doc.under("## What touches")
    total = 0
    for scene in SCENES:
        by_tolerance = [file.frames(scene, f"impacts, {method}") for method in ("ccd-1e-2", "ccd-1e-4", "ccd-1e-6")]
        for own in zip(*by_tolerance):
            kind, truth = own[0].swept["pairs"], own[0].counters["ground_truth_pairs"]
            total += truth
            doc.row(f"{scene}, {kind}", truth, us(own[0], "broad") * 1e-3,
                    *(value for cell in own for value in (us(cell, "narrow") * 1e-3, cell.counters["false_count"])))
    doc.says("all {} pairs of the ground truth that touch are found at each\ntolerance, {} are missed.", total,
             sum(cell.counters[key] for cell in file.cells for key in ("missed_count", "ground_truth_missed")))


def quotes(doc: Document) -> None:
    impacts(doc)
    h200, pocl = File("h200/swept"), File("pocl-2-cores/swept")
    for scene in SCENES:
        doc.under(f"| {scene} | vertex-face", lines=2)
        for cell in h200.frames(scene, f"group {HILBERT}"):
            kind, counters = cell.swept["pairs"], cell.counters
            doc.says(f"| {scene if kind == 'vertex-face' else ''} | {kind} |".replace("|  |", "| |") + " {} | {} | {} | {} | {} |",
                     cell.swept["primitives"],
                     counters["pairs_count"], counters["ground_truth_pairs"], counters["ground_truth_missed"],
                     counters["pairs_count"] / counters["ground_truth_pairs"])
    doc.under("## What it takes")
    rates = {asked: [pairs / ms * 1e-3 for ms, pairs in (step(pocl, scene, asked) for scene in ("ipc_armadillo_rollers", "unc_cloth_ball"))]
             for asked in (f"group {HILBERT}", "embree", f"bvtt {HILBERT}", "hierarchical grid")}
    doc.says("writes {} million pairs per second on `ipc_armadillo_rollers` and {} on\n`unc_cloth_ball`, from two frames' "
             "vertices; `embree` writes {} and {}, "
             "`bvtt` {} and {}, `grid` {} and {}.", *(rate for both in rates.values() for rate in both))
    doc.says("| pipeline | unc_cloth_ball, {} | | ipc_armadillo_rollers, {} | | unc_nbody, {} | | unc_cloth_funnel, {} |",
             *(step(h200, scene, f"group {HILBERT}")[1] for scene in SCENES))
    for label, asked in (("`bvtt` over `oibvh-single`, `hilbert30`, sorted leaves", f"bvtt {HILBERT}"),
                         ("`block` over the same", f"block {HILBERT}"),
                         ("`group` over `oibvh-single`, `hilbert30`, sorted leaves", f"group {HILBERT}"),
                         ("`leaf` over `oibvh-single`, `hilbert30`, sorted leaves", f"leaf {HILBERT}"),
                         ("`embree`, on that machine's host", "embree")):
        doc.row(label, *(value for ms, pairs in (step(h200, scene, asked) for scene in SCENES) for value in (ms, pairs / ms * 1e-3)))
    doc.says("`run swept`: all {} cells agree", sum(cell.verdict == "agrees" for cell in h200.cells))
