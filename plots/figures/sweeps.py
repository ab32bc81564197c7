"""Figures of sweeps and of experiments of one's own: whatever their cells can be drawn as.

Builds of a generated scene in several sizes: how each stage grows, a figure a kind of scene (as scaling.py). Builds in several
orders: time against surface area cost (as pareto_orders.py). Whole frames: milliseconds by stage (as frame_bars.py).
"""
import dataclasses
import functools
import pathlib
import re
from collections.abc import Iterator

from ..draw import figure, style
from ..read import results
from . import frame_bars, pareto_orders, scaling

# Experiments of the program have their own figures, or none.
OWN = {path.stem for path in (pathlib.Path(__file__).resolve().parents[2] / "harness" / "experiments").glob("*.json")}
MOST_PANELS = 8
MOST_BARS = 150
# Defaults of the options that change what is found.
ANSWERS = {"narrow": "none", "adjacent": "keep", "pairs_of": "all", "first": "False", "within": "none", "separation": "none"}
FRAME = "A frame is all from moved vertices to pairs, or to contacts where a narrow phase follows."


def plain(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9_-]+", "-", name).strip("-")


def scalings(run: results.Run, experiment: str, cells: list[results.Cell]) -> Iterator[tuple[str, figure.Draw]]:
    # A kind is the name of a scene without its number of triangles.
    kinds = results.grouped(cells, lambda cell: re.sub(rf":{cell.triangles}(?=:|$)", "", cell.scene))
    several = {kind: sized for kind, sized in kinds.items() if len({cell.triangles for cell in sized}) > 1}
    for kind, sized in several.items():
        among = style.in_order(sized)
        if len(style.extras(among)) > len(style.VARIANT_LOOKS):  # some would look alike
            continue
        suffix = f"-{plain(kind)}" if len(several) > 1 else ""
        yield f"scaling{suffix}", functools.partial(scaling.draw, experiment=experiment, cells=sized)


def frame_figures(run: results.Run, experiment: str) -> Iterator[tuple[str, figure.Draw]]:
    """Returns one figure for each set of requested answers, because they take different times."""
    def asked_of(cell: results.Cell) -> tuple[str, ...]:
        options = dict(cell.collider_options)
        return *(options.get(key, usual) for key, usual in ANSWERS.items()), cell.features.get("pairs", "")

    for asked, cells in results.grouped(run.all_frames(experiment), asked_of).items():
        if len({(cell.scene, cell.called) for cell in cells}) > MOST_BARS:
            continue
        said = [f"{key} {value}" for (key, usual), value in zip(ANSWERS.items(), asked[:-1], strict=True) if value != usual]
        said += [asked[-1]] if asked[-1] else []
        remarks = (FRAME + (f" Asked for: {', '.join(said)}." if said else ""),)
        shown = dataclasses.replace(run, cells=cells)
        yield ("-".join(["frames", *filter(None, [plain("-".join(said))])]),
               lambda _, shown=shown, remarks=remarks: frame_bars.draw(shown, experiment, remarks))


def figures_of(run: results.Run) -> dict[str, figure.Draw]:
    """Returns the figures by the name of the picture, without the file's name."""
    found: dict[str, figure.Draw] = {}
    for experiment in dict.fromkeys(cell.experiment for cell in run.cells if cell.experiment not in OWN):
        builds = [cell for cell in run.of(experiment) if cell.samples]
        found |= scalings(run, experiment, builds)
        orders = {pareto_orders.order_of(cell) for cell in builds if "sah_cost" in cell.counters} - {None}
        if len(orders) > 1 and len({cell.scene for cell in builds}) <= MOST_PANELS:
            found["orders"] = pareto_orders.draw
        found |= frame_figures(run, experiment)
    return found
