from cells import Cell
from quotes import Document, File, query_us, tree_us, us

POCL, H200 = "pocl-2-cores", "h200"
METHODS = ("filter-f64+exact", "guigue-f64", "guigue-f32", "moller-f32")


def narrow(doc: Document) -> None:
    doc.under("## Narrow phases")
    file = File(f"{POCL}/accuracy-narrow")
    classes = dict.fromkeys(cell.scene for cell in file.cells)

    def counts(method: str, scene: str) -> tuple[float, float]:
        counters = file.cell(scene, f"narrow, {method}").counters
        return counters["missed_count"], counters["false_count"]

    for method in METHODS:
        errors = [counts(method, scene) for scene in classes]
        doc.row(f"`{method}`", *map(sum, zip(*errors)),
                f"{sum(any(one) for one in errors)}{f' of {len(classes)}' if method == METHODS[0] else ''}")
    for scene in ("near_coplanar", "needles", "hairs_breadth", "same_place", "identical", "degenerate", "denormals"):
        exact = file.cell(scene, f"narrow, {METHODS[0]}").counters
        meet, pairs, share = exact["meeting_count"], exact["pairs_count"], 100 * exact["narrow_exact_count"] / exact["pairs_count"]
        doc.says(f"| `{scene}` | {{}} | {{}} |" + " {} / {} |" * 3, "all" if meet == pairs else f"{meet:,}", f"{share:.0f} %"
                 if share >= 0.5 else "0",
                 *(count for method in METHODS[1:] for count in counts(method, scene)))
    generic = File(f"{H200}/accuracy-narrow-generic")
    ns = [us(generic.cell("generic", f"narrow, {method}")) * 1e3 / generic.cell("generic", f"narrow, {method}").counters["pairs_count"]
          for method in METHODS]
    doc.says("the default takes {} ns per pair and `guigue-f64` {}\n([", *ns[:2])
    gpu = File(f"{H200}/accuracy-narrow")
    times = {method: {scene: us(gpu.cell(scene, f"narrow, {method}")) for scene in classes} for method in METHODS}
    worst = times[METHODS[0]]["hairs_breadth"] / times["guigue-f64"]["hairs_breadth"]
    floats = [times["guigue-f32"][scene] / times["guigue-f64"][scene] for scene in classes]
    doc.says("`hairs_breadth`, the worst, {} times. Doubles cost next to nothing on this GPU: `guigue-f32` takes {}\nto {} of the time",
             worst,
             min(floats), max(floats))
    own = [us(file.cell("generic", f"narrow, {method}")) * 1e3 / 217391 for method in METHODS]
    doc.says("On `generic` the default takes {} ns per pair and `guigue-f64` {}", *own[:2])
    longer = {}
    for scene in classes:
        exact, rounded = (file.cell(scene, f"narrow, {method}") for method in METHODS[:2])
        if exact.counters["narrow_exact_count"] > exact.counters["pairs_count"] / 2:
            longer[scene] = us(exact) / us(rounded)
    named = [longer.pop(scene) for scene in ("hairs_breadth", "collinear")]
    doc.says("Where most pairs need exact sums it takes {} to {} times as long, in `hairs_breadth` {} times and in `collinear` {} times",
             min(longer.values()), max(longer.values()), *named)


def impacts(doc: Document) -> None:
    doc.under("## Between two frames")
    cells = File(f"{H200}/accuracy-impacts").cells
    own = [[cell for cell in cells if cell.accuracy["method"] == method] for method in ("ccd-1e-2", "ccd-1e-4", "ccd-1e-6")]
    false = [sum(cell.counters["false_count"] for cell in some) for some in own]
    doc.says("have {} false contacts for {} right ones at a tolerance of 1e-2 of\nthe scene, {} at 1e-4 and {} at 1e-6, in {}, {} and {} ms",
             false[0], sum(cell.counters["ground_truth_pairs"] for cell in own[0]), *false[1:],
             *(sum(us(cell, "narrow") for cell in some) * 1e-3 for some in own))


def sums(doc: Document) -> None:
    doc.under("## Sums")
    file = File(f"{POCL}/accuracy-sums")
    scenes = ("torus:100000", "hairball:100000", "torus:1000000")
    for label, method in (("`f32`", "f32"), ("`f32-compensated`", "f32-compensated"), ("`f64`", "f64"), ("`f64-pairwise`", "f64-pairwise"),
                          ("`f64-compensated`: `sah_cost`", "f64-compensated")):
        cells = [file.cell(scene, f"sums, {method}") for scene in scenes]
        doc.row(label, us(cells[0]) * 1e3 / cells[0].counters["nodes_count"], *(cell.counters["relative_error"] for cell in cells))
    longer = [us(file.cell(scene, "sums, f64-pairwise")) / us(file.cell(scene, "sums, f64-compensated")) for scene in scenes]
    doc.says("as good as compensated ones and take {} to {} times as long", min(longer), max(longer))


def codes(doc: Document) -> None:
    doc.under("## Codes")
    file = File(f"{POCL}/accuracy-codes")
    for label, scene, methods in (("torus:100000", "torus:100000", ("morton30", "hilbert30", "kd", "radix")),
                                  ("outlier:sphere:100000:0:1000", "outlier:sphere:100000:0:1000", ("morton30", "morton63")),
                                  ("n-body:100000, 305 objects", "n-body:100000", ("morton30", "hilbert30", "hilbert30-scene"))):
        doc.under(f"| {label} | `morton30`", lines=len(methods))
        for place, method in enumerate(methods):
            counters = file.cell(scene, f"codes, {method}").counters
            name = "radix tree" if method == "radix" else f"`{method}`"
            equal = ("", "") if method in ("kd", "radix") else (counters["duplicates_count"], counters["longest_run_count"])
            doc.says(f"| {label if place == 0 else ''} | {name} |".replace("|  |", "| |") + (" | |" if equal[0] == "" else " {} | {} |")
                     + " {} | {} |",
                     *(value for value in equal if value != ""), counters["sah_cost"], counters["box_tests_count"])


def when_medians_pay(doc: Document) -> None:
    """After how many queries by `leaf` the longer build of `kd` has paid."""
    doc.under("## Codes")
    scenes = ("torus:100000", "hairball:100000", "outlier:sphere:100000:0:1000")

    def both(machine: str, scene: str) -> tuple[Cell, Cell]:
        file = File(f"{machine}/accuracy-codes")
        return file.cell(scene, "codes, hilbert30"), file.cell(scene, "codes, kd")

    def pays(machine: str, scene: str) -> float:
        plain, kd = both(machine, scene)
        return (tree_us(kd) - tree_us(plain)) / (query_us(plain) - query_us(kd))

    doc.says("has paid for its build after {}\n  queries on the torus, {} on the hairball and {} with the outlier",
             *(pays(POCL, scene) for scene in scenes))
    shares = [query_us(both(H200, scene)[0]) / tree_us(both(H200, scene)[0]) for scene in scenes[:2]]
    doc.says("takes {} (torus) and {}\n  (hairball) times as long as the build, it pays after {} and {} queries", *shares,
             *(pays(H200, scene) for scene in scenes[:2]))


def inputs(doc: Document) -> None:
    doc.under("## Input")
    file = File(f"{POCL}/accuracy-input")
    doc.says("torus:20000, {} pairs", file.cell("torus:20000 at 0", "input, f32").counters["pairs_count"])
    for distance in ("0", "1e2", "1e3", "1e4", "1e5", "1e6"):
        own, other = (file.cell(f"torus:20000 at {distance}", f"input, {method}").counters for method in ("f32", "f32-recentred"))
        doc.row(distance, own["false_count"], own["pairs_count"] / own["right_pairs_count"], other["false_count"])


def boxes(doc: Document) -> None:
    doc.under("## Box formats")
    file, large = File(f"{POCL}/accuracy-boxes"), File(f"{H200}/accuracy-boxes")
    for scene, formats in (("torus:100000", ("f32", "f64", "f16", "u16", "u8")), ("hairball:100000", ("f16", "u16", "u8"))):
        doc.under(f"| {scene} | `{formats[0]}`", lines=len(formats))
        for place, name in enumerate(formats):
            counters = file.cell(scene, f"boxes, {name}").counters
            # Box tests are those of another run, by `leaf`, of which no file was kept.
            doc.says(f"| {scene if place == 0 else ''} | `{name}` |".replace("|  |", "| |") + " {} | {} | {} | {} | {} |",
                     counters["node_bytes"],
                     counters["tree_bytes"], None, counters["false_count"], counters["pairs_count"] / counters["right_pairs_count"])
    doc.under("- **16-bit integers are enough.**")
    doc.says("it takes {} ms instead of {}", *(us(file.cell("torus:100000", f"boxes, {name}")) * 1e-3 for name in ("u16", "f32")))
    doc.says("and the narrow phase\n  takes {} ms instead of {}.",
             *(us(file.cell("torus:100000", f"boxes, {name}"), "narrow") * 1e-3 for name in ("u8", "f32")))
    cells = {name: large.cell("torus:2880000", f"boxes, {name}") for name in ("f32", "u16", "u8")}
    doc.under("| torus:2880000 | `f32`", lines=3)
    for name, cell in cells.items():
        before = "| torus:2880000 |" if name == "f32" else "| |"
        doc.says(f"{before} `{name}` | {{}} | {{}} | {{}} | {{}} | {{}} |",
                 *(us(cell, stage) for stage in ("gather", "hierarchy", "broad", "narrow")), us(cell))
    doc.under("- **On this GPU smaller boxes")
    f32, u16 = cells["f32"], cells["u16"]
    doc.says("takes {} of the time that\n  both together take with floats, and `gather` {} µs", us(u16, "hierarchy") / us(f32, "hierarchy"), us(u16, "gather"))
    doc.says("The query takes {} times as long in `u16`, for", us(u16, "broad") / us(f32, "broad"))
    doc.says("and the whole frame {} times", us(u16) / us(f32))
    radix = File(f"{H200}/radix-boxes")
    doc.says("takes {} of the time of floats in `u16`",
             us(radix.cell("torus:871306", "leaf over karras (hilbert30, sorted leaves, u16 boxes)"))
             / us(radix.cell("torus:871306", "leaf over karras (hilbert30, sorted leaves)")))


def frames(doc: Document) -> None:
    doc.under("## Frames")
    file = File(f"{H200}/accuracy-frames")
    scenes = ("unc_cloth_ball", "unc_nbody", "ipc_armadillo_rollers", "n-body:146480", "cloth-funnel:18484")

    def total(scene: str, method: str, counter: str) -> float:
        return sum(cell.counters[counter] for cell in file.frames(scene, f"frames, {method}"))

    def frame_us(scene: str, method: str) -> float:
        cells = file.frames(scene, f"frames, {method}")
        return sum(map(us, cells)) / len(cells)

    exact = {scene: frame_us(scene, "exact") for scene in scenes}
    doc.row("`exact`, µs", *exact.values())
    doc.row("contacts", *(total(scene, "exact", "right_contacts_count") for scene in scenes))
    for label, method in (*((f"`{name}`", f"narrow {name}") for name in ("guigue-f64", "guigue-f32", "moller-f32", "sat-f32")),
                          ("no narrow phase", "narrow none"), ("boxes `u16`", "boxes u16"), ("boxes `u8`", "boxes u8"),
                          *((f"{bits} bits", f"input {bits} bits") for bits in (20, 16, 12, 8)), ("all coarse", "all coarse")):
        doc.says(f"| {label} |" + " {}: {} / {} |" * len(scenes), *(
            value for scene in scenes
            for value in (frame_us(scene, method) / exact[scene], *(total(scene, method, name) for name in ("missed_count", "false_count")))))

    def ratios(*methods: str) -> tuple[float, float]:
        found = [frame_us(scene, method) / exact[scene] for scene in scenes for method in methods]
        return min(found), max(found)

    missed = [100 * total(scenes[0], f"input {bits} bits", "missed_count") / total(scenes[0], "exact", "right_contacts_count")
              for bits in (16, 12)]
    doc.says("phases that round take {} to {} of the time", *ratios(*(f"narrow {name}" for name in (*METHODS[1:], "sat-f32"))))
    doc.says("`u16` takes {} to {} of it, `u8` {} to {}.", *ratios("boxes u16"), *ratios("boxes u8"))
    doc.says("With 16 bits {} % of the cloth's contacts are missed, with 12 bits {} %", *missed)
    doc.says("16 bits take {} to {} of it. With 8 bits false contacts make a frame take up to {} times", *ratios("input 16 bits"),
             ratios("input 8 bits")[1])
    doc.says("takes {} to {} of the time, in four", *ratios("all coarse"))


def quotes(doc: Document) -> None:
    for part in (narrow, impacts, sums, codes, when_medians_pay, inputs, boxes, frames):
        part(doc)
