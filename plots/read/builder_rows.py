"""Each builder of the experiment builders over each scene: its build, its memory, its tree, and the best of the colliders that query
its tree."""
import math
from dataclasses import dataclass

from . import ranking_text, results
from .cells import Cell, grouped
from .ranking import OF_QUERY

EXPERIMENT = "builders"


@dataclass
class Row:
    """A builder over a scene. `best` is the frame with the fastest query among the colliders measured; None if none queries its tree."""

    build: Cell
    best: Cell | None

    @property
    def label(self) -> str:
        return ranking_text.label(self.build)

    def rate(self, stage: str = "") -> float:
        """Returns millions of triangles a second, from triangles to tree or of one stage; not a number if that has no time."""
        ns = self.build.median_ns(stage)
        return self.build.triangles * 1e3 / ns if ns > 0 else math.nan

    def counter(self, name: str) -> float:
        return self.build.counters.get(name, math.nan)

    @property
    def reserved(self) -> float:
        """Returns the bytes that the builder reserves: tree and scratch, in memory of the device or of the host."""
        return self.counter("tree_bytes") + self.counter("scratch_bytes")

    @property
    def frame_ns(self) -> float:
        return self.best.median_ns() if self.best else math.nan

    @property
    def query_ns(self) -> float:
        return query_ns(self.best) if self.best else math.nan

    @property
    def collider(self) -> str:
        return self.best.collider or "" if self.best else ""


def query_ns(frame: Cell) -> float:
    return sum(frame.median_ns(stage) for stage in OF_QUERY)


def of_run(run: results.Run, experiment: str = EXPERIMENT) -> dict[str, list[Row]]:
    """Returns the rows of each scene in the file's order. A builder that has no time there has no row."""
    cells = [cell for cell in run.all_cells if cell.experiment == experiment and cell.verdict == "agrees" and cell.samples]
    frames = grouped((cell for cell in cells if cell.operation == "collide"), lambda cell: cell.key("scene", "builder"))
    best = {key: min(there, key=query_ns) for key, there in frames.items()}
    rows = [Row(cell, best.get(cell.key("scene", "builder"))) for cell in cells if cell.operation == "build"]
    return grouped(rows, lambda row: row.build.scene)
