from plots.evidence.quotes import Document, File, us

METHODS = ("filter-f64+exact", "guigue-f64", "guigue-f32", "moller-f32", "sat-f32")
WRONG = ("missed_count", "false_count")


def narrow(doc: Document) -> None:
    file = File("pocl-2-cores/accuracy-narrow")
    of = {method: {cell.scene: cell.counters for cell in file.cells if cell.accuracy["method"] == method}
          for method in dict.fromkeys(cell.accuracy["method"] for cell in file.cells)}
    doc.table("narrow", "< | missed | false | classes with errors", (
        [f"`{method}`", *(sum(one[key] for one in classes.values()) for key in WRONG),
         sum(any(one[key] for key in WRONG) for one in classes.values())] for method, classes in of.items()))
    doc.table("classes", f"< class | meet | decided exactly | {' | '.join(f'`{method}`' for method in METHODS[1:])}", (
        [f"`{name}`", own["meeting_count"], f"{100 * own['narrow_exact_count'] / own['pairs_count']:.0f} %",
         *(f"{of[method][name]['missed_count']:,}/{of[method][name]['false_count']:,}" for method in METHODS[1:])]
        for name, own in of[METHODS[0]].items()
        if name in ("near_coplanar", "needles", "hairs_breadth", "same_place", "degenerate", "denormals")))
    cells = File("h200/accuracy-narrow").cells
    counted = [sum(cell.counters["false_count"] for cell in cells if cell.accuracy["method"] == name) for name in ("filter-f64", "filter-f32")]
    doc.says("`filter-f64` has {} false pairs and `filter-f32` {} there", *counted)
    doc.says("that `guigue-f64` misses overlaps by {} of", max(
        cell.counters.get("missed_depth_most", 0) for cell in cells if cell.accuracy["method"] == "guigue-f64"))


def axes_of_two_cores(doc: Document) -> None:
    codes, boxes = File("pocl-2-cores/accuracy-codes"), File("pocl-2-cores/accuracy-boxes")
    keys = "duplicates_count", "sah_cost", "box_tests_count"
    doc.table("codes", "< scene | < order | equal codes | surface area cost | box tests", (
        [scene, method, *(codes.cell(scene, f"codes, {method}").counters.get(key) for key in keys)]
        for scene, methods in {"torus:100000": ("morton30", "hilbert30", "kd", "radix"),
                               "outlier:sphere:100000:0:1000": ("morton30", "morton63"),
                               "n-body:100000": ("morton30", "hilbert30", "hilbert30-scene")}.items() for method in methods))
    doc.table("boxes", "< scene | < format | bytes per box | false pairs | pairs per right one", (
        [cell.scene, cell.accuracy["method"], *(cell.counters[key] for key in ("node_bytes", "false_count")),
         cell.counters["pairs_count"] / cell.counters["right_pairs_count"]]
        for scene, formats in {"torus:100000": ("f32", "f16", "u16", "u8"), "hairball:100000": ("f16", "u16", "u8")}.items()
        for cell in (boxes.cell(scene, f"boxes, {name}") for name in formats)))


def frames(doc: Document) -> None:
    file = File("h200/accuracy-frames")
    scenes = "unc_cloth_ball", "unc_nbody", "ipc_armadillo_rollers", "unc_cloth_funnel"
    exact = [file.frames(scene, "frames, exact") for scene in scenes]
    times = [sum(map(us, cells)) for cells in exact]

    def entry(scene: str, method: str, whole: float) -> str:
        cells = file.frames(scene, f"frames, {method}")
        return f"{sum(map(us, cells)) / whole:.2f}: {'/'.join(f'{sum(cell.counters[key] for cell in cells):,}' for key in WRONG)}"

    doc.table("frames", f"< | {' | '.join(scenes)}", [
        ["`exact`, µs", *(time / len(cells) for time, cells in zip(times, exact, strict=True))],
        ["contacts", *(sum(cell.counters["right_contacts_count"] for cell in cells) for cells in exact)],
        *([method.removeprefix("input "), *(entry(scene, method, whole) for scene, whole in zip(scenes, times, strict=True))]
          for method in dict.fromkeys(cell.accuracy["method"] for cell in file.cells)
          if method not in ("exact", "boxes f64", "boxes f16", "input 20 bits"))])


    by_bits = [cell.counters for cell in file.cells if cell.accuracy["method"] == "input 16 bits"]
    doc.says("Of the {} contacts that 16 bits miss", sum(cell["missed_count"] for cell in by_bits))
    doc.says("{} of the frame's longest side", max(cell.get("missed_depth_most", 0) for cell in by_bits))
    cloth = {method: sum(cell.counters["false_count"] for cell in file.frames("unc_cloth_ball", f"frames, narrow {method}")) for method in ("filter-f64", "none")}
    doc.says("`filter-f64` has {} false contacts, `none` {}", *cloth.values())


def queries(doc: Document) -> None:
    cells, of_h200 = (File(f"{machine}/accuracy-queries").cells for machine in ("pocl-2-cores", "h200"))
    sets = {"ccd_wang2021": "by hand", "ccd_scalable": "simulated"}
    if any(cell.counters["missed_count"] + cell.counters["late_count"] for cell in (*cells, *of_h200) if cell.accuracy["method"].startswith("ccd-")):
        raise ValueError("the page says that ours miss nothing")

    def row(method: str) -> list[str | float]:
        entries: list[str | float] = [f"`{method}`"]
        for name in sets:
            own = [cell for cell in cells if cell.accuracy["method"] == method and cell.scene.startswith(name)]
            there = [cell for cell in of_h200 if cell.accuracy["method"] == method and cell.scene.startswith(name)]
            queries = sum(cell.counters["queries_count"] for cell in own)
            sums = [sum(cell.counters[key] for cell in own) for key in ("missed_count", "late_count", "false_count")]
            entries += ["/".join(f"{count:,}" for count in sums),
                        f"{sum(cell.counters['shortened_mean'] * cell.counters['queries_count'] for cell in own) / queries:.1e}",
                        sum(us(cell) / cell.counters["copies_count"] for cell in own) / queries,
                        1e3 * sum(us(cell) / cell.counters["copies_count"] for cell in there) / queries if there else ""]
        return entries

    doc.table("queries", "< " + "".join(f" | {name}: missed/late/false | loss | µs | H200, ns" for name in sets.values()), (
        row(method) for method in dict.fromkeys(cell.accuracy["method"] for cell in cells)))


def distance(doc: Document) -> None:
    files = [File(f"{machine}/accuracy-distance").cells for machine in ("h200", "pocl-2-cores")]
    if any(cell.counters.get("missed_count", 0) for cells in files for cell in cells):
        raise ValueError("the page says that no method misses a pair")

    def row(method: str) -> list[str | float]:
        entries: list[str | float] = [f"`{method}`"]
        for within in ("0.1%", "1%"):
            there = [[cell for cell in cells if (cell.accuracy["method"], cell.raw["collider"]["options"]["within"]) == (method, within)] for cells in files]
            entries += [int(sum(cell.counters.get("false_count", 0) for cell in there[0])), *(sum(us(cell, "narrow") for cell in own) * 1e-3 for own in there)]
        errors = [cell.counters["distance_error_most"] for cell in files[0] if cell.accuracy["method"] == method and "distance_error_most" in cell.counters]
        return [*entries, f"{max(errors):.1e}" if errors else ""]

    doc.table("distance", "< narrow phase | 0.1 %: false | H200, ms | two cores, ms | 1 %: false | H200, ms | two cores, ms | error of D", (
        row(method) for method in dict.fromkeys(cell.accuracy["method"] for cell in files[0])))


def impacts(doc: Document) -> None:
    kept, rounded = File("h200/steps-in-doubles").cells, File("h200/accuracy-impacts").frames("ipc_rod_twist", "impacts, ccd-1e-6")
    doc.says("of a twisted rod {} times the time of recentred floats", sum(map(us, kept)) / sum(map(us, rounded)))


def place(doc: Document) -> None:
    file = File("h200/accuracy-place")

    def entry(scene: str) -> str:
        exact, filters = (file.cell(scene, f"place, {method}") for method in ("exact", "filter-f64"))
        left_open = exact.counters["narrow_exact_count"] / exact.counters["pairs_count"]
        return f"{100 * left_open:.1f} %: {us(exact, 'narrow') / us(filters, 'narrow'):.2f}"

    doc.table("place", "< sizes away | 2,000 triangles | 20,000 | 200,000", (
        [away, *(entry(f"two-spheres:{count} at {away}") for count in (2000, 20000, 200000))] for away in ("0", "1e1", "1e3", "1e4", "1e5")))


def quotes(doc: Document) -> None:
    for part in (narrow, axes_of_two_cores, frames, queries, distance, impacts, place):
        part(doc)
