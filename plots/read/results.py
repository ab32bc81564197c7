"""Reads result files (results/schema), and refuses what must not be plotted."""
import functools
import json
import os
import pathlib
from collections import defaultdict
from dataclasses import dataclass, field

from ..files import documents
from ..files.documents import FOLDER
from ..files.json_files import Json, Refused, parsed
from ..words import names
from .cells import Cell, Quantiles, grouped, median, quantiles  # noqa: F401  (for figures, which read results alone)

PAPER = FOLDER / "paper"
USUAL_COSTS = (1.2, 1.0)  # of an inner node and of a triangle (Aila, Karras and Laine 2013)


@dataclass
class Run:
    """A result file, `document`. If read for figures, it also has its cells; those without numbers are kept separately."""

    path: pathlib.Path
    document: Json
    cells: list[Cell] = field(default_factory=list)
    without_numbers: list[Cell] = field(default_factory=list)

    @property
    def facts(self) -> Json:
        return self.document["run"]

    @property
    def stress(self) -> list[Json]:
        """Returns the results of `bvhbench stress`, as in the file."""
        return self.document.get("stress", [])

    @functools.cached_property
    def all_cells(self) -> list[Cell]:
        """Returns all cells in the file's order, including skipped, failed and wrong ones."""
        return [Cell(cell) for cell in self.document["cells"]]

    def copy_rate_of(self, cell: Cell) -> float:
        """Returns the copy rate of the run that measured the cell; 0 if it was not measured."""
        rates = {source["id"]: source.get("copy_rate_bytes_per_s", 0) for source in self.document.get("merged_from", [])}
        return rates.get(cell.raw.get("run"), 0) or self.copy_rate or 0

    @property
    def copy_rate(self) -> float | None:
        return self.facts.get("copy_rate_bytes_per_s")

    @property
    def launch_cost_s(self) -> float:
        """Returns the cost of a launch without work, in seconds; 0 if it was not measured."""
        return self.facts.get("launch_cost_ns", 0) * 1e-9

    @property
    def builds(self) -> list[Cell]:
        """Returns the builds, for figures of builders. A refit's times and trees are not comparable."""
        return [cell for cell in self.cells if cell.operation == "build"]

    @property
    def costs(self) -> tuple[float, float]:
        """Returns the costs of an inner node and a triangle in sah_cost and epo."""
        return costs_of(self.facts)

    def of(self, experiment: str) -> list[Cell]:
        return [cell for cell in self.builds if cell.experiment == experiment]

    def all_frames(self, experiment: str) -> list[Cell]:
        """Returns the measured whole frames, from vertices to pairs or contacts."""
        return [cell for cell in self.cells if cell.experiment == experiment and cell.operation == "collide" and cell.samples]

    def frames(self, experiment: str) -> list[Cell]:
        """Returns all_frames. Raises Refused if there are none."""
        if not (cells := self.all_frames(experiment)):
            raise Refused(f"{self.path}: no measured frame of {experiment}")
        return cells

    def timed(self, experiment: str, stage: str) -> list[Cell]:
        """Returns the cells that have times of this stage. Raises Refused if there are none."""
        cells = [cell for cell in self.of(experiment) if len(cell.times_s(stage))]
        if not cells:
            raise Refused(f"{self.path}: no measured cell of {experiment} has a stage '{stage}'")
        return cells

    def left_out(self, experiment: str) -> list[str]:
        """Returns which builders or pipelines have no numbers, and why: one sentence for each group of them and of scenes."""
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
        """Returns one line for a figure's footer: device, program and number of samples."""
        program, device = self.facts["program"], self.facts["device"]
        state = " with local changes" if program["dirty"] else ""
        build = "" if program["build_type"] == "Release" else f", {program['build_type']} build"
        counts = sorted({len(cell.samples) for cell in self.cells})
        samples = "–".join(str(count) for count in dict.fromkeys((counts[0], counts[-1]))) if counts else "0"
        each = "" if self.stress else f"; {samples} sample{'' if samples == '1' else 's'} a cell"
        return (f"{device['name']}, driver {device['driver']}, {device['opencl_c']}; "
                f"commit {program['commit'][:10]}{state}{build}{each}")


def is_dirty(program: Json) -> bool:
    """True if no commit has the program. Older files may say that one of unknown commit has no changes."""
    return program["dirty"] or program["commit"] == "unknown"


def changes_text(program: Json) -> str:
    """Returns why a program is dirty, with up to three of the changed files that newer result files name."""
    if program["commit"] == "unknown":
        return "of unknown commit"
    files = program.get("changed_files", [])
    told = ", ".join(files[:3]) + (f" and {len(files) - 3} more" if len(files) > 3 else "")
    return "with changes that no commit has" + (f" ({told})" if told else "")


def costs_of(facts: Json) -> tuple[float, float]:
    """Returns the costs of an inner node and a triangle."""
    costs = facts.get("node_costs", {})
    return tuple(float(costs.get(key, usual)) for key, usual in zip(("inner", "triangle"), USUAL_COSTS, strict=True))


def costs_text(costs: tuple[float, float]) -> str:
    return "an inner node {:.10g}, a triangle {:.10g}".format(*costs)


def is_result(path: pathlib.Path) -> bool:
    """True if a JSON file has the keys of a result file, of any format, or cannot be read and so may be one."""
    try:
        document = parsed(path)
    except Refused:
        return True
    return isinstance(document, dict) and {"format", "run", "cells"} <= document.keys()


def document_of(path: pathlib.Path) -> Json:
    """Returns a result file, wrong answers included. Raises Refused for another format and for what is no result file."""
    return documents.checked(parsed(path), os.fspath(path))


def load(path: pathlib.Path) -> Run:
    """Reads a result file. Raises Refused for another format and for a cell of ours with a wrong answer; a method from outside has
    failed then."""
    document = document_of(path)
    devices = sorted({f"{source['device']}, driver {source['driver']}" for source in document.get("merged_from", [])})
    if len(devices) > 1:
        raise Refused(f"{path}: merged from several devices, which no figure tells apart: {'; '.join(devices)}")
    for hook, value in document["run"].get("test_hooks", {}).items():
        raise Refused(f"{path}: made under the test hook {hook}={value}: it is no result")
    try:
        hot = [cell for cell in document["cells"] if cell.get("sampling", {}).get("caches", "hot") == "hot"]  # which a figure shows
        cells = [failed_if_wrong(cell) for cell in hot or document["cells"]]
        return Run(path, document, [cell_of(path, cell) for cell in cells if cell["status"] == "measured"],
                   [Cell(cell) for cell in cells if cell["status"] != "measured"])
    except (AttributeError, LookupError, TypeError, ValueError) as error:
        raise Refused(f"{path} is no result file: {error}") from error


def everything(path: str | os.PathLike[str]) -> Run:
    """Reads a result file, including what must not be plotted: wrong answers, merged devices, runs under test hooks. Raises
    Refused if the file is not a result file."""
    return Run(pathlib.Path(path), documents.read(os.fspath(path)))


def failed_if_wrong(raw: Json) -> Json:
    """Returns the cell of a method from outside whose answer is wrong as one that failed, any other as it is."""
    if "outside" in raw and raw.get("check", {}).get("verdict") == "differs":
        return raw | {"status": "failed", "reason": f"wrong answer: {raw['check'].get('detail', 'no detail given')}"}
    return raw


def cell_of(path: pathlib.Path, raw: Json) -> Cell:
    """Raises Refused for a wrong answer."""
    cell = Cell(raw)
    if cell.verdict == "differs":
        detail = cell.check.get("detail", "no detail given")
        raise Refused(f"{path}: {cell.called} gave a wrong answer on {cell.scene_facts['name']}: {detail}")
    return cell


def printed(name: str) -> Json:
    """Returns numbers printed in the paper: 'table1' to 'table4', 'fig8'."""
    return json.loads((PAPER / f"{name}.json").read_text(encoding="utf-8"))


def printed_device(name: str) -> str:
    return printed(name)["device"].removeprefix("NVIDIA GeForce ")
