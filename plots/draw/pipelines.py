"""Whole frames by scene and pipeline. A pipeline is a builder and a collider with their options."""
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy

from ..read import results
from ..words import names
from . import figure, style

ROW = 0.2  # inches for each bar
LONGEST_TITLE = 64  # letters, above a panel and not above its labels
COUNTED = " †"  # marks a pipeline whose wrong contacts were counted
WRONG = ("missed_count", "false_count", "contacts_count")

# The marker of each collider, for pipelines that share a builder's colour. A collider without a tree has its own colour.
MARKERS = {"leaf": "o", "group": "s", "block": "D", "bvtt": "^", "front": "v", "front-leaf": "<", "embree-refit": "s", "fcl-refit": "s"}
COLOURS = {"grid": "#8C510A", "all-pairs": "#762A83", "sort-sweep": "#BF812D", "embree": "#009E73", "embree-refit": "#009E73", "fcl": "#F0E442", "fcl-refit": "#F0E442", "brute": "#000000"}


@dataclass(frozen=True)
class Pipeline:
    scene: str
    cells: list[results.Cell]  # one for each frame

    @property
    def first(self) -> results.Cell:
        return self.cells[0]

    @property
    def later(self) -> "Pipeline":
        """Returns the pipeline over the frames after the first, in which caches, fronts and trees to refit are there; of one frame,
        that frame."""
        return Pipeline(self.scene, self.cells[1:] or self.cells)

    @property
    def first_ms(self) -> float | None:
        """Returns the median time of the first frame of several, in milliseconds."""
        return results.median(self.first.times_s()) * 1e3 if len(self.cells) > 1 else None

    @property
    def label(self) -> str:
        return self.first.called + (COUNTED if self.is_counted else "")

    @property
    def is_counted(self) -> bool:
        """True if the pipeline may find wrong contacts, which were counted."""
        return any(cell.verdict == "counted" for cell in self.cells)

    @property
    def errors(self) -> str:
        """Returns how many contacts of all frames were missed and how many are false: "3 missed, 0 false of 1,200"."""
        missed, false, of = (sum(cell.counters.get(key, 0) for cell in self.cells) for key in WRONG)
        return f"{missed:,.0f} missed, {false:,.0f} false of {of:,.0f} found"

    @property
    def colour(self) -> str:
        collider = self.first.collider or ""
        return COLOURS.get(collider) or style.look(collider if collider in names.OUTSIDE else self.first.builder).colour

    @property
    def marker(self) -> str:
        return MARKERS.get(self.first.collider or "", "P")

    def frame_ms(self) -> numpy.ndarray:
        """Returns the median time of each frame, in milliseconds."""
        return numpy.array([results.median(cell.times_s()) for cell in self.cells]) * 1e3

    def stage_ms(self, stage: str) -> float:
        """Returns the mean over frames of the stage's medians in milliseconds; a frame without the stage counts as 0."""
        times = [results.median(cell.times_s(stage)) for cell in self.cells if stage in cell.samples[0]]
        return sum(times) / len(self.cells) * 1e3

    def mean(self, counter: str) -> float | None:
        values = [cell.counters[counter] for cell in self.cells if counter in cell.counters]
        return sum(values) / len(values) if values else None


def grouped_by_pipeline(cells: list[results.Cell], without: str = "") -> list[list[results.Cell]]:
    """Groups cells by pipeline, ignoring the collider's option `without`."""
    return list(results.grouped(cells, lambda cell: cell.key("collider", "builder", without=without)).values())


def of(run: results.Run, experiment: str) -> dict[str, list[Pipeline]]:
    """Returns the pipelines of each scene, both in the file's order. A scene that is there at its real step is not drawn with frames in
    between as well."""
    cells = run.frames(experiment)
    real = {cell.scene_facts["name"] for cell in cells if not cell.scene_facts.get("between")}
    scenes = results.grouped([cell for cell in cells if not cell.scene_facts.get("between") or cell.scene_facts["name"] not in real],
                             lambda cell: cell.scene)
    return {scene: [Pipeline(scene, frames) for frames in grouped_by_pipeline(cells)] for scene, cells in scenes.items()}


def panels(scenes: dict[str, list[Pipeline]], more: float) -> tuple[plt.Figure, list[plt.Axes]]:
    """Creates one panel below the other, each with height for its bars and `more` additional bars."""
    return figure.stacked([len(shown) + more for shown in scenes.values()], ROW, 0.7, sharex=True)


def frames_of(shown: list[Pipeline]) -> int:
    return len({cell.frame for pipeline in shown for cell in pipeline.cells})


def scene_title(shown: list[Pipeline], between: str = " ") -> str:
    cell = shown[0].first
    name, frames = scene_name(cell), frames_of(shown)
    asked = dict(cell.collider_options).get("pairs_of", "all")
    name += "" if asked == "all" else f", {asked} objects"
    return f"{name}:{between}{cell.triangles:,} triangles, {frames} frame{'' if frames == 1 else 's'}"


def scene_name(cell: results.Cell) -> str:
    real = ", real step" if cell.is_frame and not cell.scene_facts.get("between") and cell.scene_facts.get("source") != "generated" else ""
    return f"{cell.stand_in_for}*{real} ({cell.scene})" if stands_in(cell) else cell.scene


def stands_in(cell: results.Cell) -> bool:
    return cell.stand_in_for not in (None, cell.scene)


def remarks(scenes: dict[str, list[Pipeline]]) -> tuple[str, ...]:
    """Returns the explanation of the star if a scene is a stand-in, and the errors of pipelines that are not exact."""
    starred = any(stands_in(shown[0].first) for shown in scenes.values())
    star = "* was not there: the scene in brackets stands in, with its own numbers of triangles and frames."
    counted = dict.fromkeys(f"{scene}: {one.errors}" for scene, shown in scenes.items() for one in shown if one.is_counted)
    return ((star,) if starred else ()) + ((f"† rounds, so contacts may be wrong; errors in all frames of {'; '.join(counted)}.",) if counted else ())


def apart(scenes: dict[str, list[Pipeline]]) -> str:
    """Returns which frames a mean is over."""
    several = any(len(one.cells) > 1 for shown in scenes.values() for one in shown)
    return "over frames after the first" if several else "over frames"


def labels(shown: list[Pipeline]) -> list[str]:
    """Returns the label of each pipeline, with the number of its frames if it lacks some of the scene's."""
    frames = frames_of(shown)
    return [one.label + ("" if len(one.cells) == frames else f", {len(one.cells)} of {frames} frames") for one in shown]


def dress(axes: plt.Axes, shown: list[Pipeline], room: float = 0) -> None:
    """Sets up a panel of horizontal bars, one row for each pipeline, with some room below them."""
    dress_rows(axes, labels(shown), room)
    title = scene_title(shown)
    axes.set_title(title, loc="left" if len(title) <= LONGEST_TITLE else "right")  # to the right it may begin above the labels


def dress_rows(axes: plt.Axes, rows: list[str], room: float = 0) -> None:
    axes.set_yticks(range(len(rows)), rows, fontsize=style.SMALL)
    axes.set_ylim(len(rows) - 0.4 + room, -0.6)
    axes.grid(axis="x")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def mark(axes: plt.Axes, row: int, value: float, pipeline: Pipeline) -> None:
    """Marks a value on a logarithmic axis, on which a bar's length would mean nothing."""
    axes.plot(value, row, pipeline.marker, color=pipeline.colour, markeredgecolor="#333333", markeredgewidth=0.4, markersize=5, zorder=3)


def told(axes: plt.Axes, row: int, end: float, text: str, room: int = 5) -> None:
    axes.annotate(f" {text}", (end, row), (room, 0), textcoords="offset points", va="center", fontsize=style.SMALL)
