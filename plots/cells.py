"""A cell of a result file: what was measured of one builder or pipeline on one scene, with its times and what it is called."""
import functools
import json
from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy

import names

Item = TypeVar("Item")
OF_SCENE = {"frame": 0, "stand_in_for": "", "objects_by": "", "between": 0}  # what tells scenes of one name apart, and is usual
Sample = dict[str, dict[str, Any]]  # stage name to its numbers, in the order in which stages ran


class Quantiles(NamedTuple):
    p10: float
    median: float
    p90: float


def quantiles(values: Sequence[float]) -> Quantiles:
    return Quantiles(*(float(value) for value in numpy.quantile(values, (0.1, 0.5, 0.9))))


def median(values: Sequence[float]) -> float:
    """The median, or 0 if there are no values."""
    return float(numpy.median(values)) if len(values) else 0.0


def grouped(items: Iterable[Item], key: Callable[[Item], Hashable]) -> dict[Any, list[Item]]:
    """Those of one key together, keys and items in the order in which they come."""
    groups: dict[Hashable, list[Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def elapsed_ns(stage: dict[str, Any]) -> int:
    """First start to last end on the device's clock, else the host's clock."""
    return stage["span_ns"] if "span_ns" in stage else stage["wall_ns"]


def whole_ns(sample: Sample) -> int:
    """From the first start to the last end: on the device's clock as it tells since format 1.4; host stages run by themselves,
    so their times are added."""
    stages = sample.values()
    total = sum(elapsed_ns(stage) for stage in stages)
    if any("wall_ns" in stage for stage in stages):
        return total
    return max(total, *(stage.get("start_ns", 0) + stage["span_ns"] for stage in stages), 0)


def by_stage(sample: dict[str, Any]) -> Sample:
    return {entry["stage"]: entry for entry in sample["stages"]}


def times_ns(samples: Iterable[Sample], stage: str = "") -> numpy.ndarray:
    """Times of a stage, of the samples that have it; without a stage, whole times of all samples."""
    return numpy.array([elapsed_ns(sample[stage]) if stage else whole_ns(sample) for sample in samples
                        if not stage or stage in sample], dtype=float)


def counted(samples: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those that statistics are made of: no drift of the device was near, unless it was near most of them."""
    steady = [sample for sample in samples if not sample.get("drifted", False)]
    return steady if 2 * len(steady) >= len(samples) else samples


class Cell:
    """A cell as it is in the file, `raw`, and what it tells. One that was not measured, or is wrong, has no samples."""

    def __init__(self, raw: dict[str, Any]) -> None:
        self.raw = raw
        facts, collider = raw["scene"], raw.get("collider", {})
        self.experiment: str = raw["experiment"]
        self.scene_facts: dict[str, Any] = facts
        self.scene: str = names.scene(facts)
        self.triangles: int = facts.get("triangles", 0)
        self.frame: int = facts.get("frame", 0)  # from 0
        self.stand_in_for: str | None = facts.get("stand_in_for")
        self.outlier: dict[str, Any] | None = facts.get("outlier")  # which triangle of which scene was moved, and how far
        self.builder: str = raw["builder"]["name"]
        self.options = sorted_options(raw["builder"])
        self.collider: str | None = collider.get("name")  # what queried the tree; its builder is "none" if it wants no tree
        self.collider_options = sorted_options(collider)
        self.operation: str = raw.get("operation", "build")  # build, refit, collide or, along an axis, accuracy
        self.status: str = raw["status"]
        self.reason: str = raw.get("reason", "")  # why it was skipped or failed
        self.check: dict[str, Any] = raw.get("check", {})
        self.counters: dict[str, float] = raw.get("counters", {})
        self.left_out: dict[str, str] = raw.get("left_out", {})  # a counter that has no value, and why
        self.leaves_by_depth: list[int] = raw.get("leaves_by_depth", [])  # from the root's level on; empty before format 1.3
        self.accuracy: dict[str, Any] = raw.get("accuracy", {})  # on which axis, by which method, of which seed; empty if on none
        self.swept: dict[str, Any] = raw.get("swept", {})  # which pairs, to which frame; empty if boxes are of one frame

    @property
    def verdict(self) -> str:
        """"agrees", "differs", "counted" or "not checked" of what was measured, else "skipped" or "failed"."""
        return self.check.get("verdict", "not_checked").replace("_", " ") if self.status == "measured" else self.status

    @property
    def checked(self) -> bool:
        """Held to an answer that is right, be it that errors are counted."""
        return self.verdict in ("agrees", "counted")

    @property
    def has_times(self) -> bool:
        """Whether its times may be shown: it was measured, and is not wrong."""
        return self.status == "measured" and self.verdict != "differs" and bool(self.all_samples)

    @property
    def all_samples(self) -> list[dict[str, Any]]:
        """As they are in the file, those beside drift of the device too."""
        return self.raw.get("samples", [])

    @functools.cached_property
    def samples(self) -> list[Sample]:
        """Those that count, each as stage name to its numbers."""
        return [by_stage(sample) for sample in counted(self.all_samples)]

    def times_ns(self, stage: str = "") -> numpy.ndarray:
        """Times of a stage, or whole times, of the samples that count."""
        return times_ns(self.samples, stage)

    def times_s(self, stage: str = "") -> numpy.ndarray:
        return self.times_ns(stage) * 1e-9

    def median_ns(self, stage: str = "") -> float:
        """The median of times_ns; 0 if no sample has the stage."""
        return median(self.times_ns(stage))

    @property
    def on_host(self) -> bool:
        return any("wall_ns" in entry for sample in self.samples for entry in sample.values())

    def moved_bytes(self, stage: str) -> float | None:
        """The least the stage must read and write; host stages do not say."""
        return self.samples[0].get(stage, {}).get("moved_bytes") if self.samples else None

    @property
    def starts_from_leaves(self) -> bool:
        """Whether a build began with sorted leaves, as its samples tell: the hierarchy alone was timed."""
        first = self.samples[0] if self.samples else {}
        return self.operation == "build" and list(first) == ["hierarchy"] and first["hierarchy"].get("launches", 0) > 0

    @property
    def called(self) -> str:
        """In figures: the pipeline of a frame, the builder of a build."""
        if self.collider is None:
            return self.builder
        return names.pipeline(self.collider, dict(self.collider_options), self.builder, dict(self.options))

    @property
    def pipeline(self) -> str:
        """On the console: what was measured, with all options that are not the usual ones."""
        if self.operation == "accuracy":
            return f"{self.accuracy['axis']}, {self.accuracy['method']}"
        builder = names.in_full(self.raw["builder"])
        if self.operation == "collide":
            swept = f"{self.swept['pairs']} by " if self.swept else ""
            return f"{swept}{names.in_full(self.raw['collider'])}{'' if self.builder == 'none' else f' over {builder}'}"
        return f"{builder}, refit" if self.operation == "refit" else builder

    @property
    def label(self) -> str:
        """On the console: scene and pipeline."""
        frame = f", frame {self.frame}" if self.operation == "collide" or self.frame > 0 else ""
        return f"{self.scene}{frame}: {self.pipeline}{', from sorted leaves' if self.starts_from_leaves else ''}"

    @property
    def identity(self) -> str:
        return identity(self.raw)

    def key(self, *names: str, without: str = "") -> tuple[Hashable, ...]:
        """Some of its parts, of its collider `without` one of its options."""
        own = parts(self.raw, without)
        return tuple(own.get(name) for name in names)


def sorted_options(choice: dict[str, Any]) -> tuple[tuple[str, str], ...]:
    return tuple(sorted((key, str(value)) for key, value in choice.get("options", {}).items()))


def choice(raw: dict[str, Any], without: str = "") -> tuple[str, tuple[tuple[str, str], ...]]:
    """A builder or collider with its options; one that has its usual value may be absent in a file, and is left out."""
    return raw["name"], tuple((key, value) for key, value in sorted_options(raw) if value != names.USUAL.get(key) and key != without)


def parts(raw: dict[str, Any], without: str = "") -> dict[str, Any]:
    """What a cell is about, whatever came of it. It has every option, also those that this reader does not know. An option that
    a file of an older format lacks has its usual value."""
    scene = raw["scene"] if isinstance(raw["scene"], dict) else {"name": raw["scene"]}
    told = {name: raw[name] for name in ("experiment", "accuracy", "family", "system") if name in raw}
    told |= {part: choice(raw[part], without) for part in ("builder", "collider") if part in raw}
    told |= {name: scene.get(name, usual) for name, usual in OF_SCENE.items()}
    swept, sampling = raw.get("swept", {}), raw.get("sampling", {})
    return told | {"scene": scene["name"], "operation": raw.get("operation", "build"), "caches": sampling.get("caches", "hot"),
                   "swept": (swept.get("pairs"), swept.get("to_frame"))}


def identity(raw: dict[str, Any]) -> str:
    """Cells of two files with the same identity are the same cell."""
    return json.dumps(parts(raw), sort_keys=True)
