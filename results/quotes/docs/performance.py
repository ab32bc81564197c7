from plots.evidence.quotes import ONE_SET, Document, File, ratios, us
from plots.read.cells import Cell

FEWER = ("gather", "refit", "hierarchy", "bounds", "narrow")  # stages with fewer launches
LARGE, SMALL = "torus:2880000", "torus:144046"
TITLES = "bytes per triangle | launches | large: floor | reached | ratio | small: reached | ratio"


def row(label: str, cells: tuple[Cell | None, Cell | None], stage: str, rate: float) -> list[float | str | None]:
    """Returns bytes, launches, floor, time and ratio of a stage, or of the whole, and time and ratio of a small scene."""
    entries = []
    for cell in cells:
        stages = [stage] if stage else list(cell.samples[0]) if cell else []
        moved, time = (sum(map(cell.moved_bytes, stages)), us(cell, *[stage] if stage else [])) if cell else (0, 0)
        launches = sum(cell.samples[0][one]["launches"] for one in stages) if cell else 0
        floor = moved / rate * 1e6
        entries.append([round(moved / cell.triangles), launches, floor, time, time / floor] if cell else [None] * 5)
    large, small = entries
    return [label, *(large if cells[0] else [*small[:2], *large[2:]]), *small[3:]]


def both(file: File, asked: str, suffix: str = "") -> tuple[Cell, Cell]:
    return file.cell(LARGE + suffix, asked), file.cell(SMALL + suffix, asked)


def gpu(doc: Document) -> None:
    peers, pairs, roofline = File("h200/peers"), File("h200/pairs"), File("h200/roofline")
    rate = roofline.document["run"]["copy_rate_bytes_per_s"]
    doc.says("at {} TB/s read plus written", rate * 1e-12)
    single, kd = both(peers, "oibvh-single"), both(pairs, "block over oibvh-single (kd, sorted leaves)", ONE_SET)
    doc.table("builds", f"< stage | {TITLES}", [
        *(row(f"`{stage}`", (single[0], None), stage, rate) for stage in ("bounds", "codes", "sort")),
        row("`codes`, `hilbert30`", (roofline.cell(LARGE, "oibvh-multi, hilbert30"), None), "codes", rate),
        row("`order`", (None, single[1]), "order", rate), row("`hierarchy`", single, "hierarchy", rate),
        row("whole build", single, "", rate), row("`hierarchy`, sorted leaves", kd, "hierarchy", rate),
        row("`hierarchy`, `oibvh-multi`", both(peers, "oibvh-multi"), "hierarchy", rate), row("`order`, `kd`", kd, "order", rate)])
    doc.table("queries", f"< stage | {TITLES}", [
        *(row(f"`broad`, {name}", both(roofline, f"{name} over oibvh-multi (sorted leaves)"), "broad", rate)
          for name in ("leaf", "group", "block", "bvtt (jump 2)")),
        row("`broad`, grid", both(roofline, "hierarchical grid"), "broad", rate),
        row("`narrow`", both(roofline, "leaf over oibvh-multi (sorted leaves)"), "narrow", rate)])


def two_cores(doc: Document) -> None:
    native, yardstick, multi = File("pocl-2-cores/native"), File("pocl-2-cores/yardstick"), "oibvh-multi"
    meshes = "bunny", "dragon_202520", "happy_buddha_1087716"
    doc.table("libraries", f"< builder | {' | '.join(meshes)}", (
        [f"`{asked}`", *(us(native.cell(scene, asked)) * 1e-3 for scene in meshes)]
        for asked in (multi, "oibvh-multi, hilbert30", "apetrei-fused", "embree-low", "fcl-aabb")))
    doc.says("takes {} to {} times as long as `oibvh-multi`", *ratios(*(
        [us(yardstick.cell(scene, name), "hierarchy") for scene in dict.fromkeys(cell.scene for cell in yardstick.cells)]
        for name in ("oibvh-host", multi))))


def frames_of_two_cores(doc: Document) -> None:
    """What the frames of three scenes take, to what they took."""
    files = [File(f"turns/frames-{name}").cells for name in ("before", "after")]

    def gains(*stages: str) -> list[float]:
        return [us(now, *stages) / us(before, *stages) for before, now in zip(*files, strict=True)]

    doc.says("`broad` takes {} of what it took on bunny_69451, {} on `unc_cloth_ball` and {} between the objects", *gains("broad"))
    doc.says("a whole frame\n{}, {} and {}, with", *gains())


def launches(doc: Document) -> None:
    files = [File(f"turns/gpu-frames-{name}").cells for name in ("before", "after")]
    doc.table("launches", "< scene | frame | before | now | those stages: before | now", (
        [now.scene, now.frame + 1, us(before), us(now), us(before, *FEWER), us(now, *FEWER)]
        for before, now in zip(*files, strict=True)))


def quotes(doc: Document) -> None:
    gpu(doc)
    launches(doc)
    frames_of_two_cores(doc)
    two_cores(doc)
