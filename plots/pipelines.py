"""Whole frames by scene and pipeline: a builder and a collider with their options, over the frames of a scene."""
from __future__ import annotations

from dataclasses import dataclass

import numpy
from matplotlib.colors import to_rgb

import results
import style

USUAL = {"order": "morton30", "group_size": "0", "items": "0", "leaves": "mesh", "jump": "0", "start_level": "0"}
SAID_ELSEWHERE = ("pairs_of", "adjacent", "narrow")  # the same of all pipelines of a figure, or the scene's

# A collider tells the pipelines of a builder apart by hatch; one without a tree has a colour of its own.
HATCHES = {"leaf": "", "group": "////", "bvtt": "....", "front": "xxxx"}
COLOURS = {"grid": "#8C510A", "embree": "#009E73", "fcl": "#F0E442", "brute": "#000000"}


@dataclass(frozen=True)
class Pipeline:
    """One pipeline over the frames of one scene."""

    scene: str
    cells: list[results.Cell]  # a frame each

    @property
    def first(self) -> results.Cell:
        return self.cells[0]

    @property
    def label(self) -> str:
        parts = [self.first.collider or ""]
        parts += said(self.first.collider_options)
        if self.first.builder != "none":
            parts[0] += f" over {self.first.builder}"
            parts += said(self.first.options)
        return ", ".join(parts)

    @property
    def colour(self) -> str:
        return COLOURS.get(self.first.collider or "", None) or style.look(self.first.builder).colour

    @property
    def hatch(self) -> str:
        return HATCHES.get(self.first.collider or "", "")

    def frame_ms(self) -> numpy.ndarray:
        """The median of each frame."""
        return numpy.array([float(numpy.median(cell.frame_times_s())) for cell in self.cells]) * 1e3

    def stage_ms(self, stage: str) -> float:
        """The mean over frames of their medians; 0 if it has no such stage."""
        times = [float(numpy.median(cell.times_s(stage))) for cell in self.cells if stage in cell.samples[0]]
        return sum(times) / len(self.cells) * 1e3

    def mean(self, counter: str) -> float | None:
        values = [cell.counters[counter] for cell in self.cells if counter in cell.counters]
        return sum(values) / len(values) if values else None


def said(options: tuple[tuple[str, str], ...]) -> list[str]:
    words = {"jump": "jump {}", "start_level": "from level {}", "group_size": "groups of {}", "items": "{} items",
             "order": "{}", "leaves": "{} leaves"}
    return [words[key].format(value) for key, value in options
            if key not in SAID_ELSEWHERE and key in words and USUAL.get(key) != value]


def of(run: results.Run, experiment: str) -> dict[str, list[Pipeline]]:
    """The pipelines of each scene, both in the file's order."""
    cells: dict[str, dict[tuple, list[results.Cell]]] = {}
    for cell in run.frames(experiment):
        key = (cell.collider, cell.collider_options, cell.builder, cell.options)
        cells.setdefault(cell.scene, {}).setdefault(key, []).append(cell)
    return {scene: [Pipeline(scene, frames) for frames in by_pipeline.values()] for scene, by_pipeline in cells.items()}


def scene_title(pipelines: list[Pipeline]) -> str:
    cell = pipelines[0].first
    name = f"{cell.scene}" + (f" (stands in for {cell.stand_in_for})" if cell.stand_in_for not in (None, cell.scene) else "")
    frames = len(pipelines[0].cells)
    return f"{name}: {cell.triangles:,} triangles, {frames} frame{'' if frames == 1 else 's'}"


def ink(colour: str) -> str:
    """Of hatches on a bar: lighter or darker than it."""
    return "white" if sum(to_rgb(colour)) < 1.6 else "#555555"
