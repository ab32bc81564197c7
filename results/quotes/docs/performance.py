from cells import Cell
from quotes import ONE_SET, Document, File, us

LARGE, SMALL = "torus:2880000", "torus:144046"
KD = "block over oibvh-single (kd, sorted leaves)"


def moved(cell: Cell, stage: str = "") -> float:
    """Returns the bytes a triangle that a stage, or all stages, must move."""
    return sum(cell.moved_bytes(one) for one in ([stage] if stage else cell.samples[0])) / cell.triangles


def floor_us(cell: Cell, stage: str, rate: float) -> float:
    return moved(cell, stage) * cell.triangles / rate * 1e6


def launches(cell: Cell, stage: str = "") -> int:
    return sum(numbers["launches"] for name, numbers in cell.samples[0].items() if stage in (name, ""))


def row(doc: Document, label: str, cells: tuple[Cell, Cell], stage: str, rate: float, scale: float = 1, ratios: int = 1,
        before: str = "") -> None:
    """A row of floors and times of a large and a small scene. Bytes and launches of the small one are told where they differ."""
    told = [str(launches(cell, stage)) for cell in cells], [f"{moved(cell, stage):.0f}" for cell in cells]
    # Bytes of scenes differ by parts of a byte, which the text does not have.
    small = [large if large == other or (values is told[1] and abs(int(large) - int(other)) < 2) else f"{large}, small {other}"
             for values in told for large, other in [values]]
    times = [[scale * value for value in (floor_us(cell, stage, rate), us(cell, stage))] for cell in cells]
    words = [*times[0], times[0][1] / times[0][0], *times[1], *([times[1][1] / times[1][0]] if ratios == 2 else [])]
    doc.row(label + before, small[1], small[0], *words)


def builds(doc: Document) -> None:
    doc.under("### Builds", until="### Queries")
    peers, pairs, roofline = File("h200/peers"), File("h200/pairs"), File("h200/roofline")
    rate = roofline.document["run"]["copy_rate_bytes_per_s"]
    doc.says("at the copy rate of {} TB/s", rate * 1e-12)

    def both(file: File, asked: str) -> tuple[Cell, Cell]:
        return file.cell(LARGE, asked), file.cell(SMALL, asked)

    single, kd = both(peers, "oibvh-single"), tuple(pairs.cell(scene + ONE_SET, KD) for scene in (LARGE, SMALL))
    for label, cell, stage in (("`bounds`", single[0], "bounds"), ("`codes`", single[0], "codes"), ("`sort`", single[0], "sort"),
                               ("`codes`, `hilbert30`", roofline.cell(LARGE, "oibvh-multi, hilbert30"), "codes")):
        floor, reached = floor_us(cell, stage, rate), us(cell, stage)
        doc.row(label, moved(cell, stage), launches(cell, stage), floor, reached, reached / floor)
    doc.says("| all three in one launch | {} | {} | | | | {} | {} |", moved(single[1], "order"), launches(single[1], "order"),
             floor_us(single[1], "order", rate), us(single[1], "order"))
    for label, cells, stage in (("`hierarchy`", single, "hierarchy"), ("whole build", single, ""),
                                ("`hierarchy`, with sorted leaves", kd, "hierarchy"),
                                ("`hierarchy`, `oibvh-multi`", both(peers, "oibvh-multi"), "hierarchy"),
                                ("`order`, `kd`", kd, "order")):
        row(doc, label, cells, stage, rate)

    cold = both(File("h200/peers-cold"), "oibvh-single, cold caches")
    doc.says("take {}, {}, {} and {} µs, `order` and `hierarchy` of torus:144046 {} and {}",
             *(us(cold[0], stage) for stage in ("bounds", "codes", "sort", "hierarchy")),
             *(us(cold[1], stage) for stage in ("order", "hierarchy")))
    most = File("h200/scaling-large").cell("torus:67108864", "oibvh-single")
    doc.says("{} triangles take {} ms, {} ns per triangle against {} at 2,880,000", most.triangles, us(most) * 1e-3,
             us(most) * 1e3 / most.triangles, us(single[0]) * 1e3 / single[0].triangles)


def queries(doc: Document) -> None:
    doc.under("### Queries", until="## Two cores")
    roofline = File("h200/roofline")
    rate = roofline.document["run"]["copy_rate_bytes_per_s"]
    for label, asked in (("`leaf`", "leaf over oibvh-multi (sorted leaves)"), ("`group`", "group over oibvh-multi (sorted leaves)"),
                         ("`block`", "block over oibvh-multi (sorted leaves)"),
                         ("`bvtt`, jump 2", "bvtt (jump 2) over oibvh-multi (sorted leaves)"),
                         ("`grid`", "hierarchical grid")):
        cells = roofline.cell(LARGE, asked), roofline.cell(SMALL, asked)
        row(doc, f"`broad` | {label}", cells, "broad", rate, ratios=2)
    row(doc, "`narrow` | after any", tuple(roofline.cell(scene, "leaf over oibvh-multi (sorted leaves)") for scene in (LARGE, SMALL)),
        "narrow", rate, ratios=2)


def two_cores(doc: Document) -> None:
    doc.under("## Two cores", until="![Stages over their floors, two cores]")
    file = File("pocl-2-cores/roofline")
    rate = file.document["run"]["copy_rate_bytes_per_s"]
    doc.says("copy rate {} GB/s read plus written, {} µs per launch", rate * 1e-9, file.document["run"]["launch_cost_ns"] * 1e-3)
    for label, asked, stage in (("`bounds`", "oibvh-multi", "bounds"), ("`codes`", "oibvh-multi", "codes"),
                                ("`sort`", "oibvh-multi", "sort"),
                                ("`hierarchy`", "oibvh-multi", "hierarchy"),
                                ("`gather`, with sorted leaves", "oibvh-multi, sorted leaves", "gather"),
                                ("`hierarchy` from sorted leaves", "oibvh-multi, sorted leaves", "hierarchy"),
                                ("`codes`, `hilbert30`", "oibvh-multi, hilbert30", "codes"),
                                ("`order`, `kd`", "oibvh-multi, kd, sorted leaves", "order")):
        row(doc, label, (file.cell(LARGE, asked), file.cell(SMALL, asked)), stage, rate, 1e-3, 2)


def libraries(doc: Document) -> None:
    doc.under("Compared with libraries", until="### Starting")
    native, scenes = File("pocl-2-cores/native"), ("bunny", "dragon_202520", "happy_buddha_1087716")
    times = {asked: [us(native.cell(scene, asked)) * 1e-3 for scene in scenes]
             for asked in ("oibvh-multi", "oibvh-multi, hilbert30", "apetrei-fused", "embree-low", "fcl-aabb")}
    for asked, values in times.items():
        doc.row("the same, `hilbert30`" if "hilbert30" in asked else f"`{asked}`", *values)
    ratios = [[theirs / ours for ours, theirs in zip(times["oibvh-multi"], times[name])] for name in ("embree-low", "fcl-aabb")]
    doc.says("is {} to {} times as fast as Embree's Morton builder and {} to {} times as fast as FCL's",
             *(end for values in ratios for end in (min(values), max(values))))
    yardstick = File("pocl-2-cores/yardstick")
    hosts = [us(yardstick.cell(scene, "oibvh-host"), "hierarchy") / us(yardstick.cell(scene, "oibvh-multi"), "hierarchy")
             for scene in {cell.scene for cell in yardstick.cells}]
    doc.says("takes {} to {} times as long as `oibvh-multi` on four\nmeshes", min(hosts), max(hosts))


def queries_of_two_cores(doc: Document) -> None:
    doc.under("### Growth", until="## Wide trees")
    growth = {cell.triangles: us(cell) * 1e3 / cell.triangles for cell in File("pocl-2-cores/scaling").cells if cell.has_times}
    middle = [ns for count, ns in growth.items() if 1 << 15 <= count <= 1 << 24]
    doc.says("takes {} ns per triangle at 2^10, {} to {} ns from 2^15 to 2^24, and {} ns at 2^25", growth[1 << 10], min(middle),
             max(middle), growth[1 << 25])
    pairs, scenes = File("pocl-2-cores/native-pairs"), ("two-spheres:198448:1", "dragon_202520" + ONE_SET, "unc_cloth_ball")
    embree = [us(pairs.cell(scene, "embree"), "broad") * 1e-3 for scene in scenes]
    for label, builder in (("`oibvh-multi`, `hilbert30`, sorted leaves", "oibvh-multi (hilbert30, sorted leaves)"),
                           ("`oibvh-multi`, sorted leaves", "oibvh-multi (sorted leaves)"), ("`oibvh-multi`", "oibvh-multi"),
                           ("`apetrei-fused`", "apetrei-fused")):
        times = [us(pairs.cell(scene, f"group (without near) over {builder}"), "broad") * 1e-3 for scene in scenes]
        doc.says(f"| {label} |" + " {}, {} |" * 3, *(value for time, other in zip(times, embree) for value in (time, time / other)))
    doc.row("`rtcCollide`", *embree)


def wide(doc: Document) -> None:
    doc.under("## Wide trees")
    file, scenes = File("pocl-2-cores/wide"), tuple(scene + ONE_SET for scene in ("dragon_202520", "torus:144046"))
    for label, builder in (("`oibvh-multi`", "oibvh-multi"), ("`oibvh-wide8`", "oibvh-wide8"),
                           ("`oibvh-multi`, `hilbert30`, sorted leaves", "oibvh-multi (hilbert30, sorted leaves)"),
                           ("`oibvh-wide8`, `hilbert30`", "oibvh-wide8 (hilbert30)")):
        cells = [file.cell(scene, f"group over {builder}") for scene in scenes]
        doc.row(label, cells[0].counters["tree_bytes"] / cells[0].triangles,
                *(1e-3 * value for cell in cells for value in (us(cell, "hierarchy"), us(cell, "broad"), us(cell))))
    leaf = [us(file.cell(scenes[0], f"leaf over {builder}"), "broad") * 1e-3 for builder in ("oibvh-wide8", "oibvh-multi")]
    doc.says("`leaf` takes {} ms instead of {} on the dragon", *leaf)
    bvtt = [us(file.cell(scenes[0], f"bvtt over {builder}"), "broad") for builder in ("oibvh-multi", "oibvh-wide4", "oibvh-wide8")]
    doc.says("`bvtt` is slower, {} times with 4 children and {} times with 8", bvtt[1] / bvtt[0], bvtt[2] / bvtt[0])
    h200 = File("h200/wide")
    frames = [us(h200.cell(scene + ONE_SET, f"group over {builder}")) * 1e-3 for scene in ("dragon_202520", "happy_buddha_1087716")
              for builder in ("oibvh-wide8", "oibvh-multi")]
    doc.says("{} ms a frame instead\n  of {}, and loses on the Happy Buddha, {} instead of {}", *frames)


def quotes(doc: Document) -> None:
    for part in (builds, queries, two_cores, libraries, queries_of_two_cores, wide):
        part(doc)
