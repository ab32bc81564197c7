"""The only reader of result files (results/schema): refuses what must not be plotted, and does the statistics.

Files hold raw samples; medians and quantiles are taken here and nowhere else.
"""
from __future__ import annotations

import functools
import json
import pathlib
from dataclasses import dataclass
from typing import Any

import numpy

import names
import shape
from json_files import Refused, parsed

MAJOR = "1"
FOLDER = pathlib.Path(__file__).resolve().parent.parent / "results"
PAPER = FOLDER / "paper"
SCHEMA = FOLDER / "schema" / "result-1.schema.json"


@dataclass(frozen=True)
class Quantiles:
    """Of one quantity over a cell's samples."""

    p10: float
    median: float
    p90: float


@dataclass(frozen=True)
class Cell:
    """One builder measured on one scene."""

    experiment: str
    scene: str
    triangles: int
    stand_in_for: str | None
    outlier: dict[str, Any] | None  # which triangle of which scene was moved, and how far
    builder: str
    options: tuple[tuple[str, str], ...]
    operation: str  # what was timed: build, refit, collide or, along an axis, accuracy
    frame: int  # of the scene, from 0
    collider: str | None  # what queried the tree; its builder is "none" if it wants no tree
    collider_options: tuple[tuple[str, str], ...]
    checked: bool  # held to an answer that is right, be it that errors are counted
    counters: dict[str, float]
    samples: list[dict[str, dict[str, Any]]]  # per sample: stage name to its numbers
    left_out: dict[str, str]  # a counter that has no value, and why
    leaves_by_depth: list[int]  # from the root's level on; empty before format 1.3
    accuracy: dict[str, Any]  # on which axis, by which method, of which seed; empty if on none
    swept: dict[str, Any]  # which pairs, to which frame, of how many boxes; empty if boxes are of one frame

    def times_s(self, stage: str) -> numpy.ndarray:
        """Seconds per sample: first start to last end on the device's clock, else the host's clock."""
        stages = (sample[stage] for sample in self.samples if stage in sample)
        times = [entry["span_ns"] if "span_ns" in entry else entry["wall_ns"] for entry in stages]
        return numpy.array(times, dtype=float) * 1e-9

    def whole_times_s(self) -> numpy.ndarray:
        """Seconds per sample from the first start to the last end: on the device's clock as it tells since format 1.4,
        and host stages, which run by themselves, added."""
        times = []
        for sample in self.samples:
            entries = sample.values()
            on_device = [entry.get("start_ns", 0) + entry["span_ns"] for entry in entries if "span_ns" in entry]
            on_host = [entry["wall_ns"] for entry in entries if "wall_ns" in entry]
            spans = sum(entry["span_ns"] for entry in entries if "span_ns" in entry)
            times.append((max(spans, *on_device, 0) if on_device and not on_host else spans) + sum(on_host))
        return numpy.array(times, dtype=float) * 1e-9

    @property
    def called(self) -> str:
        """The pipeline of a frame, the builder of a build."""
        if self.collider is None:
            return self.builder
        return names.pipeline(self.collider, dict(self.collider_options), self.builder, dict(self.options))

    @property
    def on_host(self) -> bool:
        return any("wall_ns" in entry for sample in self.samples for entry in sample.values())

    def moved_bytes(self, stage: str) -> float | None:
        """The least the stage must read and write; host stages do not say."""
        return self.samples[0].get(stage, {}).get("moved_bytes") if self.samples else None


@dataclass(frozen=True)
class Run:
    """A result file: its circumstances and its cells, with those that have no numbers apart."""

    path: pathlib.Path
    facts: dict[str, Any]
    cells: list[Cell]
    without_numbers: list[dict[str, Any]]
    stress: list[dict[str, Any]]  # what `bvhbench stress` found, as in the file; empty before format 1.6

    @property
    def device(self) -> str:
        return self.facts["device"]["name"]

    @property
    def copy_rate(self) -> float | None:
        return self.facts.get("copy_rate_bytes_per_s")

    @property
    def launch_cost_s(self) -> float:
        """Of a launch that has nothing to do; before format 1.5 it was not measured, and counts as nothing."""
        return self.facts.get("launch_cost_ns", 0) * 1e-9

    @property
    def builds(self) -> list[Cell]:
        """What figures of builders are made of: a refit's times and trees are no build's."""
        return [cell for cell in self.cells if cell.operation == "build"]

    @property
    def costs(self) -> tuple[float, float]:
        """Of an inner node and of a triangle, in sah_cost and epo."""
        costs = self.facts.get("node_costs", {})  # before format 1.2 there were only Aila's
        return float(costs.get("inner", 1.2)), float(costs.get("triangle", 1.0))

    def of(self, experiment: str) -> list[Cell]:
        return [cell for cell in self.builds if cell.experiment == experiment]

    def has_frames(self, experiment: str) -> bool:
        return any(cell.experiment == experiment and cell.operation == "collide" and cell.samples for cell in self.cells)

    def frames(self, experiment: str) -> list[Cell]:
        """Whole frames, from vertices to pairs or contacts. Raises Refused if there are none."""
        cells = [cell for cell in self.cells
                 if cell.experiment == experiment and cell.operation == "collide" and cell.samples]
        if not cells:
            raise Refused(f"{self.path}: no measured frame of {experiment}")
        return cells

    def timed(self, experiment: str, stage: str) -> list[Cell]:
        """Those that a figure of this stage can show. Raises Refused if there are none."""
        cells = [cell for cell in self.of(experiment) if len(cell.times_s(stage))]
        if not cells:
            raise Refused(f"{self.path}: no measured cell of {experiment} has a stage '{stage}'")
        return cells

    def left_out(self, experiment: str) -> list[str]:
        """Who has no numbers where and why, a sentence for each group of builders or pipelines and scenes."""
        scenes: dict[tuple[str, str, str], dict[str, list[int]]] = {}
        for cell in self.without_numbers:
            if cell["experiment"] == experiment:
                why = (called(cell), cell["status"], cell["reason"])
                frames = scenes.setdefault(why, {}).setdefault(names.scene(cell["scene"]), [])
                if "collider" in cell:
                    frames.append(cell["scene"].get("frame", 0))
        builders: dict[tuple[str, str, str], list[str]] = {}
        for (builder, status, reason), where in scenes.items():
            places = [scene + (f" ({names.frames(frames)})" if frames else "") for scene, frames in where.items()]
            builders.setdefault((status, ", ".join(places), reason), []).append(builder)
        return [f"{('; ' if ',' in ''.join(who) else ', ').join(who)} {status} on {where}: {reason}"
                for (status, where, reason), who in builders.items()]

    def costs_remark(self) -> str:
        return "An inner node costs {}, a triangle {}, in shares of the root's area.".format(*self.costs)

    def circumstances(self) -> str:
        """One line for under a figure: what it ran on and which program it was."""
        program, device = self.facts["program"], self.facts["device"]
        state = " with local changes" if program["dirty"] else ""
        build = "" if program["build_type"] == "Release" else f", {program['build_type']} build"
        counts = sorted({len(cell.samples) for cell in self.cells})
        samples = "–".join(str(count) for count in dict.fromkeys((counts[0], counts[-1]))) if counts else "0"
        each = "" if self.stress else f"; {samples} sample{'' if samples == '1' else 's'} a cell"
        return (f"{self.device}, driver {device['driver']}, {device['opencl_c']}; "
                f"commit {program['commit'][:10]}{state}{build}{each}")


def quantiles(values: numpy.ndarray) -> Quantiles:
    return Quantiles(*(float(value) for value in numpy.quantile(values, (0.1, 0.5, 0.9))))


def is_result(path: pathlib.Path) -> bool:
    """Whether a JSON file means to be a result file, of any format. One that cannot be read may be one."""
    try:
        document = parsed(path)
    except Refused:
        return True
    return isinstance(document, dict) and {"format", "run", "cells"} <= document.keys()


@functools.cache
def schema() -> dict[str, Any]:
    return json.loads(SCHEMA.read_text(encoding="utf-8"))


@functools.cache
def check_of(part: str) -> shape.Check:
    """Of a part that the schema defines, or of the whole file."""
    return shape.check_of(schema()["$defs"][part] if part else schema(), schema())


def check(path: pathlib.Path, value: Any, part: str = "") -> None:
    """Raises Refused if it is not as results/schema says."""
    try:
        check_of(part)(value)
    except shape.Wrong as wrong:
        raise Refused(f"{path}: not a result file: {wrong}") from wrong


def document_of(path: pathlib.Path) -> dict[str, Any]:
    """A result file as it is, wrong answers and all. Raises Refused for another format and for what the schema does not allow."""
    document = parsed(path)
    if not isinstance(document, dict) or not isinstance(document.get("format"), str):
        raise Refused(f"{path}: not a result file")
    if document["format"].split(".")[0] != MAJOR:
        raise Refused(f"{path}: format {document['format']}, while this reader knows {MAJOR}.x")
    check(path, document)
    return document


def load(path: pathlib.Path) -> Run:
    """Read a result file. Raises Refused for another format and for a cell whose answer was wrong."""
    document = document_of(path)
    devices = sorted({f"{source['device']}, driver {source['driver']}" for source in document.get("merged_from", [])})
    if len(devices) > 1:
        raise Refused(f"{path}: merged from several devices, which no figure tells apart: {'; '.join(devices)}")
    for hook, value in document["run"].get("test_hooks", {}).items():
        raise Refused(f"{path}: made under the test hook {hook}={value}: it is no result")
    measured = [cell for cell in document["cells"] if cell["status"] == "measured"]
    without = [cell for cell in document["cells"] if cell["status"] != "measured"]
    return Run(path, document["run"], [cell_of(path, cell) for cell in measured], without,
               document.get("stress", []))


def called(cell: dict[str, Any]) -> str:
    """As Cell.called, of a cell that may have no numbers."""
    builder, collider = cell["builder"], cell.get("collider")
    if collider is None:
        return builder["name"]
    return names.pipeline(collider["name"], collider.get("options", {}), builder["name"], builder.get("options", {}))


def counted(samples: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those that statistics are made of: no drift of the device was near, unless it was near most of them."""
    steady = [sample for sample in samples if not sample.get("drifted", False)]
    return steady if 2 * len(steady) >= len(samples) else samples


def cell_of(path: pathlib.Path, cell: dict[str, Any]) -> Cell:
    scene, builder = cell["scene"], cell["builder"]
    if cell["check"]["verdict"] == "differs":
        detail = cell["check"].get("detail", "no detail given")
        raise Refused(f"{path}: {called(cell)} gave a wrong answer on {scene['name']}: {detail}")
    collider = cell.get("collider", {})
    options, collider_options = (tuple(sorted((key, str(value)) for key, value in choice.get("options", {}).items()))
                                 for choice in (builder, collider))
    samples = [{entry["stage"]: entry for entry in sample["stages"]} for sample in counted(cell["samples"])]
    return Cell(cell["experiment"], names.scene(scene), scene.get("triangles", 0), scene.get("stand_in_for"), scene.get("outlier"),
                builder["name"], options, cell.get("operation", "build"), scene.get("frame", 0), collider.get("name"), collider_options,
                cell["check"]["verdict"] in ("agrees", "counted"), cell["counters"],
                samples, cell.get("left_out", {}), cell.get("leaves_by_depth", []), cell.get("accuracy", {}),
                cell.get("swept", {}))


def printed(name: str) -> dict[str, Any]:
    """Numbers printed in the paper: 'table1' to 'table4', 'fig8'."""
    return json.loads((PAPER / f"{name}.json").read_text(encoding="utf-8"))
