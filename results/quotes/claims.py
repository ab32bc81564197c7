"""The claims of the paper that README.md, docs/results.md and docs/paper.md all judge: each verdict, and what it rests on, in the same words."""
import textwrap
from collections.abc import Iterable
from typing import NamedTuple

from plots.console.claims import REFIT, asked_of, verdict
from plots.evidence.quotes import Document, File, ends, later_ms, listed, ratios, sah, us
from plots.read import effects, families
from plots.read.cells import Cell, grouped

of_frames = listed("docs/collisions")
REAL = ("unc_cloth_ball", "unc_nbody")  # two frames of the paper's own sequences each, 92 and 93, 18 and 19
PRINTED = ("apetrei-fused, morton30-axis", "oibvh-multi, morton30-axis")
WIDTH = 140


class Claim(NamedTuple):
    """A claim, as a row of the table in docs/paper.md begins."""

    text: str
    printed: str  # the paper's figure
    rests: str  # what the verdict rests on
    verdict: str


def cost_ratios(file: File, scenes: Iterable[str]) -> list[float]:
    """Returns the cost of the paper's tree over that of the radix tree, both in the paper's order."""
    return [sah(file, scene, PRINTED[1]) / sah(file, scene, PRINTED[0]) for scene in scenes]


def scenes_of(file: File, part: str = "") -> list[str]:
    return list(dict.fromkeys(cell.scene for cell in file.cells if part in cell.scene))


def faster(file: File, rival: str) -> list[float]:
    """Returns how many times as long a rival's builds take as those of the faster of both implicit trees, by scene."""
    times = {name: [us(file.cell(scene, name)) for scene in scenes_of(file)] for name in (rival, "oibvh-single", "oibvh-multi")}
    return [theirs / min(ours) for theirs, *ours in zip(*times.values(), strict=True)]


def is_front(cell: Cell) -> bool:
    """True for a front that is kept, over a radix tree."""
    is_rebuilt = dict(cell.collider_options).get("update") == "rebuild"
    return families.of_cell(cell) == "front tracking" and families.of_builder(cell.builder) == "radix trees" and not is_rebuilt


def at_real_steps() -> tuple[str, list[float]]:
    """Returns the file that has the two real steps, and of each how many times as long as the pipeline the best front takes."""
    table2 = File("h200/table2")
    file = table2 if set(REAL) <= set(scenes_of(table2)) else File("h200/families")
    found = []
    for scene in REAL:
        cells = grouped((cell for cell in file.cells if cell.scene == scene and cell.has_times), lambda cell: cell.key("builder", "collider"))
        ours = next(there for there in cells.values() if asked_of(there[0]) in ("bvtt over oibvh-multi", of_frames.BVTT))
        found.append(min(later_ms(there) for there in cells.values() if is_front(there[0])) / later_ms(ours))
    return file.name.partition("/")[2], found


def average(values: Iterable[float]) -> float:
    found = list(values)
    return sum(found) / len(found)


def numbers(values: Iterable[float], places: int = 2) -> str:
    return " to ".join(f"{value:.{places}f}" for value in values)


def claims() -> dict[str, Claim]:
    """Returns the claims by a short name, in the paper's order. A verdict follows from the ratios that the text has."""
    table1, fig8, table2, table3, table4 = (File(f"h200/{name}") for name in ("table1", "fig8", "table2", "table3", "table4"))

    def times(file: File, scenes: Iterable[str], *asked: str) -> list[float]:
        return [min(later_ms(file.frames(scene, one)) for one in asked) for scene in scenes]

    scenes, cloths = of_frames.TABLE2.values(), of_frames.TABLE3.values()
    pipeline, fronts = times(table2, scenes, of_frames.BVTT), times(table2, scenes, *of_frames.RADIX)
    file, (cloth, bodies) = at_real_steps()
    radix, sizes, costs = faster(table1, "apetrei"), faster(fig8, "apetrei"), cost_ratios(table4, scenes_of(table4))
    fused, steps = ends(faster(table1, "apetrei-fused")), ratios(fronts, pipeline)
    refits = ratios(times(table2, scenes, REFIT), pipeline)
    grid = ratios(times(table3, cloths, "hierarchical grid"), times(table3, cloths, of_frames.BVTT))
    best = [min(of_frames.RADIX, key=lambda asked: later_ms(table2.frames(scene, asked))) for scene in scenes]
    held = [[of_frames.most_mb(table2.frames(scene, asked)) for asked in (of_frames.BVTT, front)]
            for scene, front in zip(scenes, best, strict=True)]
    shares = ratios(*zip(*held, strict=True))
    return {
        "build": Claim("Construction is faster than Apetrei's (Sec. 6.1)", "4.17 to 6.53 times, 5.1 on average",
                       f"{numbers(ends(radix))} times, {average(radix):.1f} on average; {numbers(fused)} times our best radix tree (`table1`)",
                       verdict([*radix, *fused])),
        "sizes": Claim("It is faster at every size (Fig. 8)", "3.2 to 6.2 times, 4.5 on average",
                       f"{numbers(ends(sizes))} times, {average(sizes):.1f} on average, 2^10 to 2^24 triangles (`fig8`)", verdict(sizes)),
        "front": Claim("The pipeline is up to 30 % faster than front tracking (Table 2)", "1 to 1.29 times",
                       f"{cloth:.2f} and {bodies:.2f} times at the real steps of two UNC scenes (`{file}`, one step each), "
                       f"{numbers(steps)} times at sixteenths of steps and on a generated cloth (`table2`)", verdict([cloth, bodies, *steps])),
        "memory": Claim("It takes less memory than front tracking (Table 2)", "5 to 58.4 %",
                        f"{numbers((100 * one for one in shares), 0)} % of the best front's (`table2`)", verdict([1 / one for one in shares])),
        "refit": Claim("Rebuilding is faster than refitting (Abstract)", "none",
                       f"refits without a front take {numbers(refits)} times as long, over the same tree by the same traversal (`table2`)",
                       verdict(refits)),
        "hashing": Claim("It is faster than spatial hashing (Table 3)", "36 to 98 times",
                         f"a hierarchical grid takes {numbers(grid)} of its time, three generated cloths (`table3`); I-Cloth, a binary library, "
                         "was not run", verdict(grid)),
        "quality": Claim("The radix tree has the better quality (Table 4)", "1.67 to 2.66 times the cost",
                         f"{numbers(ends(costs))} times, by the order of the leaves (`table4`)", verdict(costs))}


def bullets(doc: Document, *left_out: str) -> None:
    """The claims as a list, each with its verdict first."""
    lines = [textwrap.fill(f"- **{one.verdict.capitalize()}:** {one.text}: {one.rests}.", WIDTH, subsequent_indent="  ",
                           break_on_hyphens=False, break_long_words=False) for name, one in claims().items() if name not in left_out]
    doc.block("claims", "".join(f"{line}\n" for line in lines))


def rows(doc: Document) -> None:
    """The same as rows of a table."""
    for one in claims().values():
        doc.says(f"| {one.text} | {{}} | {{}} | {{}} |", one.printed, one.rests, one.verdict)


def radix_by_collider(doc: Document) -> None:
    """What a radix tree's frame takes beside an implicit tree's, all else equal, by collider."""
    cells = effects.frames_of(File("h200/effects").cells)
    by = [effects.ratio_of(effects.logs_of([cell for cell in cells if cell.collider == name], of_query=False), 0, "apetrei-fused").mean
          for name in ("leaf", "group", "block", "bvtt")]
    doc.says("adix tree's frame takes {} times as long as an implicit tree's with `leaf`, {} with `group`, {} with `block`, {} with `bvtt`", *by)
