from collections.abc import Iterator

from cells import Cell
from quotes import ONE_SET, Document, File, ratios, shown, us

LARGE, SMALL = "torus:2880000", "torus:144046"
TITLES = "bytes per triangle | launches | large: floor | reached | ratio | small: reached | ratio"


def bytes_of(cell: Cell, stage: str = "") -> float:
    """Returns the bytes that a stage, or all stages, must move."""
    return sum(cell.moved_bytes(one) for one in ([stage] if stage else cell.samples[0]))


def over_floor(cell: Cell, stage: str, rate: float) -> float:
    return us(cell, *filter(None, [stage])) / (bytes_of(cell, stage) / rate * 1e6)


def row(label: str, cells: tuple[Cell | None, Cell | None], stage: str, rate: float) -> list[float | str | None]:
    """Returns floors and times of a large and a small scene, either of which may lack the stage."""
    of = next(filter(None, cells))
    times = [[us(cell, *filter(None, [stage])), over_floor(cell, stage, rate)] if cell else [None, None] for cell in cells]
    return [label, round(bytes_of(of, stage) / of.triangles),
            sum(numbers["launches"] for name, numbers in of.samples[0].items() if stage in (name, "")),
            bytes_of(of, stage) / rate * 1e6 if cells[0] else None, *times[0], *times[1]]


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
    asked = {"leaf": "leaf", "group": "group", "block": "block", "bvtt (jump 2)": "`bvtt`, jump 2"}
    doc.table("queries", f"< stage | {TITLES}", [
        *(row(f"`broad`, {label if '`' in label else f'`{label}`'}", both(roofline, f"{name} over oibvh-multi (sorted leaves)"), "broad", rate)
          for name, label in asked.items()),
        row("`broad`, `grid`", both(roofline, "hierarchical grid"), "broad", rate),
        row("`narrow`", both(roofline, "leaf over oibvh-multi (sorted leaves)"), "narrow", rate)])


def two_cores(doc: Document) -> None:
    native, pairs, yardstick, multi = *(File(f"pocl-2-cores/{name}") for name in ("native", "native-pairs", "yardstick")), "oibvh-multi"
    meshes = "bunny", "dragon_202520", "happy_buddha_1087716"
    doc.table("libraries", f"< builder | {' | '.join(meshes)}", (
        [f"`{asked}`", *(us(native.cell(scene, asked)) * 1e-3 for scene in meshes)]
        for asked in (multi, "oibvh-multi, hilbert30", "apetrei-fused", "embree-low", "fcl-aabb")))
    doc.says("takes {} to {} times as long as `oibvh-multi`", *ratios(*(
        [us(yardstick.cell(scene, name), "hierarchy") for scene in dict.fromkeys(cell.scene for cell in yardstick.cells)]
        for name in ("oibvh-host", multi))))
    scenes = "two-spheres:198448:1", f"dragon_202520{ONE_SET}", "unc_cloth_ball"
    embree = [us(pairs.cell(scene, "embree"), "broad") for scene in scenes]

    def queries() -> Iterator[list[str | float]]:
        for builder in ("oibvh-multi (hilbert30, sorted leaves)", "oibvh-multi (sorted leaves)", multi, "apetrei-fused"):
            times = [us(pairs.cell(scene, f"group (without near) over {builder}"), "broad") for scene in scenes]
            yield [f"`group` over {builder}", *(f"{shown(time * 1e-3)}, {time / other:.2f}" for time, other in zip(times, embree, strict=True))]
        yield ["`rtcCollide`", *(time * 1e-3 for time in embree)]

    doc.table("native-pairs", "< | two-spheres:198448:1, between | dragon_202520 | unc_cloth_ball, frame 92", queries())


def quotes(doc: Document) -> None:
    gpu(doc)
    two_cores(doc)
