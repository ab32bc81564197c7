"""A cell of a result file: the measurement of one builder or pipeline on one scene, with its times and its display names."""
import functools
import json
from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy

from ..words import names

Item = TypeVar("Item")
OF_SCENE = {"frame": 0, "stand_in_for": "", "objects_by": "", "between": 0, "exclude": ""}  # what distinguishes scenes of one name; defaults
OF_RANKS = ("ranks_count", "partition", "boxes_count", "simulated", "shares_devices", "asked_frames", "rebalance")
MESSAGES_NS = 100_000  # least time that is put down to the messages of a method from outside
Sample = dict[str, dict[str, Any]]  # stage name to its numbers, in the order in which stages ran


class Quantiles(NamedTuple):
    p10: float
    median: float
    p90: float


def quantiles(values: Sequence[float]) -> Quantiles:
    return Quantiles(*(float(value) for value in numpy.quantile(values, (0.1, 0.5, 0.9))))


def median(values: Sequence[float]) -> float:
    """Returns the median, or 0 if there are no values."""
    return float(numpy.median(values)) if len(values) else 0.0


def grouped(items: Iterable[Item], key: Callable[[Item], Hashable]) -> dict[Any, list[Item]]:
    """Groups items by key. Keys and items keep the order in which they come."""
    groups: dict[Hashable, list[Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def elapsed_ns(stage: dict[str, Any]) -> int:
    """Returns the time from the first start to the last end on the device's clock, or else on the host's clock."""
    return stage["span_ns"] if "span_ns" in stage else stage["wall_ns"]


def whole_ns(sample: Sample) -> int:
    """Returns the time from the first start to the last end of a sample. Device stages are placed by their start_ns. Host stages do
    not overlap, so their times are added."""
    stages = sample.values()
    total = sum(elapsed_ns(stage) for stage in stages)
    if any("wall_ns" in stage for stage in stages):
        return total
    return max(total, *(stage.get("start_ns", 0) + stage["span_ns"] for stage in stages), 0)


def by_stage(sample: dict[str, Any]) -> Sample:
    return {entry["stage"]: entry for entry in sample["stages"]}


def times_ns(samples: Iterable[Sample], stage: str = "") -> numpy.ndarray:
    """Returns the times of a stage for the samples that have it, or whole times of all samples if `stage` is empty."""
    return numpy.array([elapsed_ns(sample[stage]) if stage else whole_ns(sample) for sample in samples
                        if not stage or stage in sample], dtype=float)


def counted(samples: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Returns the samples that statistics use: those without drift of the device, or all samples if most of them have drift."""
    steady = [sample for sample in samples if not sample.get("drifted", False)]
    return steady if 2 * len(steady) >= len(samples) else samples


class Cell:
    """A cell of a result file. `raw` is its JSON. A cell that was skipped or failed has no samples."""

    def __init__(self, raw: dict[str, Any]) -> None:
        self.raw = raw
        facts, collider = raw["scene"], raw.get("collider", {})
        self.experiment: str = raw["experiment"]
        self.scene_facts: dict[str, Any] = facts
        self.scene: str = names.scene(facts)
        self.triangles: int = facts.get("triangles", 0)
        self.frame: int = facts.get("frame", 0)  # from 0
        self.stand_in_for: str | None = facts.get("stand_in_for")
        self.outlier: dict[str, Any] | None = facts.get("outlier")  # the triangle that was moved, its scene, and its distance
        self.builder: str = raw["builder"]["name"]
        self.options = sorted_options(raw["builder"])
        self.collider: str | None = collider.get("name")  # what queried the tree; the builder is "none" if it needs no tree
        self.collider_options = sorted_options(collider)
        self.operation: str = raw.get("operation", "build")  # build, refit, collide, accuracy (along an axis) or cluster
        self.status: str = raw["status"]
        self.reason: str = raw.get("reason", "")  # why the cell was skipped or failed
        self.check: dict[str, Any] = raw.get("check", {})
        self.counters: dict[str, float] = raw.get("counters", {})
        self.left_out: dict[str, str] = raw.get("left_out", {})  # counters without a value, each with the reason
        self.leaves_by_depth: list[int] = raw.get("leaves_by_depth", [])  # by level, from the root
        self.accuracy: dict[str, Any] = raw.get("accuracy", {})  # axis, method and seed; empty for other operations
        self.cluster: dict[str, Any] = raw.get("cluster", {})  # what was asked of several ranks, and what they found; else empty
        self.outside: dict[str, str] = raw.get("outside", {})  # what a builder or collider from outside says of itself; else empty
        if self.outside:
            names.OUTSIDE[self.outside["name"]] = None
        self.swept: dict[str, Any] = raw.get("swept", {})  # kind of pairs and target frame; empty if boxes are of one frame
        self.features: dict[str, Any] = raw.get("features", self.swept)  # the same of one frame too; empty if pairs are of triangles

    @property
    def verdict(self) -> str:
        """Returns "agrees", "differs", "counted" or "not checked" for a measured cell, otherwise "skipped" or "failed"."""
        return self.check.get("verdict", "not_checked").replace("_", " ") if self.status == "measured" else self.status

    @property
    def checked(self) -> bool:
        """True if the answer was compared with a right answer and either agreed or had its errors counted."""
        return self.verdict in ("agrees", "counted")

    @property
    def has_times(self) -> bool:
        """True if times may be shown: the cell was measured, has samples, and its answer is not wrong."""
        return self.status == "measured" and self.verdict != "differs" and bool(self.all_samples)

    @property
    def all_samples(self) -> list[dict[str, Any]]:
        """Returns the samples as the file has them, including those with drift of the device."""
        return self.raw.get("samples", [])

    @functools.cached_property
    def samples(self) -> list[Sample]:
        """Returns the samples that statistics use, each as a map from stage name to its numbers."""
        return [by_stage(sample) for sample in counted(self.all_samples)]

    def times_ns(self, stage: str = "") -> numpy.ndarray:
        """Returns the times of a stage, or whole times, for the samples that statistics use."""
        return times_ns(self.samples, stage)

    def times_s(self, stage: str = "") -> numpy.ndarray:
        return self.times_ns(stage) * 1e-9

    def median_ns(self, stage: str = "") -> float:
        """Returns the median of times_ns, or 0 if no sample has the stage."""
        return median(self.times_ns(stage))

    @property
    def caches(self) -> str:
        """Returns where samples find their data: "hot", "cold" or "host"."""
        return self.raw.get("sampling", {}).get("caches", "hot")

    def walls_ns(self) -> list[float]:
        """Returns the times of whole samples on the host's clock, for the samples that statistics use."""
        return [sample["wall_ns"] for sample in counted(self.all_samples) if "wall_ns" in sample]

    @property
    def wall_ns(self) -> float:
        """Returns the median of walls_ns, or 0."""
        return median(self.walls_ns())

    @property
    def leaves_out(self) -> bool:
        """True if the stages of a method from outside are less than half of the wall clock less the round trip (docs/plugins.md)."""
        round_trip = max(self.counters.get("round_trip_ns", 0), MESSAGES_NS)
        return bool(self.outside) and self.has_times and 2 * self.median_ns() < self.wall_ns - round_trip

    @functools.cached_property
    def processes(self) -> "list[Cell]":
        """Returns a cell with the samples of each process, if they are of several (`merge --processes`); else this cell alone."""
        if "processes" not in self.raw:
            return [self]
        samples = grouped(self.all_samples, lambda sample: sample.get("process", 0))
        return [Cell({key: value for key, value in self.raw.items() if key != "processes"} | {"samples": samples[k]})
                for k in sorted(samples)]

    @property
    def provenance(self) -> str:
        """Returns whose a builder or collider from outside is: "cuBQL 1.0 (Apache-2.0) by libcubql.so, on NVIDIA H200"; else nothing."""
        return "{library} {version} ({licence}) by {file}, on {device}".format_map(self.outside) if self.outside else ""

    @property
    def is_frame(self) -> bool:
        """True for a frame of a scene that may move from frame to frame."""
        return self.operation == "collide" and not self.swept

    @property
    def on_host(self) -> bool:
        return any("wall_ns" in entry for sample in self.samples for entry in sample.values())

    def moved_bytes(self, stage: str) -> float | None:
        """Returns the minimum number of bytes that the stage must read and write, or None for host stages."""
        return self.samples[0].get(stage, {}).get("moved_bytes") if self.samples else None

    @property
    def starts_from_leaves(self) -> bool:
        """True if a build started from sorted leaves, so that only the hierarchy was timed."""
        first = self.samples[0] if self.samples else {}
        return self.operation == "build" and list(first) == ["hierarchy"] and first["hierarchy"].get("launches", 0) > 0

    @property
    def used_options(self) -> dict[str, str]:
        """Returns the collider's options. Where the cell tells from which level a traversal started and how far it jumped, that
        is in them in place of what was asked for, which may be the device's choice."""
        options = dict(self.collider_options)
        if (level := self.counters.get("used_start_level")) is None:
            return options
        rules = [rule for rule in options.get("no_skip", "").split(", ") if rule and (rule != "start-level" or level > 0)]
        return options | {"no_skip": ", ".join(rules), "jump": f"{self.counters['used_jump']:g}", "start_level": "0",
                          "start": f"level {level:g}" if level > 0 else "the root"}

    @property
    def called(self) -> str:
        """Returns the name in figures: the pipeline of a frame, the builder of a build."""
        if self.collider is None:
            return self.builder
        return names.pipeline(self.collider, self.used_options, self.builder, dict(self.options))

    @property
    def pipeline(self) -> str:
        """Returns the name on the console: what was measured, with all options that are not the defaults, and in place of what a
        collider was left to choose what it chose."""
        return self._in_full(names.CALLED.get(self.collider or "", self.collider), self.used_options)

    @property
    def asked(self) -> str:
        """Returns what was asked for, with all options that are not the defaults: equal in every run, on every device."""
        return self._in_full(self.collider, dict(self.collider_options))

    def _in_full(self, name: str | None, collider_options: dict[str, str]) -> str:
        if self.operation == "accuracy":
            return f"{self.accuracy['axis']}, {self.accuracy['method']}"
        builder = names.in_full(self.raw["builder"])
        if self.operation == "cluster":
            return f"{name or ''} over {builder}, {', '.join(f'{key} {value}' for key, value in of_ranks(self.cluster).items())}"
        caches = f", {names.CACHES[self.caches]}" if self.caches in names.CACHES else ""
        if self.operation == "collide":
            features = f"{self.features['pairs']} by " if self.features else ""
            collider = names.in_full({"name": name, "options": collider_options})
            return f"{features}{collider}{'' if self.builder == 'none' else f' over {builder}'}{caches}"
        return f"{builder}{', refit' if self.operation == 'refit' else ''}{caches}"

    @property
    def label(self) -> str:
        """Returns scene and what was asked for, which identify a cell to a reader and in a baseline."""
        frame = f", frame {self.frame}" if self.operation == "collide" or self.frame > 0 else ""
        return f"{self.scene}{frame}: {self.asked}{', from sorted leaves' if self.starts_from_leaves else ''}"

    @property
    def identity(self) -> str:
        return identity(self.raw)

    def key(self, *names: str, without: str = "") -> tuple[Hashable, ...]:
        """Returns the named parts of the identity, ignoring the collider's option `without`."""
        own = parts(self.raw, without)
        return tuple(own.get(name) for name in names)


def later(cells: Iterable[Cell]) -> list[Cell]:
    """Returns the cells without the first of several frames of a scene: the mean of a frame is over the others (docs/frames.md)."""
    those = list(cells)
    frames = sorted({cell.frame for cell in those if cell.is_frame})
    return [cell for cell in those if not cell.is_frame or cell.frame > frames[0] or len(frames) == 1]


def sorted_options(choice: dict[str, Any]) -> tuple[tuple[str, str], ...]:
    return tuple(sorted((key, str(value)) for key, value in choice.get("options", {}).items()))


def choice(raw: dict[str, Any], without: str = "") -> tuple[str, tuple[tuple[str, str], ...]]:
    """Returns the name and options of a builder or collider, without defaults, which a file may omit."""
    return raw["name"], tuple((key, value) for key, value in sorted_options(raw) if value != names.USUAL.get(key) and key != without)


def of_ranks(cluster: dict[str, Any]) -> dict[str, Any]:
    """Returns what was asked of several ranks."""
    return {key: cluster[key] for key in OF_RANKS if cluster.get(key)}


def parts(raw: dict[str, Any], without: str = "") -> dict[str, Any]:
    """Returns everything that identifies a cell, independent of its outcome. All options count, including those unknown to this
    reader. An option missing from a file of an older format has its default."""
    scene = raw["scene"] if isinstance(raw["scene"], dict) else {"name": raw["scene"]}
    told = {name: raw[name] for name in ("experiment", "accuracy", "family", "system") if name in raw}
    told |= {"cluster": of_ranks(raw["cluster"])} if "cluster" in raw else {}
    told |= {part: choice(raw[part], without) for part in ("builder", "collider") if part in raw}
    told |= {name: scene.get(name, usual) for name, usual in OF_SCENE.items()}
    features, sampling = raw.get("features", raw.get("swept", {})), raw.get("sampling", {})
    return told | {"scene": scene["name"], "operation": raw.get("operation", "build"), "caches": sampling.get("caches", "hot"),
                   "swept": (features.get("pairs"), features.get("to_frame"))}


def identity(raw: dict[str, Any]) -> str:
    """Returns a text that is equal for two cells exactly if they are the same cell."""
    return json.dumps(parts(raw), sort_keys=True)
