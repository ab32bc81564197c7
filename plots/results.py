"""The only reader of result files (results/schema): refuses what must not be plotted."""
import functools
import json
import os
import pathlib
from collections import defaultdict
from dataclasses import dataclass, field
from typing import Any

import documents
import names
import shape
from cells import Cell, Quantiles, grouped, median, quantiles  # noqa: F401  (for figures, which read results alone)
from documents import FOLDER, MAJOR, check_of
from json_files import Refused, parsed

PAPER = FOLDER / "paper"
USUAL_COSTS = (1.2, 1.0)  # Aila, Karras and Laine 2013: of an inner node and of a triangle


@dataclass
class Run:
    """A result file, `document`; of one that figures are made of, its cells, with those that have no numbers apart."""

    path: pathlib.Path
    document: dict[str, Any]
    cells: list[Cell] = field(default_factory=list)
    without_numbers: list[Cell] = field(default_factory=list)

    @property
    def facts(self) -> dict[str, Any]:
        return self.document["run"]

    @property
    def stress(self) -> list[dict[str, Any]]:
        """What `bvhbench stress` found, as in the file; empty before format 1.6."""
        return self.document.get("stress", [])

    @functools.cached_property
    def all_cells(self) -> list[Cell]:
        """In the file's order, skipped, failed and wrong ones too."""
        return [Cell(cell) for cell in self.document["cells"]]

    def copy_rate_of(self, cell: Cell) -> float:
        """The copy rate of the run that the cell is from; 0 if it was not measured."""
        rates = {source["id"]: source.get("copy_rate_bytes_per_s", 0) for source in self.document.get("merged_from", [])}
        return rates.get(cell.raw.get("run"), 0) or self.copy_rate or 0

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
        """What an inner node and a triangle cost in sah_cost and epo."""
        return costs_of(self.facts)

    def of(self, experiment: str) -> list[Cell]:
        return [cell for cell in self.builds if cell.experiment == experiment]

    def all_frames(self, experiment: str) -> list[Cell]:
        """Whole frames, from vertices to pairs or contacts."""
        return [cell for cell in self.cells if cell.experiment == experiment and cell.operation == "collide" and cell.samples]

    def frames(self, experiment: str) -> list[Cell]:
        """As all_frames. Raises Refused if there are none."""
        if not (cells := self.all_frames(experiment)):
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
        builders: dict[tuple[str, str, str], list[str]] = defaultdict(list)
        missing = [cell for cell in self.without_numbers if cell.experiment == experiment]
        for (builder, status, reason), cells in grouped(missing, lambda cell: (cell.called, cell.status, cell.reason)).items():
            places = [scene + (f" ({names.frames([cell.frame for cell in there])})" if there[0].collider else "")
                      for scene, there in grouped(cells, lambda cell: cell.scene).items()]
            builders[status, ", ".join(places), reason].append(builder)
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
        return (f"{device['name']}, driver {device['driver']}, {device['opencl_c']}; "
                f"commit {program['commit'][:10]}{state}{build}{each}")


def costs_of(facts: dict[str, Any]) -> tuple[float, float]:
    """The costs of an inner node and a triangle. Files before format 1.2 have the usual ones."""
    costs = facts.get("node_costs", {})
    return tuple(float(costs.get(key, usual)) for key, usual in zip(("inner", "triangle"), USUAL_COSTS))


def costs_text(costs: tuple[float, float]) -> str:
    return "an inner node {:.10g}, a triangle {:.10g}".format(*costs)


def is_result(path: pathlib.Path) -> bool:
    """Whether a JSON file means to be a result file, of any format. One that cannot be read may be one."""
    try:
        document = parsed(path)
    except Refused:
        return True
    return isinstance(document, dict) and {"format", "run", "cells"} <= document.keys()


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
    return Run(path, document, [cell_of(path, cell) for cell in document["cells"] if cell["status"] == "measured"],
               [Cell(cell) for cell in document["cells"] if cell["status"] != "measured"])


def everything(path: str | os.PathLike[str]) -> Run:
    """Read a result file with what no figure may be made of: wrong answers, merged devices, runs under test hooks. Raises Refused
    for what is no result file."""
    return Run(pathlib.Path(path), documents.read(os.fspath(path)))


def cell_of(path: pathlib.Path, raw: dict[str, Any]) -> Cell:
    """Raises Refused for a wrong answer."""
    cell = Cell(raw)
    if cell.verdict == "differs":
        detail = cell.check.get("detail", "no detail given")
        raise Refused(f"{path}: {cell.called} gave a wrong answer on {cell.scene_facts['name']}: {detail}")
    return cell


def printed(name: str) -> dict[str, Any]:
    """Numbers printed in the paper: 'table1' to 'table4', 'fig8'."""
    return json.loads((PAPER / f"{name}.json").read_text(encoding="utf-8"))


def printed_device(name: str) -> str:
    return printed(name)["device"].removeprefix("NVIDIA GeForce ")
