from plots.evidence.quotes import Document, File, us

OVER = "over oibvh-single (hilbert30, sorted leaves)"
SCENES = ("unc_cloth_ball", "ipc_armadillo_rollers", "unc_nbody", "unc_cloth_funnel")


def quotes(doc: Document) -> None:
    impacts, h200, pocl = (File(name) for name in ("h200/accuracy-impacts", "h200/swept", "pocl-2-cores/swept"))
    if any(cell.counters["missed_count"] + cell.counters.get("ground_truth_missed", 0) for cell in (*impacts.cells, *h200.cells)):
        raise ValueError("the page says that no pair of the ground truth is missed")
    doc.table("pairs", "< sequence | < query | boxes | pairs | ground truth | inflation", (
        [scene, cell.swept["pairs"], cell.swept["primitives"],
         *(cell.counters[key] for key in ("pairs_count", "ground_truth_pairs")),
         cell.counters["pairs_count"] / cell.counters["ground_truth_pairs"]]
        for scene in SCENES for cell in h200.frames(scene, f"group {OVER}")))
    tolerances = "ccd-1e-2", "ccd-1e-6"
    doc.table("impacts", f"< sequence | < query | touch | `broad` | {' | '.join(f'`{name}` | false' for name in tolerances)}", (
        [scene, own[0].swept["pairs"], own[0].counters["contacts_count"] - own[0].counters["false_count"], us(own[0], "broad") * 1e-3,
         *(value for cell in own for value in (us(cell, "narrow") * 1e-3, cell.counters["false_count"]))]
        for scene in (*SCENES, "ipc_rod_twist", "ipc_thick_cloth") for own in zip(*(impacts.frames(scene, f"impacts, {name}") for name in tolerances), strict=True)))
    both = "ccd-1e-6", "ccd-f64-1e-6"
    doc.table("early", f"< sequence | {' | '.join(f'`{name}`: median | 99 %' for name in both)}", (
        [scene, *(f"{max(cell.counters[key] for cell in impacts.frames(scene, f'impacts, {name}')):.1e}"
                  for name in both for key in ("gap_median", "gap_99_percent"))] for scene in (*SCENES, "ipc_rod_twist", "ipc_thick_cloth")))
    kept, rounded = File("h200/steps-in-doubles").cells, impacts.frames("ipc_rod_twist", "impacts, ccd-1e-6")
    doc.says("both queries take {} ms with `kept` and `ccd-f64-1e-6`, and their narrow phase {}, with {} false contacts",
             *(sum(us(cell, *stages) for cell in kept) * 1e-3 for stages in ((), ("narrow",))), sum(cell.counters["false_count"] for cell in kept))
    doc.says("by `ccd-1e-6` the narrow phase takes {} ms and has {}", sum(us(cell, "narrow") for cell in rounded) * 1e-3,
             sum(cell.counters["false_count"] for cell in rounded))
    asked = {"block": f"block {OVER}", "bvtt": f"bvtt {OVER}", "group": f"group {OVER}", "leaf": f"leaf {OVER}",
             "grid": "hierarchical grid", "embree": "embree"}
    doc.table("times", f"< collider | {' | '.join(SCENES)} | two cores: {' | '.join(SCENES[:2])}", (
        [f"`{label}`", *(sum(map(us, file.frames(scene, name))) * 1e-3
                         for file, scenes in ((h200, SCENES), (pocl, SCENES[:2])) for scene in scenes)] for label, name in asked.items()))
